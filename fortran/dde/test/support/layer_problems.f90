!> A component that decays within a step and returns after the delay, with exact solutions: what is
!> wrong between the ends of the step shows in the other component.
module layer_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: layer, stages

   !> u1' = -r u1 + back u2(t - 1), u2' = share r u1(t - 1) - death u2, with u1(0) = 1 and else 0 up
   !> to t = 0.
   type, extends(constant_past) :: layer
      !> Share of the pulse that returns, share of it that the second component takes, rate at which
      !> that dies
      real(wp) :: back = 0.0_wp, share = 1.0_wp, death = 0.0_wp
   contains
      procedure :: rhs => layer_rhs
      procedure :: series => layer_series
      procedure :: exact => layer_exact
   end type layer

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

   !> A population: eggs hatch at the rate r, larvae live for one unit of time, a share of them
   !> become adults, which die at the rate 1.
   pure type(layer) function stages(rate) result(problem)
      real(wp), intent(in) :: rate

      problem = layer(rate)
      problem%share = 0.3_wp
      problem%death = 1.0_wp
   end function stages

   !> The equations.
   pure subroutine layer_rhs(self, t, y, z, dydt)
      class(layer), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = [-self%rate*y(1) + self%back*z(2), self%share*self%rate*z(1) - self%death*y(2)]
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
         y(k + 1, 2) = unit/(k + 1)*(self%share*self%rate*z(k, 1) - self%death*y(k, 2))
      end do
   end subroutine layer_series

   !> u2 at a time from 1 to 4: of a population, with a rate other than that of death, or of a layer
   !> whose pulse may return.
   pure real(wp) function layer_exact(self, t) result(u2)
      class(layer), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: s

      associate (r => self%rate, x => t - 1.0_wp)
         if (self%death > 0.0_wp) then
            u2 = self%share*r/(r - self%death)*(decay(self%death*x) - decay(r*x))
            return
         end if
         s = max(0.0_wp, t - 3.0_wp)
         u2 = 1.0_wp - decay(r*x) + self%back*(s*(1.0_wp + decay(r*s)) &
                                               - 2.0_wp/r*(1.0_wp - decay(r*s)))
      end associate
   end function layer_exact

   !> exp(-x) for x >= 0, without underflow.
   pure real(wp) function decay(x) result(value)
      real(wp), intent(in) :: x

      value = exp(-min(x, 700.0_wp))
   end function decay
end module layer_problems
