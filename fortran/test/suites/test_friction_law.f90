!> The worked example of docs/friction-law.md: each step of it against a computation that does not
!> use the step.
module test_friction_law
   use block_parameters, only: block_history_type, block_parameters_type
   use block_state, only: index_of_ln_v
   use characteristic_roots, only: find_roots
   use closed_form, only: closed_epsilon, closed_tau
   use cutoff_block, only: build_cutoff_block, cutoff_block_type, with_jacobian_type, &
                           with_series_type
   use delay_equation, only: linear_system_type
   use dde, only: find_jacobian, integration_result
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use fixed_step_rk4, only: integrate_rk4
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance, run, solve
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: collect_friction_law

   !> The cut-off.
   real(wp), parameter :: cutoff = 0.5_wp

contains

   subroutine collect_friction_law(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("right-hand side alone", test_rhs), &
                   new_unittest("no cut-off", test_no_cutoff), &
                   new_unittest("Jacobian", test_jacobian), &
                   new_unittest("Taylor series", test_series), &
                   new_unittest("Hopf points", test_hopf)]
   end subroutine collect_friction_law

   !> Parameters with a delay, away from steady sliding.
   pure type(block_parameters_type) function parameters_here() result(parameters)
      parameters = block_parameters_type(tau=2.0_wp, epsilon=0.6_wp, xi=0.5_wp, gamma=0.8_wp)
   end function parameters_here

   !> Where the block is pushed from.
   pure type(block_history_type) function history_here() result(history)
      history = block_history_type(theta=0.1_wp, u=-0.2_wp, v=1.5_wp)
   end function history_here

   !> Without Jacobian and series, `auto` and the implicit methods give the solution of a fixed-step
   !> method of order 4 (h = 0.005, its error is about 1e-9).
   subroutine test_rhs(error)
      type(error_type), allocatable, intent(out) :: error
      type(cutoff_block_type) :: block
      type(failure_type), allocatable :: failure
      type(integration_result) :: fixed, outcome
      character(len=8), parameter :: tried(3) = [character(len=8) :: "auto", "explicit", "radau9"]
      integer :: i

      block = build_cutoff_block(parameters_here(), history_here(), cutoff)
      call integrate_rk4(block, 20.0_wp, 0.005_wp, .true., fixed, failure)
      call expect_success(error, failure)
      do i = 1, size(tried)
         call run(error, block, 0.0_wp, 20.0_wp, at_tolerance(1.0e-10_wp, tried(i)), outcome)
         if (allocated(error)) return
         call expect_close(error, outcome%y, fixed%y, 1.0e-7_wp, "state by "//trim(tried(i)))
      end do
   end subroutine test_rhs

   !> Without cut-off the law is that of the paper.
   subroutine test_no_cutoff(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: time(3) = [0.5_wp, 5.0_wp, 30.0_wp]
      real(wp), allocatable :: ours(:, :), theirs(:, :)

      call solve(build_cutoff_block(parameters_here(), history_here(), 0.0_wp), time, &
                 at_tolerance(1.0e-11_wp), ours, error)
      call solve(spring_block_type(parameters_here(), history_here()), time, &
                 at_tolerance(1.0e-11_wp), theirs, error)
      if (allocated(error)) return
      call expect_close(error, [ours], [theirs], 1.0e-8_wp, "states")
      call solve(build_cutoff_block(parameters_here(), history_here(), cutoff), time, &
                 at_tolerance(1.0e-11_wp), ours, error)
      if (allocated(error)) return
      call expect(error, maxval(abs(ours - theirs)) > 0.01_wp, "the cut-off matters")
   end subroutine test_no_cutoff

   !> The Jacobian and that by differences of the right-hand side, with delay and without.
   subroutine test_jacobian(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: parameters
      type(cutoff_block_type) :: plain
      type(with_jacobian_type) :: block
      real(wp), allocatable :: by_z(:, :), differences_by_z(:, :), z(:)
      real(wp) :: by_y(3, 3), differences_by_y(3, 3)
      real(wp), parameter :: y(3) = [0.3_wp, -0.4_wp, 0.7_wp]
      integer :: i

      do i = 0, 1
         parameters = parameters_here()
         parameters%tau = 2.0_wp*i
         call block%set(parameters, history_here(), cutoff)
         plain = build_cutoff_block(parameters, history_here(), cutoff)
         allocate (z(i), source=-0.5_wp)
         allocate (by_z(3, i), differences_by_z(3, i))
         call block%jacobian(0.0_wp, y, z, by_y, by_z)
         call find_jacobian(plain, 0.0_wp, y, z, differences_by_y, differences_by_z)
         call expect_close(error, [by_y], [differences_by_y], 1.0e-6_wp, "by the state")
         call expect_close(error, [by_z], [differences_by_z], 1.0e-6_wp, "by the delayed value")
         deallocate (z, by_z, differences_by_z)
      end do
   end subroutine test_jacobian

   !> Taylor steps and implicit ones of order 13 give the same solution, with delay and without.
   subroutine test_series(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: parameters
      type(with_series_type) :: block
      real(wp), parameter :: time(3) = [0.5_wp, 5.0_wp, 30.0_wp]
      real(wp), allocatable :: implicit_one(:, :), series(:, :)
      integer :: i

      do i = 0, 1
         parameters = parameters_here()
         parameters%tau = 2.0_wp*i
         call block%set(parameters, history_here(), cutoff)
         block%analytic = .true.
         call solve(block, time, at_tolerance(1.0e-12_wp, "taylor"), series, error)
         call solve(block, time, at_tolerance(1.0e-12_wp, "radau13"), implicit_one, error)
         if (allocated(error)) return
         call expect_close(error, [series], [implicit_one], 1.0e-9_wp, "states")
      end do
   end subroutine test_series

   !> Step 4, the linear part at steady sliding, whose determinant is the characteristic function.
   pure type(linear_system_type) function linear_part(block) result(system)
      class(with_jacobian_type), intent(in) :: block
      real(wp) :: by_z(3, 1)

      allocate (system%a(3, 3, 2), system%lag(2))
      call block%jacobian(0.0_wp, [0.0_wp, 0.0_wp, 0.0_wp], [0.0_wp], system%a(:, :, 1), by_z)
      system%a(:, :, 2) = 0.0_wp
      system%a(:, index_of_ln_v, 2) = by_z(:, 1)
      system%lag = [0.0_wp, block%lag(1)]
   end function linear_part

   !> At steady sliding L' = 1/(1 + c), so that (5) holds with xi (1 + c) in place of xi. On its
   !> Hopf curves in closed form i omega is a root; on the first one the others are stable.
   subroutine test_hopf(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(with_jacobian_type) :: block
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: all_omega(2) = [0.3_wp, 0.45_wp], gamma = 0.8_wp, xi = 0.5_wp
      real(wp), parameter :: stiffer = xi*(1.0_wp + cutoff)
      integer :: i

      do i = 1, size(all_omega)
         associate (omega => all_omega(i))
            call block%set(block_parameters_type(tau=closed_tau(omega, stiffer, gamma, 0), &
                                                 epsilon=closed_epsilon(omega, stiffer, gamma), &
                                                 xi=xi, gamma=gamma), block_history_type(), cutoff)
            call find_roots(linear_part(block), -0.5_wp, roots, failure)
            call expect_success(error, failure)
            if (allocated(error)) return
            call expect_close(error, abs(roots(1) - cmplx(0.0_wp, omega, kind=wp)), 0.0_wp, &
                              1.0e-12_wp, "distance of i omega at omega = "//text(omega))
            call expect(error, all(real(roots(3:)) < -1.0e-3_wp), "the others are stable")
         end associate
      end do
   end subroutine test_hopf
end module test_friction_law
