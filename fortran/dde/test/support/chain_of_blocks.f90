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

   !> Coefficients of v, of theta + (1 + epsilon) w(t - lag), of unit w' and of s w'(s) of some
   !> blocks.
   type :: tile_type
      real(wp), dimension(lanes, 0:most_degree) :: v, relaxing, rate, slope
   end type tile_type

   !> The chain.
   type, extends(constant_past) :: chain
      real(wp) :: epsilon = 0.5_wp, xi = 0.8_wp, gamma = 0.8_wp, kappa = 1.0_wp
   contains
      procedure :: rhs => rhs_of_chain
      procedure :: series => series_of_chain
      procedure :: relaxation_rate => relaxation_of_chain
      procedure :: slow_series => slow_series_of_chain
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

      call go_through_tiles(self, unit, degree, degree - 1, z, y, take_up_coefficient)
   end subroutine series_of_chain

   !> The least of the rates at which blocks approach their balances; 0 where these differ much:
   !> some blocks are then slow, and no step is in balance for long.
   pure real(wp) function relaxation_of_chain(self, t, y) result(rate)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)

      rate = 0.0_wp
      associate (w => y(3::3))
         if (maxval(w) - minval(w) < log(10.0_wp)) rate = self%gamma**2/self%xi*exp(-maxval(w))
      end associate
   end function relaxation_of_chain

   !> w = -theta - xi (u - kappa (second difference of u)) - (xi/gamma^2) v' with v' as it was.
   pure subroutine slow_series_of_chain(self, t, unit, degree, z, y)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)

      call go_through_tiles(self, unit, degree, degree, z, y, take_up_slow_coefficient)
   end subroutine slow_series_of_chain

   !> Blocks are computed some at a time, since the recurrences of one wait for their own last
   !> terms. Coefficient k + 1 of a tile of blocks needs coefficient k of its neighbours: those of
   !> a few tiles are computed in turn and stay in the cache.
   pure subroutine go_through_tiles(self, unit, degree, last, z, y, take_up)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: unit
      !> Degree; number of the last coefficient that is taken up
      integer, intent(in) :: degree, last
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      procedure(take_up_coefficient) :: take_up
      type(tile_type) :: tiles(0:most_degree)
      integer :: front, k

      associate (last_tile => (size(self%lag) - 1)/lanes)
         do front = 0, last_tile + last
            do k = max(0, front - last_tile), min(front, last)
               call take_up(self, unit, degree, k, lanes*(front - k), z, y, &
                            tiles(modulo(front - k, last + 1)))
            end do
         end do
      end associate
   end subroutine go_through_tiles

   !> u - kappa (second difference of u) of block j, coefficient k.
   pure real(wp) function pull(self, degree, k, j, y) result(value)
      class(chain), intent(in) :: self
      integer, intent(in) :: degree, k, j
      real(wp), intent(in) :: y(0:degree, self%n)

      associate (u => y(k, 3*j - 1))
         value = u
         if (j > 1) value = value + self%kappa*(u - y(k, 3*j - 4))
         if (j < size(self%lag)) value = value + self%kappa*(u - y(k, 3*j + 2))
      end associate
   end function pull

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
         force(lane) = pull(self, degree, k, j, y) + (y(k, i + 1) + y(k, i + 3))/self%xi
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

   !> Coefficients k of w and k + 1 of theta and u, of the blocks of one tile. Its `rate` is unit v'
   !> as it was.
   pure subroutine take_up_slow_coefficient(self, unit, degree, k, first, z, y, tile)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: unit
      integer, intent(in) :: degree, k, first
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      type(tile_type), intent(inout) :: tile
      real(wp), dimension(lanes) :: by_relaxing, relaxing, v, w
      integer :: i, j, lane, last, m

      last = min(lanes, size(self%lag) - first)
      w = 0.0_wp
      relaxing = 0.0_wp
      do lane = 1, last
         j = first + lane
         i = 3*(j - 1)
         if (k == 0) call find_last_rate(unit, degree, y(:, i + 2), y(:, i + 3), tile%rate(lane, :))
         w(lane) = -y(k, i + 1) - self%xi*pull(self, degree, k, j, y) &
                   - self%xi/(self%gamma**2*unit)*tile%rate(lane, k)
         relaxing(lane) = y(k, i + 1) + (1.0_wp + self%epsilon)*z(k, j)
         y(k, i + 3) = w(lane)
      end do
      tile%slope(:, k) = k*w
      tile%relaxing(:, k) = relaxing
      v = 0.0_wp
      by_relaxing = 0.0_wp
      do m = 1, k
         v = v + tile%v(:, k - m)*tile%slope(:, m)
         by_relaxing = by_relaxing + tile%v(:, k - m)*tile%relaxing(:, m)
      end do
      if (k == 0) v = exp(w)
      tile%v(:, k) = v/max(1, k)
      by_relaxing = by_relaxing + tile%v(:, k)*tile%relaxing(:, 0)
      if (k == degree) return
      do lane = 1, last
         i = 3*(first + lane - 1)
         y(k + 1, i + 1) = -unit/(k + 1)*by_relaxing(lane)
         y(k + 1, i + 2) = unit/(k + 1)*(tile%v(lane, k) - merge(1.0_wp, 0.0_wp, k == 0))
      end do
   end subroutine take_up_slow_coefficient

   !> Coefficients of unit v', by u' = v - 1; the last, for which those of u do not suffice, by
   !> v' = w' v.
   pure subroutine find_last_rate(unit, degree, u, w, rate)
      real(wp), intent(in) :: unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: u(0:degree), w(0:degree)
      real(wp), intent(out) :: rate(0:most_degree)
      integer :: k

      rate(degree - 1:) = 0.0_wp
      do k = 0, degree - 2
         rate(k) = (k + 1)*(k + 2)/unit*u(k + 2)
      end do
      rate(degree - 1) = degree*w(degree)*exp(w(0))
      do k = 1, degree - 1
         rate(degree - 1) = rate(degree - 1) + k*w(k)*rate(degree - k - 1)/(degree - k)
      end do
   end subroutine find_last_rate
end module chain_of_blocks
