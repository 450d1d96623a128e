! SPDX-License-Identifier: BSD-3-Clause
!> A component that decays within a step and returns after the delay, with exact solutions: what is
!> wrong between the ends of the step shows in the other component. The same without delay, and what
!> measures the errors of a run.
module layer_problems
   use dde, only: integrate, integration_options, integration_result, sampler_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: layer, measure_errors, relaxation, solved

   !> A problem with its solution from 0 to 4.
   type, extends(constant_past) :: solved
   end type solved

   !> What compares samples with the solution.
   type, extends(sampler_type) :: error_sampler
      !> The problem
      class(constant_past), allocatable :: problem
      !> Largest error of each component so far
      real(wp), allocatable :: largest(:)
   contains
      procedure :: take => take_error
   end type error_sampler

contains

   !> u1' = -r u1 + back u2(t - 1), u2' = r u1(t - 1), with u1(0) = 1 and else 0 up to t = 0: a
   !> pulse, of which a share returns (none if it is not given).
   type(solved) function layer(rate, back) result(problem)
      real(wp), intent(in) :: rate
      real(wp), intent(in), optional :: back

      call fill(problem, 2, [0.0_wp, 0.0_wp], [1.0_wp, 0.0_wp], [1.0_wp, 1.0_wp], [1, 2], &
                [rate, 0.0_wp])
      if (present(back)) problem%p(2) = back
      problem%f => pulse
      problem%exact => pulse_at
      problem%analytic = .true.
   end function layer

   !> u' = r (s - u) without delay, from u = 1 with s = 0, or from 0 with s = 1 from a time on.
   type(solved) function relaxation(rate, switch_at) result(problem)
      real(wp), intent(in) :: rate
      real(wp), intent(in), optional :: switch_at

      call fill(problem, 1, [0.0_wp], [merge(0.0_wp, 1.0_wp, present(switch_at))], &
                p=[rate, huge(1.0_wp)])
      if (present(switch_at)) problem%p(2) = switch_at
      problem%f => relax
      problem%exact => relaxed
      problem%terms => relaxing_series
      problem%analytic = .true.
   end function relaxation

   pure subroutine pulse(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = [-p(1)*y(1) + p(2)*z(2), p(1)*z(1)]
   end subroutine pulse

   pure subroutine pulse_at(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      associate (r => p(1), x => max(0.0_wp, t - 1.0_wp), w => max(0.0_wp, t - 2.0_wp), &
                 s => max(0.0_wp, t - 3.0_wp))
         y(1) = decay(r*t) + p(2)*((1.0_wp - decay(r*w))/r - w*decay(r*w))
         y(2) = 1.0_wp - decay(r*x) + p(2)*(s*(1.0_wp + decay(r*s)) &
                                            - 2.0_wp/r*(1.0_wp - decay(r*s)))
      end associate
   end subroutine pulse_at

   pure subroutine relax(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = p(1)*(merge(1.0_wp, 0.0_wp, t >= p(2)) - y)
   end subroutine relax

   !> Term by term, where no step contains the switch.
   pure subroutine relaxing_series(p, t, unit, z, y)
      real(wp), intent(in) :: p(:), t, unit, z(0:, :)
      real(wp), intent(inout) :: y(0:, :)
      integer :: k

      call relax(p, t, y(0, :), z(0, :), y(1, :))
      y(1, :) = unit*y(1, :)
      do k = 1, ubound(y, 1) - 1
         y(k + 1, :) = -p(1)*unit/(k + 1)*y(k, :)
      end do
   end subroutine relaxing_series

   pure subroutine relaxed(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = merge(0.0_wp, decay(p(1)*t), p(2) < huge(1.0_wp))
      if (t >= p(2)) y = 1.0_wp - decay(p(1)*(t - p(2)))
   end subroutine relaxed

   !> Largest error of each component over samples at a share of each step: 1 at the ends of steps.
   !> The steps are the same with every share.
   subroutine measure_errors(problem, t_end, options, share, largest, error, steps)
      class(constant_past), intent(in) :: problem
      real(wp), intent(in) :: t_end, share
      type(integration_options), intent(in) :: options
      real(wp), allocatable, intent(out) :: largest(:)
      type(error_type), allocatable, intent(out) :: error
      !> Number of steps
      integer, intent(out), optional :: steps
      type(error_sampler) :: sampler
      type(integration_result) :: outcome
      integer :: i

      allocate (sampler%problem, source=problem)
      allocate (sampler%largest(problem%n), source=0.0_wp)
      sampler%wanted = [(i, i=1, problem%n)]
      sampler%share_of_step = share
      call integrate(problem, 0.0_wp, t_end, options, outcome, error, sampler)
      largest = sampler%largest
      if (present(steps)) steps = int(outcome%accepted)
   end subroutine measure_errors

   !> Compare a sample.
   subroutine take_error(self, y)
      class(error_sampler), intent(inout) :: self
      real(wp), intent(in) :: y(:)
      real(wp) :: exact(size(y))

      call self%problem%exact(self%problem%p, self%next, exact)
      self%largest = max(self%largest, abs(y - exact))
      self%next = huge(1.0_wp)
   end subroutine take_error

   !> exp(-x) for x >= 0, without underflow.
   pure real(wp) function decay(x) result(value)
      real(wp), intent(in) :: x

      value = exp(-min(x, 700.0_wp))
   end function decay
end module layer_problems
