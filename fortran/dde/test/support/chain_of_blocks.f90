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

   !> Blocks computed at a time, and the highest degree of their series.
   integer, parameter :: lanes = 4, most_degree = 20

   !> Coefficients of v, of theta + (1 + epsilon) w(t - lag) and of unit w' of some blocks.
   type :: tile_type
      real(wp), dimension(lanes, 0:most_degree) :: v, relaxing, rate
   end type tile_type

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

   !> v' = v w' is linear in the state; w' follows from it term by term. Blocks are computed some
   !> at a time, since the recurrences of one wait for their own last terms. Coefficient k + 1 of
   !> a tile of blocks needs coefficient k of its neighbours: coefficients of a few tiles are
   !> computed in turn, from the last known to the first, and stay in the cache.
   pure subroutine series_of_chain(self, t, unit, degree, z, y)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      type(tile_type) :: tiles(0:most_degree)
      integer :: front, k, tile

      do front = 0, (size(self%lag) - 1)/lanes + degree - 1
         do k = max(0, front - (size(self%lag) - 1)/lanes), min(front, degree - 1)
            tile = front - k
            call take_up_coefficient(self, unit, degree, k, lanes*tile, z, y, &
                                     tiles(modulo(tile, degree)))
         end do
      end do
   end subroutine series_of_chain

   !> Coefficients k + 1 of the blocks of one tile.
   pure subroutine take_up_coefficient(self, unit, degree, k, first, z, y, tile)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: unit
      !> Degree; the coefficient known
      integer, intent(in) :: degree, k
      !> Blocks before those of the tile
      integer, intent(in) :: first
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      type(tile_type), intent(inout) :: tile
      real(wp), dimension(lanes) :: by_rate, by_relaxing, force, relaxing, u, w
      integer :: i, j, lane, last, m

      last = min(lanes, size(self%lag) - first)
      force = 0.0_wp
      relaxing = 0.0_wp
      do lane = 1, last
         j = first + lane
         i = 3*(j - 1)
         force(lane) = y(k, i + 2) + (y(k, i + 1) + y(k, i + 3))/self%xi
         if (j > 1) force(lane) = force(lane) + self%kappa*(y(k, i + 2) - y(k, i - 1))
         if (j < size(self%lag)) then
            force(lane) = force(lane) + self%kappa*(y(k, i + 2) - y(k, i + 5))
         end if
         relaxing(lane) = y(k, i + 1) + (1.0_wp + self%epsilon)*z(k, j)
      end do
      if (k == 0) then
         tile%v(:, 0) = 1.0_wp
         do lane = 1, last
            tile%v(lane, 0) = exp(y(0, 3*(first + lane)))
         end do
      end if
      by_rate = 0.0_wp
      by_relaxing = 0.0_wp
      do m = 0, k - 1
         by_rate = by_rate + tile%v(:, k - m)*tile%rate(:, m)
         by_relaxing = by_relaxing + tile%v(:, k - m)*tile%relaxing(:, m)
      end do
      force = -self%gamma**2*unit*force
      u = tile%v(:, k)
      if (k == 0) u = u - 1.0_wp
      w = (force - by_rate)/tile%v(:, 0)
      by_relaxing = by_relaxing + tile%v(:, 0)*relaxing
      tile%relaxing(:, k) = relaxing
      tile%rate(:, k) = w
      tile%v(:, k + 1) = force/(k + 1)
      do lane = 1, last
         i = 3*(first + lane - 1)
         y(k + 1, i + 1) = -unit/(k + 1)*by_relaxing(lane)
         y(k + 1, i + 2) = unit/(k + 1)*u(lane)
         y(k + 1, i + 3) = w(lane)/(k + 1)
      end do
   end subroutine take_up_coefficient
end module chain_of_blocks
