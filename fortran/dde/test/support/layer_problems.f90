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

   !> A problem that knows its solution.
   type, extends(constant_past), abstract :: solved
   contains
      procedure(solution), deferred :: exact
   end type solved

   abstract interface
      !> The state at a time from 0 to 4.
      pure function solution(self, t) result(u)
         import :: solved, wp
         implicit none (type, external)
         class(solved), intent(in) :: self
         real(wp), intent(in) :: t
         real(wp) :: u(self%n)
      end function solution
   end interface

   !> u' = r (s - u) without delay, where s is 0 before t = `switch_at` and 1 from there on.
   type, extends(solved) :: relaxation
      !> When s changes
      real(wp) :: switch_at = huge(1.0_wp)
   contains
      procedure :: rhs => relaxation_rhs
      procedure :: series => relaxation_series
      procedure :: exact => relaxation_exact
   end type relaxation

   interface relaxation
      module procedure :: new_relaxation
   end interface relaxation

   !> u1' = -r u1 + back u2(t - 1), u2' = r u1(t - 1), with u1(0) = 1 and else 0 up to t = 0.
   type, extends(solved) :: layer
      !> Share of the pulse that returns
      real(wp) :: back = 0.0_wp
   contains
      procedure :: rhs => layer_rhs
      procedure :: series => layer_series
      procedure :: exact => layer_exact
   end type layer

   !> What compares samples with the solution.
   type, extends(sampler_type) :: error_sampler
      !> The problem
      class(solved), allocatable :: problem
      !> Largest error of each component so far
      real(wp), allocatable :: largest(:)
   contains
      procedure :: take => take_error
   end type error_sampler

   interface layer
      module procedure :: new_layer
   end interface layer

contains

   !> The layer; no pulse returns if no share is given.
   pure type(layer) function new_layer(rate, back) result(problem)
      real(wp), intent(in) :: rate
      real(wp), intent(in), optional :: back

      call fill(problem, 2, [0.0_wp, 0.0_wp], [1.0_wp, 0.0_wp], [1.0_wp, 1.0_wp], [1, 2])
      problem%analytic = .true.
      problem%rate = rate
      if (present(back)) problem%back = back
   end function new_layer

   !> The equations.
   pure subroutine layer_rhs(self, t, y, z, dydt)
      class(layer), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = [-self%rate*y(1) + self%back*z(2), self%rate*z(1)]
   end subroutine layer_rhs

   !> Term by term.
   pure subroutine layer_series(self, t, unit, degree, z, y)
      class(layer), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: k

      do k = 0, degree - 1
         y(k + 1, 1) = unit/(k + 1)*(-self%rate*y(k, 1) + self%back*z(k, 2))
         y(k + 1, 2) = unit/(k + 1)*(self%rate*z(k, 1))
      end do
   end subroutine layer_series

   !> The solution.
   pure function layer_exact(self, t) result(u)
      class(layer), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: u(self%n)

      associate (r => self%rate, x => max(0.0_wp, t - 1.0_wp), w => max(0.0_wp, t - 2.0_wp), &
                 s => max(0.0_wp, t - 3.0_wp))
         u(1) = decay(r*t) + self%back*((1.0_wp - decay(r*w))/r - w*decay(r*w))
         u(2) = 1.0_wp - decay(r*x) + self%back*(s*(1.0_wp + decay(r*s)) &
                                                 - 2.0_wp/r*(1.0_wp - decay(r*s)))
      end associate
   end function layer_exact

   !> From 1, or from 0 with a switch at a time.
   pure type(relaxation) function new_relaxation(rate, switch_at) result(problem)
      real(wp), intent(in) :: rate
      real(wp), intent(in), optional :: switch_at

      call fill(problem, 1, [0.0_wp], [merge(0.0_wp, 1.0_wp, present(switch_at))])
      problem%analytic = .true.
      problem%rate = rate
      if (present(switch_at)) problem%switch_at = switch_at
   end function new_relaxation

   !> The equation.
   pure subroutine relaxation_rhs(self, t, y, z, dydt)
      class(relaxation), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = self%rate*(merge(1.0_wp, 0.0_wp, t >= self%switch_at) - y)
   end subroutine relaxation_rhs

   !> Term by term, where no step contains the switch.
   pure subroutine relaxation_series(self, t, unit, degree, z, y)
      class(relaxation), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: k

      call self%rhs(t, y(0, :), z(0, :), y(1, :))
      y(1, :) = unit*y(1, :)
      do k = 1, degree - 1
         y(k + 1, :) = -self%rate*unit/(k + 1)*y(k, :)
      end do
   end subroutine relaxation_series

   !> Its solution.
   pure function relaxation_exact(self, t) result(u)
      class(relaxation), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: u(self%n)

      u = self%first*decay(self%rate*t)
      if (t >= self%switch_at) u = 1.0_wp - decay(self%rate*(t - self%switch_at))
   end function relaxation_exact

   !> Largest error of each component over samples at a share of each step: 1 at the ends of steps.
   !> The steps are the same with every share.
   subroutine measure_errors(problem, t_end, options, share, largest, error)
      class(solved), intent(in) :: problem
      real(wp), intent(in) :: t_end, share
      type(integration_options), intent(in) :: options
      real(wp), allocatable, intent(out) :: largest(:)
      type(error_type), allocatable, intent(out) :: error
      type(error_sampler) :: sampler
      type(integration_result) :: outcome
      integer :: i

      allocate (sampler%problem, source=problem)
      allocate (sampler%largest(problem%n), source=0.0_wp)
      sampler%wanted = [(i, i=1, problem%n)]
      sampler%share_of_step = share
      call integrate(problem, 0.0_wp, t_end, options, outcome, error, sampler)
      largest = sampler%largest
   end subroutine measure_errors

   !> Compare a sample.
   subroutine take_error(self, y)
      class(error_sampler), intent(inout) :: self
      real(wp), intent(in) :: y(:)

      self%largest = max(self%largest, abs(y - self%problem%exact(self%next)))
      self%next = huge(1.0_wp)
   end subroutine take_error

   !> exp(-x) for x >= 0, without underflow.
   pure real(wp) function decay(x) result(value)
      real(wp), intent(in) :: x

      value = exp(-min(x, 700.0_wp))
   end function decay
end module layer_problems
