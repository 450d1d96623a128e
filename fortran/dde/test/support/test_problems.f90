! SPDX-License-Identifier: BSD-3-Clause
!> A problem made of procedures and parameters, and the delay equations with exact solutions that
!> most tests solve (Wille and Baker 1992; Hairer, Norsett and Wanner 1993, sec. II.17).
module test_problems
   use dde, only: problem_with_tangents
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: constant_past, decay_of_past, fill, linear, sine, wille_baker

   abstract interface
      !> f of parameters p.
      pure subroutine slopes_interface(p, t, y, z, f)
         import :: wp
         implicit none (type, external)
         real(wp), intent(in) :: p(:), t, y(:), z(:)
         real(wp), intent(out) :: f(:)
      end subroutine slopes_interface

      !> The solution at a time, or what was before the initial time.
      pure subroutine solution_interface(p, t, y)
         import :: wp
         implicit none (type, external)
         real(wp), intent(in) :: p(:), t
         real(wp), intent(out) :: y(:)
      end subroutine solution_interface

      !> Series of all components before the initial time, which are alike.
      pure subroutine past_series_interface(p, t, unit, y)
         import :: wp
         implicit none (type, external)
         real(wp), intent(in) :: p(:), t, unit
         real(wp), intent(out) :: y(0:)
      end subroutine past_series_interface

      !> Series of the solution.
      pure subroutine series_interface(p, t, unit, z, y)
         import :: wp
         implicit none (type, external)
         real(wp), intent(in) :: p(:), t, unit, z(0:, :)
         real(wp), intent(inout) :: y(0:, :)
      end subroutine series_interface
   end interface

   !> A problem of procedures. An extension may have its own in their place.
   type, extends(problem_with_tangents) :: constant_past
      !> History, that of `exact` if it is not allocated, and first state, shape (n)
      real(wp), allocatable :: past(:), first(:)
      !> Parameters of the procedures
      real(wp), allocatable :: p(:)
      !> f; where `terms` is not given and the problem is analytic, f is linear in y and z
      procedure(slopes_interface), pointer, nopass :: f => null()
      !> The solution, if it is known
      procedure(solution_interface), pointer, nopass :: exact => null()
      !> Series of a history that is not constant
      procedure(past_series_interface), pointer, nopass :: past_terms => null()
      !> Series of the solution
      procedure(series_interface), pointer, nopass :: terms => null()
   contains
      procedure :: initial => first_state
      procedure :: history => value_before
      procedure :: past_series => series_before
      procedure :: rhs => slopes
      procedure :: series => series_of_solution
   end type constant_past

   !> y' = -rate y(t - lag).
   type, extends(constant_past) :: linear
   end type linear

   interface linear
      module procedure :: new_linear
   end interface linear

   !> Two delays: y1' = y1(t-1), y2' = y1(t-1) + y2(t-0.2), y3' = y2.
   type, extends(constant_past) :: wille_baker
   end type wille_baker

   interface wille_baker
      module procedure :: new_wille_baker
   end interface wille_baker

   !> y' = -y(t - pi/2) with the history sin t: y = sin t.
   type, extends(constant_past) :: sine
   end type sine

   interface sine
      module procedure :: new_sine
   end interface sine

contains

   !> Fill what every problem has, as far as it is given; without delays if none are. (flang 19
   !> crashes on structure constructors with components of a parent type, llvm-project issue
   !> 118270.)
   pure subroutine fill(problem, n, past, first, lag, component, p)
      class(constant_past), intent(inout) :: problem
      integer, intent(in), optional :: n, component(:)
      real(wp), intent(in), optional :: past(:), first(:), lag(:), p(:)

      if (present(n)) problem%n = n
      if (present(past)) problem%past = past
      if (present(first)) problem%first = first
      if (present(lag)) problem%lag = lag
      if (present(component)) problem%component = component
      if (present(p)) problem%p = p
      if (.not. allocated(problem%lag)) allocate (problem%lag(0), problem%component(0))
      if (.not. allocated(problem%p)) allocate (problem%p(0))
   end subroutine fill

   !> One equation with delay 1, from 1, unless something else is given.
   type(linear) function new_linear(n, lag, component, past, first, rate) result(problem)
      integer, intent(in), optional :: n, component(:)
      real(wp), intent(in), optional :: lag(:), past(:), first(:), rate

      call fill(problem, 1, [1.0_wp], [1.0_wp], [1.0_wp], [1], [1.0_wp])
      call fill(problem, n, past, first, lag, component)
      if (present(rate)) problem%p = [rate]
      problem%f => decay_of_past
      problem%analytic = .true.
   end function new_linear

   !> All components from 1, unless something else is given.
   type(wille_baker) function new_wille_baker(n, lag, component, past, first) result(problem)
      integer, intent(in), optional :: n, component(:)
      real(wp), intent(in), optional :: lag(:), past(:), first(:)

      call fill(problem, 3, spread(1.0_wp, 1, 3), spread(1.0_wp, 1, 3), [1.0_wp, 0.2_wp], [1, 2])
      call fill(problem, n, past, first, lag, component)
      problem%f => two_delays
      problem%analytic = .true.
   end function new_wille_baker

   !> The problem with its delay.
   type(sine) function new_sine() result(problem)
      call fill(problem, 1, first=[0.0_wp], lag=[0.5_wp*acos(-1.0_wp)], component=[1], p=[1.0_wp])
      problem%f => decay_of_past
      problem%exact => sine_at
      problem%past_terms => sine_series
      problem%analytic = .true.
   end function new_sine

   pure subroutine first_state(self, y)
      class(constant_past), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%first
   end subroutine first_state

   pure function value_before(self, t, component) result(value)
      class(constant_past), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value
      real(wp), allocatable :: y(:)

      if (allocated(self%past)) then
         value = self%past(component)
         return
      end if
      allocate (y(self%n))
      call self%exact(self%p, t, y)
      value = y(component)
   end function value_before

   pure subroutine series_before(self, t, component, unit, y)
      class(constant_past), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: component
      real(wp), intent(out) :: y(0:)

      if (associated(self%past_terms)) then
         call self%past_terms(self%p, t, unit, y)
      else
         y = 0.0_wp
         y(0) = self%past(component)
      end if
   end subroutine series_before

   pure subroutine slopes(self, t, y, z, dydt)
      class(constant_past), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      call self%f(self%p, t, y, z, dydt)
   end subroutine slopes

   !> If f is linear, each coefficient is f of those before.
   pure subroutine series_of_solution(self, t, unit, degree, z, y)
      class(constant_past), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: k

      if (associated(self%terms)) then
         call self%terms(self%p, t, unit, z, y)
         return
      end if
      do k = 0, degree - 1
         call self%f(self%p, t, y(k, :), z(k, :), y(k + 1, :))
         y(k + 1, :) = unit/(k + 1)*y(k + 1, :)
      end do
   end subroutine series_of_solution

   pure subroutine decay_of_past(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = -p(1)*z
   end subroutine decay_of_past

   pure subroutine two_delays(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = [z(1), z(1) + z(2), y(2)]
   end subroutine two_delays

   pure subroutine sine_at(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = sin(t)
   end subroutine sine_at

   !> The derivatives of sin are sines.
   pure subroutine sine_series(p, t, unit, y)
      real(wp), intent(in) :: p(:), t, unit
      real(wp), intent(out) :: y(0:)
      integer :: k

      do k = 0, ubound(y, 1)
         y(k) = unit**k/gamma(k + 1.0_wp)*sin(t + 0.5_wp*acos(-1.0_wp)*k)
      end do
   end subroutine sine_series
end module test_problems
