!> Problems with a component that decays within a step and returns after the delay, with exact
!> solutions: what is wrong between the ends of the step shows in the other components.
module layer_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: layer, stages

   !> u1' = -r u1 + back u2(t - 1), u2' = r u1(t - 1), u1(0) = 1, else 0 up to t = 0.
   type, extends(constant_past) :: layer
      !> Share of the pulse that returns
      real(wp) :: back = 0.0_wp
   contains
      procedure :: rhs => layer_rhs
      procedure :: series => layer_series
      procedure :: exact => layer_exact
   end type layer

   interface layer
      module procedure :: new_layer
   end interface layer

   !> A population: eggs hatch at the rate r, larvae live for one unit of time, a share of them
   !> become adults, which die at the rate 1: u1' = -r u1, u2' = share r u1(t - 1) - u2, one egg at
   !> the start.
   type, extends(constant_past) :: stages
   contains
      procedure :: rhs => stages_rhs
      procedure :: series => stages_series
      procedure :: exact => stages_exact
   end type stages

   interface stages
      module procedure :: new_stages
   end interface stages

   !> Share of larvae that become adults.
   real(wp), parameter :: share = 0.3_wp

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
         y(k + 1, 2) = unit/(k + 1)*self%rate*z(k, 1)
      end do
   end subroutine layer_series

   !> u2 at a time from 1 to 4.
   pure real(wp) function layer_exact(self, t) result(u2)
      class(layer), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: s

      u2 = 1.0_wp - decay(self%rate*(t - 1.0_wp))
      s = max(0.0_wp, t - 3.0_wp)
      u2 = u2 + self%back*(s*(1.0_wp + decay(self%rate*s)) &
                           - 2.0_wp/self%rate*(1.0_wp - decay(self%rate*s)))
   end function layer_exact

   !> The population.
   pure type(stages) function new_stages(rate) result(problem)
      real(wp), intent(in) :: rate

      call fill(problem, 2, [0.0_wp, 0.0_wp], [1.0_wp, 0.0_wp], [1.0_wp], [1])
      problem%analytic = .true.
      problem%rate = rate
   end function new_stages

   !> The equations.
   pure subroutine stages_rhs(self, t, y, z, dydt)
      class(stages), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = [-self%rate*y(1), share*self%rate*z(1) - y(2)]
   end subroutine stages_rhs

   !> Term by term.
   pure subroutine stages_series(self, t, unit, degree, z, y)
      class(stages), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: k

      do k = 0, degree - 1
         y(k + 1, 1) = -unit/(k + 1)*self%rate*y(k, 1)
         y(k + 1, 2) = unit/(k + 1)*(share*self%rate*z(k, 1) - y(k, 2))
      end do
   end subroutine stages_series

   !> Adults at a time from 1 on, for a rate other than 1.
   pure real(wp) function stages_exact(self, t) result(adults)
      class(stages), intent(in) :: self
      real(wp), intent(in) :: t

      associate (r => self%rate, x => t - 1.0_wp)
         adults = share*r/(r - 1.0_wp)*(decay(x) - decay(r*x))
      end associate
   end function stages_exact

   !> exp(-x) for x >= 0, without underflow.
   pure real(wp) function decay(x) result(value)
      real(wp), intent(in) :: x

      value = exp(-min(x, 700.0_wp))
   end function decay
end module layer_problems
