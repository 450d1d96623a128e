! SPDX-License-Identifier: BSD-3-Clause
!> Five delay problems on which solvers can be compared: stiff, large, or with pulses that return.
!> This file has all of them: equations, parameters, histories, and values at the end to 15 digits.
module delay_problems
   use dde, only: dde_problem_type, wp
   implicit none (type, external)
   private
   public :: delay_problem, names, new_problem

   character(len=9), parameter :: names(5) = [character(len=9) :: "robertson", "enzyme", "block", &
                                              "pulses", "ring"]
   !> Oscillators of the ring
   integer, parameter :: ring = 1000

   !> A problem of these.
   type, extends(dde_problem_type) :: delay_problem
      !> One of `names`; a second method for the reference
      character(len=9) :: name = "", second = "radau9"
      !> Final time; absolute tolerance over the relative one
      real(wp) :: t_end = 0.0_wp, smallest = 1.0_wp
      !> Components that are compared, and their values at the final time
      integer, allocatable :: compared(:)
      real(wp), allocatable :: reference(:)
   contains
      procedure :: initial, history, rhs
   end type delay_problem

contains

   !> The problem of a name.
   pure type(delay_problem) function new_problem(name) result(problem)
      character(len=*), intent(in) :: name
      integer :: j

      problem%name = name
      select case (name)
      case ("robertson")
         problem%n = 3
         problem%lag = [1.0e-4_wp]
         problem%component = [2]
         problem%t_end = 1.0e11_wp
         problem%smallest = 1.0e-6_wp
         problem%reference = [2.083340149701374e-8_wp, 8.333360770335093e-14_wp, &
                              0.9999999791665152_wp]
      case ("enzyme")
         problem%n = 4
         problem%lag = [4.0_wp]
         problem%component = [4]
         problem%t_end = 160.0_wp
         problem%second = "dop853"
         problem%reference = [33.92579471113927_wp, 22.70653713130799_wp, &
                              18.83057673173372_wp, 22.26599078770375_wp]
      case ("block")
         problem%n = 3
         problem%lag = [1.0_wp]
         problem%component = [3]
         problem%t_end = 60.0_wp
         problem%reference = [3.700141886365491_wp, -3.015417433902283_wp, -1.287807939243665_wp]
      case ("pulses")
         problem%n = 2
         problem%lag = [1.0_wp, 1.0_wp]
         problem%component = [1, 2]
         problem%t_end = 3.5_wp
         problem%smallest = 1.0e-4_wp
         ! exact but for exp(-5000)
         problem%reference = [1.0e-4_wp, 1.4998_wp]
      case default
         problem%n = 2*ring
         problem%lag = spread(3.0_wp, 1, ring)
         problem%component = [(2*j - 1, j=1, ring)]
         ! the Jacobian: two by two blocks, and delayed values in one equation each
         problem%lower = 1
         problem%upper = 1
         problem%rows = reshape([(2*modulo(j, ring) + 1, 2*modulo(j, ring) + 1, j=1, ring)], &
                                [2, ring])
         problem%t_end = 20.0_wp
         problem%second = "dop853"
         problem%compared = [1, 2, 667, 1334]
         problem%reference = [-0.3908496070310495_wp, -1.003661482838161_wp, &
                              -1.862685185670570_wp, -0.8224290562035878_wp]
      end select
      if (.not. allocated(problem%compared)) problem%compared = [(j, j=1, problem%n)]
   end function new_problem

   !> The state at t = 0.
   pure subroutine initial(self, y)
      class(delay_problem), intent(in) :: self
      real(wp), intent(out) :: y(self%n)
      integer :: i

      y = [(self%history(0.0_wp, i), i=1, self%n)]
      if (self%name == "pulses") y(1) = 1.0_wp
   end subroutine initial

   !> The state before t = 0.
   pure real(wp) function history(self, t, component) result(value)
      class(delay_problem), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

      select case (self%name)
      case ("robertson")
         value = merge(1.0_wp, 0.0_wp, component == 1)
      case ("enzyme")
         value = merge(60.0_wp, merge(20.0_wp, 10.0_wp, component == 4), component == 1)
      case ("block")
         value = merge(-0.1_wp, 0.0_wp, component == 2)
      case ("pulses")
         value = 0.0_wp
      case default
         value = sin(turn*component/ring)
      end select
   end function history

   !> The equations.
   pure subroutine rhs(self, t, y, z, dydt)
      class(delay_problem), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      select case (self%name)
      case ("robertson")
         ! Guglielmi and Hairer (2001), with a shorter delay (README.md)
         dydt(1) = -0.04_wp*y(1) + 1.0e4_wp*z(1)*y(3)
         dydt(3) = 3.0e7_wp*y(2)**2
         dydt(2) = -dydt(1) - dydt(3)
      case ("enzyme")
         ! Hairer, Norsett and Wanner (1993), section II.17
         dydt(2) = y(1)/(1.0_wp + 0.0005_wp*z(1)**3)
         dydt(1) = 10.5_wp - dydt(2)
         dydt(2) = dydt(2) - y(2)
         dydt(3) = y(2) - y(3)
         dydt(4) = y(3) - 0.5_wp*y(4)
      case ("block")
         ! rate-and-state friction at gamma = 1e12: theta, u, ln v
         dydt(1) = -exp(y(3))*(y(1) + 3.0_wp*z(1))
         dydt(2) = exp(y(3)) - 1.0_wp
         dydt(3) = -1.0e24_wp*exp(-y(3))*(y(2) + (y(1) + y(3))/0.8_wp)
      case ("pulses")
         ! each delay a layer of width 1e-4 returns
         dydt = [-1.0e4_wp*y(1) + z(2), 1.0e4_wp*z(1)]
      case default
         ! FitzHugh-Nagumo, each driven by the one before
         dydt(1::2) = 0.5_wp*y(1::2) - y(1::2)**3/3.0_wp - y(2::2) + 0.5_wp*cshift(z, -1)
         dydt(2::2) = 0.1_wp*(y(1::2) + 0.5_wp)
      end select
   end subroutine rhs
end module delay_problems

!> Errors and costs of this solver at three tolerances. The argument is the method, `auto` if there
!> is none. Compiled in quadruple precision, it computes the references by two methods.
program run_delay_problems
   use dde, only: error_type, integrate, integration_options, integration_result, wp
   use delay_problems, only: delay_problem, names, new_problem
   implicit none (type, external)
   !> Largest relative error in units of the tolerance; largest difference of references
   real(wp), parameter :: most = 10.0_wp, agreed = 1.0e-14_wp
   character(len=8) :: method
   integer :: i

   method = "auto"
   if (command_argument_count() > 0) call get_command_argument(1, method)
   if (precision(1.0_wp) < 30) then
      print "(a)", "problem    tolerance       error   steps  rejected   evaluations  factored"
   end if
   do i = 1, size(names)
      if (precision(1.0_wp) < 30) then
         call measure(new_problem(names(i)))
      else
         call print_reference(new_problem(names(i)))
      end if
   end do

contains

   !> A line for each tolerance.
   subroutine measure(problem)
      type(delay_problem), intent(in) :: problem
      type(integration_result) :: outcome
      real(wp) :: error
      integer :: k

      do k = 4, 8, 2
         outcome = solved(problem, method, 10.0_wp**(-k))
         error = difference(outcome%y(problem%compared), problem%reference)
         print "(a, es12.1, es12.1, i8, i10, i14, i10)", problem%name, 10.0_wp**(-k), error, &
            outcome%accepted, outcome%rejected, outcome%evaluations, outcome%factorisations
         if (error > most*10.0_wp**(-k)) error stop "the error is too large"
      end do
   end subroutine measure

   !> Two methods at two tolerances, which must agree.
   subroutine print_reference(problem)
      type(delay_problem), intent(in) :: problem
      type(integration_result) :: first, second

      first = solved(problem, "radau13 ", 1.0e-15_wp)
      second = solved(problem, problem%second, 1.0e-14_wp)
      associate (y => first%y(problem%compared))
         print "(a, es9.1, 4es24.15)", problem%name, difference(second%y(problem%compared), y), y
         if (difference(second%y(problem%compared), y) > agreed) error stop "two methods differ"
         if (difference(problem%reference, y) > agreed) error stop "the reference is another"
      end associate
   end subroutine print_reference

   !> The end of a run.
   type(integration_result) function solved(problem, method, tolerance) result(outcome)
      type(delay_problem), intent(in) :: problem
      character(len=*), intent(in) :: method
      real(wp), intent(in) :: tolerance
      type(error_type), allocatable :: error

      call integrate(problem, 0.0_wp, problem%t_end, &
                     integration_options(method, tolerance, problem%smallest*tolerance), outcome, &
                     error)
      if (allocated(error)) error stop error%message
   end function solved

   !> The largest relative difference.
   pure real(wp) function difference(y, reference) result(largest)
      real(wp), intent(in) :: y(:), reference(:)

      largest = maxval(abs(y/reference - 1.0_wp))
   end function difference
end program run_delay_problems
