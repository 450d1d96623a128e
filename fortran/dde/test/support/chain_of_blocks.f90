!> A chain of spring blocks with delayed friction and free ends: for block j, with w = ln v,
!>
!>     theta' = -v [theta + (1 + epsilon) w(t - lag)],   u' = v - 1,
!>     v w' = -gamma^2 [u - kappa (second difference of u) + (theta + w)/xi].
!>
!> Components stand block by block: theta, u, w. Blocks start apart from each other.
module chain_of_blocks
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: chain

   !> The chain.
   type, extends(constant_past) :: chain
      real(wp) :: epsilon = 0.5_wp, xi = 0.8_wp, gamma = 0.8_wp, kappa = 1.0_wp
   contains
      procedure :: rhs => rhs_of_chain
      procedure :: series => series_of_chain
   end type chain

   interface chain
      module procedure :: new_chain
   end interface chain

contains

   !> The chain with its parameters.
   type(chain) function new_chain(blocks, gamma, tau, spread) result(problem)
      integer, intent(in) :: blocks
      real(wp), intent(in), optional :: gamma
      !> Delay, 10 unless given
      real(wp), intent(in), optional :: tau
      !> Relative difference between the longest and the shortest delay; none unless given
      real(wp), intent(in), optional :: spread
      integer :: j

      if (present(gamma)) problem%gamma = gamma
      allocate (problem%lag(blocks), source=10.0_wp)
      if (present(tau)) problem%lag = tau
      if (present(spread)) then
         problem%lag = problem%lag*[(1.0_wp + spread*(j - 1)/max(1, blocks - 1), j=1, blocks)]
      end if
      problem%component = [(3*j, j=1, blocks)]
      problem%rows = reshape([(3*j - 2, 3*j - 2, j=1, blocks)], [2, blocks])
      allocate (problem%past(3*blocks), source=0.0_wp)
      do j = 1, blocks
         problem%past(3*j - 1) = 0.1_wp*sin(real(j, wp))
         problem%past(3*j) = log(1.5_wp) + 0.2_wp*cos(2.0_wp*j)
      end do
      call fill(problem, 3*blocks, first=problem%past)
   end function new_chain

   pure subroutine rhs_of_chain(self, t, y, z, dydt)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: force, v
      integer :: i, j

      do j = 1, size(z)
         i = 3*(j - 1)
         v = exp(y(i + 3))
         force = y(i + 2) + (y(i + 1) + y(i + 3))/self%xi
         if (j > 1) force = force + self%kappa*(y(i + 2) - y(i - 1))
         if (j < size(z)) force = force + self%kappa*(y(i + 2) - y(i + 5))
         dydt(i + 1) = -v*(y(i + 1) + (1.0_wp + self%epsilon)*z(j))
         dydt(i + 2) = v - 1.0_wp
         dydt(i + 3) = -self%gamma**2/v*force
      end do
   end subroutine rhs_of_chain

   !> v' = v w' is linear in the state; w' follows from it term by term.
   pure subroutine series_of_chain(self, t, unit, degree, z, y)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp), allocatable, dimension(:, :) :: rate, relaxing, v
      real(wp) :: force, total
      integer :: i, j, k, m

      associate (blocks => size(self%lag))
         allocate (rate(0:degree, blocks), relaxing(0:degree, blocks), v(0:degree, blocks))
         v(0, :) = exp(y(0, 3::3))
         do k = 0, degree - 1
            do j = 1, blocks
               i = 3*(j - 1)
               force = y(k, i + 2) + (y(k, i + 1) + y(k, i + 3))/self%xi
               if (j > 1) force = force + self%kappa*(y(k, i + 2) - y(k, i - 1))
               if (j < blocks) force = force + self%kappa*(y(k, i + 2) - y(k, i + 5))
               force = -self%gamma**2*unit*force
               relaxing(k, j) = y(k, i + 1) + (1.0_wp + self%epsilon)*z(k, j)
               total = force
               do m = 0, k - 1
                  total = total - v(k - m, j)*rate(m, j)
               end do
               rate(k, j) = total/v(0, j)
               total = 0.0_wp
               do m = 0, k
                  total = total + v(k - m, j)*relaxing(m, j)
               end do
               y(k + 1, i + 1) = -unit*total/(k + 1)
               y(k + 1, i + 2) = unit*merge(v(0, j) - 1.0_wp, v(k, j), k == 0)/(k + 1)
               y(k + 1, i + 3) = rate(k, j)/(k + 1)
               v(k + 1, j) = force/(k + 1)
            end do
         end do
      end associate
   end subroutine series_of_chain
end module chain_of_blocks
