!> Delay equations with published solutions (Hairer, Norsett and Wanner 1993, sec. II.17; Guglielmi
!> and Hairer 2001; Mackey and Glass 1977).
module published_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: enzyme, infection, mackey_glass

   !> An infection: delays 1 and 10.
   type, extends(constant_past) :: infection
   contains
      procedure :: rhs => infection_rhs
      procedure :: series => infection_series
   end type infection

   interface infection
      module procedure :: new_infection
   end interface infection

   !> Enzyme kinetics with inhibition.
   type, extends(constant_past) :: enzyme
   contains
      procedure :: rhs => enzyme_rhs
   end type enzyme

   interface enzyme
      module procedure :: new_enzyme
   end interface enzyme

   !> y' = 0.2 y(t-17)/(1 + y(t-17)^10) - 0.1 y.
   type, extends(constant_past) :: mackey_glass
   contains
      procedure :: rhs => mackey_glass_rhs
      procedure :: series => mackey_glass_series
   end type mackey_glass

   interface mackey_glass
      module procedure :: new_mackey_glass
   end interface mackey_glass

contains

   !> The problem with its components.
   pure type(infection) function new_infection(n, lag, component, past, first) result(problem)
      integer, intent(in) :: n, component(:)
      real(wp), intent(in) :: lag(:), past(:), first(:)

      call fill(problem, n, past, first, lag, component)
      problem%analytic = .true.
   end function new_infection

   !> The problem with its components.
   pure type(enzyme) function new_enzyme(n, lag, component, past, first) result(problem)
      integer, intent(in) :: n, component(:)
      real(wp), intent(in) :: lag(:), past(:), first(:)

      call fill(problem, n, past, first, lag, component)
   end function new_enzyme

   !> The problem with its components.
   pure type(mackey_glass) function new_mackey_glass(n, lag, component, past, first) result(problem)
      integer, intent(in) :: n, component(:)
      real(wp), intent(in) :: lag(:), past(:), first(:)

      call fill(problem, n, past, first, lag, component)
      problem%analytic = .true.
   end function new_mackey_glass

   !> z = (y2(t-1), y2(t-10)).
   pure subroutine infection_rhs(self, t, y, z, dydt)
      class(infection), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = [-y(1)*z(1) + z(2), y(1)*z(1) - y(2), y(2) - z(2)]
   end subroutine infection_rhs

   !> The product y1 z1 is a sum of products.
   pure subroutine infection_series(self, t, unit, degree, z, y)
      class(infection), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp) :: infected
      integer :: k

      do k = 0, degree - 1
         infected = sum(y(0:k, 1)*z(k:0:-1, 1))
         y(k + 1, :) = unit/(k + 1)*[z(k, 2) - infected, infected - y(k, 2), y(k, 2) - z(k, 2)]
      end do
   end subroutine infection_series

   !> z = y4(t-4).
   pure subroutine enzyme_rhs(self, t, y, z, dydt)
      class(enzyme), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: flow

      flow = y(1)/(1.0_wp + 0.0005_wp*z(1)**3)
      dydt = [10.5_wp - flow, flow - y(2), y(2) - y(3), y(3) - 0.5_wp*y(4)]
   end subroutine enzyme_rhs

   !> z = y(t-17).
   pure subroutine mackey_glass_rhs(self, t, y, z, dydt)
      class(mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = 0.2_wp*z/(1.0_wp + z**10) - 0.1_wp*y
   end subroutine mackey_glass_rhs

   !> power = z^10 by z power' = 10 power z', gain = z/(1 + power) by gain (1 + power) = z.
   pure subroutine mackey_glass_series(self, t, unit, degree, z, y)
      class(mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp), dimension(0:degree) :: gain, power
      integer :: j
      integer :: k

      power(0) = z(0, 1)**10
      do k = 1, degree
         power(k) = sum([((11*j - k)*z(j, 1)*power(k - j), j=1, k)])/(k*z(0, 1))
      end do
      do k = 0, degree - 1
         gain(k) = (z(k, 1) - sum(power(1:k)*gain(k - 1:0:-1)))/(1.0_wp + power(0))
         y(k + 1, 1) = unit/(k + 1)*(0.2_wp*gain(k) - 0.1_wp*y(k, 1))
      end do
   end subroutine mackey_glass_series
end module published_problems
