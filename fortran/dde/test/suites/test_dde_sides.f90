! SPDX-License-Identifier: BSD-3-Clause
!> Right-hand sides that are not smooth, with exact solutions.
module test_dde_sides
   use dde, only: continuation_type, event_table, integrate, integration_options, &
                  integration_result
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_failure
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, run
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: collect_dde_sides

   character(len=8), parameter :: methods(6) = [character(len=8) :: "bs5", "dop853", "radau5", &
                                                "radau9", "radau13", "auto"]
   real(wp), parameter :: pi = acos(-1.0_wp)
   enum, bind(c)
      enumerator :: relay, pulses, friction
   end enum

   !> relay: y' = -sign(y(t - 1)), from 1 a triangle of period 4. pulses: y' = 1 where
   !> sin(40 t) > 0, else 0. friction: twice y1' = y2, y2' = -y1 - sign(y2)/10 (Coulomb): each half
   !> period takes 1/5 of the amplitude, and it stays at rest where |y1| <= 1/10.
   type, extends(constant_past) :: sided
      integer :: kind = relay
      !> -1 or 1 for each side
      real(wp), allocatable :: side(:)
   contains
      procedure :: rhs, switching, take_sides
   end type sided

contains

   subroutine collect_dde_sides(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("a relay with a delay", test_relay), &
                   new_unittest("pulses in time", test_pulses), &
                   new_unittest("dry friction", test_friction)]
   end subroutine collect_dde_sides

   !> Straight pieces are exact at any tolerance. It goes on from a run that ended at an event.
   subroutine test_relay(error)
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: state
      type(integration_result) :: outcome
      type(event_table) :: events
      type(sided) :: problem
      integer :: i

      problem = new_sided(relay, [1.0_wp], 1, delay=1.0_wp)
      do i = 1, size(methods)
         call run(error, problem, 0.0_wp, 21.25_wp, at_tolerance(1.0e-3_wp, methods(i)), outcome)
         if (allocated(error)) return
         call expect_close(error, outcome%y, [-0.25_wp], 1.0e-12_wp, methods(i))
         call expect(error, outcome%switched(1) == 10, methods(i)//" changes sides 10 times")
         events = event_table([1], [-0.5_wp], [1], [.true.])
         state = continuation_type()
         call run(error, problem, 0.0_wp, 21.25_wp, at_tolerance(1.0e-3_wp, methods(i)), outcome, &
                  watcher=events, continuation=state)
         if (allocated(error)) return
         call expect_close(error, outcome%t, 2.5_wp, 1.0e-13_wp, "the event")
         call run(error, problem, state%time(1), 21.25_wp, at_tolerance(1.0e-3_wp, methods(i)), &
                  outcome, continuation=state)
         call expect_close(error, outcome%y, [-0.25_wp], 1.0e-12_wp, methods(i)//" continued")
      end do
   end subroutine test_relay

   !> Pulses that are shorter than the steps between them would be.
   subroutine test_pulses(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      integer :: i

      do i = 1, size(methods)
         call run(error, new_sided(pulses, [0.0_wp], 1), 0.0_wp, 10.0_wp*pi, &
                  at_tolerance(1.0e-3_wp, methods(i)), outcome)
         if (allocated(error)) return
         call expect_close(error, outcome%y, [5.0_wp*pi], 1.0e-10_wp, methods(i))
      end do
   end subroutine test_pulses

   !> Two oscillators change sides at one time, and stay at rest after five half periods.
   subroutine test_friction(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(sided) :: problem
      real(wp) :: angle
      integer :: i

      problem = new_sided(friction, [1.0_wp, 0.0_wp, 1.0_wp, 0.0_wp], 2)
      angle = 10.0_wp - 3.0_wp*pi
      do i = 1, size(methods)
         options = at_tolerance(1.0e-9_wp, methods(i))
         call run(error, problem, 0.0_wp, 10.0_wp, options, outcome)
         if (allocated(error)) return
         associate (y => [-0.1_wp - 0.3_wp*cos(angle), 0.3_wp*sin(angle)])
            call expect_close(error, outcome%y, [y, y], 1.0e-7_wp, methods(i))
         end associate
         call expect(error, all(outcome%switched == 3), methods(i)//" changes sides 3 times")
         call integrate(problem, 0.0_wp, 20.0_wp, options, outcome, failure)
         call expect_failure(error, failure, "from both sides of the zero of switching(")
         call expect_close(error, outcome%t, 5.0_wp*pi, 1.0e-4_wp, methods(i)//" stops")
      end do
   end subroutine test_friction

   !> One of these problems.
   function new_sided(kind, start, switches, delay) result(problem)
      integer, intent(in) :: kind, switches
      real(wp), intent(in) :: start(:)
      real(wp), intent(in), optional :: delay
      type(sided) :: problem

      if (present(delay)) then
         call fill(problem, size(start), start, start, [delay], [1])
      else
         call fill(problem, size(start), start, start)
      end if
      problem%kind = kind
      problem%switches = switches
      allocate (problem%side(switches), source=0.0_wp)
   end function new_sided

   pure subroutine rhs(self, t, y, z, dydt)
      class(sided), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      select case (self%kind)
      case (relay)
         dydt = -self%side
      case (pulses)
         dydt = 0.5_wp*(1.0_wp + self%side)
      case default
         dydt(1::2) = y(2::2)
         dydt(2::2) = -y(1::2) - 0.1_wp*self%side
      end select
   end subroutine rhs

   pure subroutine switching(self, t, y, z, values)
      class(sided), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: values(self%switches)

      select case (self%kind)
      case (relay)
         values = z
      case (pulses)
         values = sin(40.0_wp*t)
      case default
         values = y(2::2)
      end select
   end subroutine switching

   pure subroutine take_sides(self, above)
      class(sided), intent(inout) :: self
      logical, intent(in) :: above(:)

      self%side = merge(1.0_wp, -1.0_wp, above)
   end subroutine take_sides
end module test_dde_sides
