! SPDX-License-Identifier: BSD-3-Clause
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

   !> Highest degree of series.
   integer, parameter :: most_degree = 20

   !> Of one block: coefficients of v, the last first, of theta + (1 + epsilon) w(t - lag), of unit
   !> w' or s w'(s), and of unit v' as it was; 1/v at the start.
   type :: block_type
      real(wp), dimension(0:most_degree) :: v_back, relaxing, rate, v_rate
      real(wp) :: by_v
   end type block_type

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
      real(wp) :: delayed_w, force, v
      integer :: i, j

      do j = 1, self%n/3
         i = 3*(j - 1)
         v = exp(y(i + 3))
         force = y(i + 2) + (y(i + 1) + y(i + 3))/self%xi
         if (j > 1) force = force + self%kappa*(y(i + 2) - y(i - 1))
         if (3*j < self%n) force = force + self%kappa*(y(i + 2) - y(i + 5))
         delayed_w = y(i + 3)
         if (size(z) > 0) delayed_w = z(j)
         dydt(i + 1) = -v*(y(i + 1) + (1.0_wp + self%epsilon)*delayed_w)
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
      type(block_type) :: blocks(0:most_degree)
      integer :: front, k

      do front = 0, self%n/3 + degree - 2
         do k = max(0, front - self%n/3 + 1), min(front, degree - 1)
            call take_up_coefficient(self, unit, degree, k, front - k + 1, z, y, &
                                     blocks(modulo(front - k, degree)))
         end do
      end do
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
   !> Coefficient k + 1 of a block needs coefficient k of its neighbours: those of a few blocks are
   !> computed in turn and stay in the cache.
   pure subroutine slow_series_of_chain(self, t, unit, degree, z, y)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      type(block_type) :: blocks(0:most_degree)
      integer :: front, k

      do front = 0, self%n/3 + degree - 1
         do k = max(0, front - self%n/3 + 1), min(front, degree)
            call take_up_slow_coefficient(self, unit, degree, k, front - k + 1, z, y, &
                                          blocks(modulo(front - k, degree + 1)))
         end do
      end do
   end subroutine slow_series_of_chain

   !> u - kappa (second difference of u) of block j, coefficient k.
   pure real(wp) function pull(self, degree, k, j, y) result(value)
      class(chain), intent(in) :: self
      integer, intent(in) :: degree, k, j
      real(wp), intent(in) :: y(0:degree, self%n)

      associate (u => y(k, 3*j - 1))
         value = u
         if (j > 1) value = value + self%kappa*(u - y(k, 3*j - 4))
         if (3*j < self%n) value = value + self%kappa*(u - y(k, 3*j + 2))
      end associate
   end function pull

   !> theta + (1 + epsilon) w(t - lag) of block j, coefficient k; w itself without delay.
   pure real(wp) function relaxing(self, degree, k, j, z, y) result(value)
      class(chain), intent(in) :: self
      integer, intent(in) :: degree, k, j
      real(wp), intent(in) :: z(0:degree, size(self%lag)), y(0:degree, self%n)
      real(wp) :: delayed_w

      delayed_w = y(k, 3*j)
      if (size(self%lag) > 0) delayed_w = z(k, j)
      value = y(k, 3*j - 2) + (1.0_wp + self%epsilon)*delayed_w
   end function relaxing

   !> Coefficients k + 1 of block j.
   pure subroutine take_up_coefficient(self, unit, degree, k, j, z, y, of)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: unit
      !> Degree; the coefficient known; the block
      integer, intent(in) :: degree, k, j
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      type(block_type), intent(inout) :: of
      real(wp) :: earlier, share, total, v, v_rate
      integer :: m

      if (k == 0) then
         of%v_back(degree) = exp(y(0, 3*j))
         of%by_v = 1.0_wp/of%v_back(degree)
      end if
      share = 1.0_wp/(k + 1)
      ! first what has been known for long: the newest terms need not wait for it
      total = 0.0_wp
      earlier = 0.0_wp
      do m = 0, k - 1
         total = total + of%v_back(degree - k + m)*of%relaxing(m)
         earlier = earlier + of%v_back(degree - k + m)*of%rate(m)
      end do
      v = of%v_back(degree - k)
      if (k == 0) v = v - 1.0_wp
      v_rate = -self%gamma**2*unit*(pull(self, degree, k, j, y) &
                                    + (1.0_wp/self%xi)*(y(k, 3*j - 2) + y(k, 3*j)))
      of%relaxing(k) = relaxing(self, degree, k, j, z, y)
      of%rate(k) = of%by_v*(v_rate - earlier)
      of%v_back(degree - k - 1) = share*v_rate
      y(k + 1, 3*j - 2) = -unit*share*(total + of%v_back(degree)*of%relaxing(k))
      y(k + 1, 3*j - 1) = unit*share*v
      y(k + 1, 3*j) = share*of%rate(k)
   end subroutine take_up_coefficient

   !> Coefficients k of w and k + 1 of theta and u, of block j.
   pure subroutine take_up_slow_coefficient(self, unit, degree, k, j, z, y, of)
      class(chain), intent(in) :: self
      real(wp), intent(in) :: unit
      integer, intent(in) :: degree, k, j
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      type(block_type), intent(inout) :: of
      real(wp) :: earlier, total, v
      integer :: m

      if (k == 0) call find_last_rate(unit, degree, y(:, 3*j - 1), y(:, 3*j), of%v_rate)
      y(k, 3*j) = -y(k, 3*j - 2) &
                  - self%xi*(pull(self, degree, k, j, y) + of%v_rate(k)/(self%gamma**2*unit))
      of%relaxing(k) = relaxing(self, degree, k, j, z, y)
      of%rate(k) = k*y(k, 3*j)
      total = 0.0_wp
      earlier = 0.0_wp
      do m = 1, k - 1
         total = total + of%v_back(degree - k + m)*of%relaxing(m)
         earlier = earlier + of%v_back(degree - k + m)*of%rate(m)
      end do
      if (k == 0) then
         v = exp(y(0, 3*j))
         total = v*of%relaxing(0)
      else
         v = (earlier + of%v_back(degree)*of%rate(k))/k
         total = total + of%v_back(degree)*of%relaxing(k) + v*of%relaxing(0)
      end if
      of%v_back(degree - k) = v
      if (k == degree) return
      y(k + 1, 3*j - 2) = -unit/(k + 1)*total
      y(k + 1, 3*j - 1) = unit/(k + 1)*(v - merge(1.0_wp, 0.0_wp, k == 0))
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
