! SPDX-License-Identifier: BSD-3-Clause
!> Delay equations with exact solutions (Wille and Baker 1992; Hairer, Norsett and Wanner 1993, sec.
!> II.17), and what all problems of the tests share.
module test_problems
   use dde, only: problem_with_tangents
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: constant_past, fill, linear, sine, wille_baker

   !> The start of every problem here that has one: constant history and first state.
   type, extends(problem_with_tangents), abstract :: constant_past
      !> History and first state, shape (n)
      real(wp), allocatable :: past(:), first(:)
      !> Rate, where a problem has one
      real(wp) :: rate = 1.0_wp
   contains
      procedure :: initial => first_state
      procedure :: history => constant_history
      procedure :: past_series => constant_series
   end type constant_past

   !> y' = -rate y(t - lag).
   type, extends(constant_past) :: linear
   contains
      procedure :: rhs => linear_rhs
      procedure :: series => linear_series
   end type linear

   interface linear
      module procedure :: new_linear
   end interface linear

   !> Two delays: y1' = y1(t-1), y2' = y1(t-1) + y2(t-0.2), y3' = y2.
   type, extends(constant_past) :: wille_baker
   contains
      procedure :: rhs => wille_baker_rhs
      procedure :: series => wille_baker_series
   end type wille_baker

   interface wille_baker
      module procedure :: new_wille_baker
   end interface wille_baker

   !> y' = -y(t - pi/2) with the history sin t: y = sin t.
   type, extends(linear) :: sine
   contains
      procedure :: history => sine_history
      procedure :: past_series => sine_past_series
   end type sine

   interface sine
      module procedure :: new_sine
   end interface sine

contains

   !> Fill what every problem has, as far as it is given; without delays if none are. (flang 19
   !> crashes on structure constructors with components of a parent type, llvm-project issue 118270;
   !> so each type has a function of its name.)
   pure subroutine fill(problem, n, past, first, lag, component)
      class(constant_past), intent(inout) :: problem
      integer, intent(in), optional :: n, component(:)
      real(wp), intent(in), optional :: past(:), first(:), lag(:)

      if (present(n)) problem%n = n
      if (present(past)) problem%past = past
      if (present(first)) problem%first = first
      if (present(lag)) problem%lag = lag
      if (present(component)) problem%component = component
      if (.not. allocated(problem%lag)) allocate (problem%lag(0), problem%component(0))
   end subroutine fill

   !> One equation with delay 1, from 1, unless something else is given.
   pure type(linear) function new_linear(n, lag, component, past, first, rate) result(problem)
      integer, intent(in), optional :: n, component(:)
      real(wp), intent(in), optional :: lag(:), past(:), first(:), rate

      call fill(problem, 1, [1.0_wp], [1.0_wp], [1.0_wp], [1])
      call fill(problem, n, past, first, lag, component)
      if (present(rate)) problem%rate = rate
      problem%analytic = .true.
   end function new_linear

   !> All components from 1, unless something else is given.
   pure type(wille_baker) function new_wille_baker(n, lag, component, past, first) result(problem)
      integer, intent(in), optional :: n, component(:)
      real(wp), intent(in), optional :: lag(:), past(:), first(:)

      call fill(problem, 3, spread(1.0_wp, 1, 3), spread(1.0_wp, 1, 3), [1.0_wp, 0.2_wp], [1, 2])
      call fill(problem, n, past, first, lag, component)
      problem%analytic = .true.
   end function new_wille_baker

   !> The first state.
   pure subroutine first_state(self, y)
      class(constant_past), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%first
   end subroutine first_state

   !> The same value at all times before the initial time.
   pure function constant_history(self, t, component) result(value)
      class(constant_past), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%past(component) + 0.0_wp*t
   end function constant_history

   !> Its series.
   pure subroutine constant_series(self, t, component, unit, y)
      class(constant_past), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: component
      real(wp), intent(out) :: y(0:)

      y = 0.0_wp
      y(0) = self%past(component)
   end subroutine constant_series

   !> z = y(t - lag).
   pure subroutine linear_rhs(self, t, y, z, dydt)
      class(linear), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = -self%rate*z
   end subroutine linear_rhs

   !> Each coefficient follows from that of z.
   pure subroutine linear_series(self, t, unit, degree, z, y)
      class(linear), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: k

      do k = 0, degree - 1
         y(k + 1, :) = -self%rate*unit/(k + 1)*z(k, :)
      end do
   end subroutine linear_series

   !> z = (y1(t-1), y2(t-0.2)).
   pure subroutine wille_baker_rhs(self, t, y, z, dydt)
      class(wille_baker), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = [z(1), z(1) + z(2), y(2)]
   end subroutine wille_baker_rhs

   !> Each coefficient follows from those of y2 and z.
   pure subroutine wille_baker_series(self, t, unit, degree, z, y)
      class(wille_baker), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: k

      do k = 0, degree - 1
         y(k + 1, :) = unit/(k + 1)*[z(k, 1), z(k, 1) + z(k, 2), y(k, 2)]
      end do
   end subroutine wille_baker_series

   !> The problem with its delay.
   pure type(sine) function new_sine() result(problem)
      call fill(problem, 1, [0.0_wp], [0.0_wp], [0.5_wp*acos(-1.0_wp)], [1])
      problem%analytic = .true.
   end function new_sine

   !> sin t.
   pure function sine_history(self, t, component) result(value)
      class(sine), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = sin(t)
   end function sine_history

   !> The derivatives of sin are sines.
   pure subroutine sine_past_series(self, t, component, unit, y)
      class(sine), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: component
      real(wp), intent(out) :: y(0:)
      integer :: k

      do k = 0, ubound(y, 1)
         y(k) = unit**k/gamma(k + 1.0_wp)*sin(t + self%lag(1)*k)
      end do
   end subroutine sine_past_series
end module test_problems
