!> Ordinary differential equations, as delay equations without delays.
module undelayed_problems
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: blow_up, decay, falls_out, oscillator, quadrature, swing

   !> y' = (power + 1) t^power.
   type, extends(constant_past) :: quadrature
      !> Power of t
      integer :: power = 0
   contains
      procedure :: rhs => quadrature_rhs
      procedure :: series => quadrature_series
   end type quadrature

   interface quadrature
      module procedure :: new_quadrature
   end interface quadrature

   !> y' = -rate y.
   type, extends(constant_past) :: decay
   contains
      procedure :: rhs => decay_rhs
   end type decay

   interface decay
      module procedure :: new_decay
   end interface decay

   !> y1' = rate y2, y2' = -rate y1.
   type, extends(constant_past) :: oscillator
   contains
      procedure :: rhs => oscillator_rhs
      procedure :: series => oscillator_series
   end type oscillator

   !> y' = y^2: infinite at t = 1/y(0).
   type, extends(constant_past) :: blow_up
   contains
      procedure :: rhs => blow_up_rhs
      procedure :: series => blow_up_series
   end type blow_up

   interface blow_up
      module procedure :: new_blow_up
   end interface blow_up

   !> y' = 1 where t < 1, no number after.
   type, extends(constant_past) :: falls_out
   contains
      procedure :: rhs => falls_out_rhs
   end type falls_out

   interface falls_out
      module procedure :: new_falls_out
   end interface falls_out

contains

   !> From a first state.
   pure type(quadrature) function new_quadrature(power, first) result(problem)
      integer, intent(in) :: power
      real(wp), intent(in) :: first

      call fill(problem, 1, [first], [first])
      problem%analytic = .true.
      problem%power = power
   end function new_quadrature

   !> From y = 1.
   pure type(decay) function new_decay(rate) result(problem)
      real(wp), intent(in) :: rate

      call fill(problem, 1, [1.0_wp], [1.0_wp])
      problem%rate = rate
   end function new_decay

   !> From y = 1.
   pure type(blow_up) function new_blow_up() result(problem)
      call fill(problem, 1, [1.0_wp], [1.0_wp])
      problem%analytic = .true.
   end function new_blow_up

   !> From a first state.
   pure type(falls_out) function new_falls_out(first) result(problem)
      real(wp), intent(in) :: first

      call fill(problem, 1, [first], [first])
   end function new_falls_out

   !> An oscillator with y1 = cos(rate t), y2 = -sin(rate t); rate 1 if not given.
   pure type(oscillator) function swing(rate) result(problem)
      real(wp), intent(in), optional :: rate

      call fill(problem, 2, [1.0_wp, 0.0_wp], [1.0_wp, 0.0_wp])
      problem%analytic = .true.
      if (present(rate)) problem%rate = rate
   end function swing

   !> -rate y.
   pure subroutine decay_rhs(self, t, y, z, dydt)
      class(decay), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = -self%rate*y
   end subroutine decay_rhs

   !> y' = (power + 1) t^power.
   pure subroutine quadrature_rhs(self, t, y, z, dydt)
      class(quadrature), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = (self%power + 1)*t**self%power
   end subroutine quadrature_rhs

   !> Binomials of (t + unit s)**(power + 1).
   pure subroutine quadrature_series(self, t, unit, degree, z, y)
      class(quadrature), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: j, k

      y(1:, 1) = 0.0_wp
      do k = 1, min(degree, self%power + 1)
         y(k, 1) = unit**k*t**(self%power + 1 - k)*product([(self%power + 2.0_wp - j, j=1, k)]) &
                   /gamma(k + 1.0_wp)
      end do
   end subroutine quadrature_series

   !> y1' = rate y2, y2' = -rate y1.
   pure subroutine oscillator_rhs(self, t, y, z, dydt)
      class(oscillator), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = self%rate*[y(2), -y(1)]
   end subroutine oscillator_rhs

   !> Each coefficient follows from the one before.
   pure subroutine oscillator_series(self, t, unit, degree, z, y)
      class(oscillator), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: k

      do k = 0, degree - 1
         y(k + 1, :) = self%rate*unit/(k + 1)*[y(k, 2), -y(k, 1)]
      end do
   end subroutine oscillator_series

   !> y' = y^2.
   pure subroutine blow_up_rhs(self, t, y, z, dydt)
      class(blow_up), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = y**2
   end subroutine blow_up_rhs

   !> The square is a sum of products.
   pure subroutine blow_up_series(self, t, unit, degree, z, y)
      class(blow_up), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: k

      do k = 0, degree - 1
         y(k + 1, 1) = unit/(k + 1)*sum(y(0:k, 1)*y(k:0:-1, 1))
      end do
   end subroutine blow_up_series

   !> No number from t = 1 on.
   pure subroutine falls_out_rhs(self, t, y, z, dydt)
      class(falls_out), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = 1.0_wp
      if (t >= 1.0_wp) dydt = ieee_value(t, ieee_quiet_nan)
   end subroutine falls_out_rhs
end module undelayed_problems
