!> Taylor series of solutions of the block's equation (4), in powers of a unit of time: coefficients
!> of products and of exp(w) from those of their factors, term by term (Jorba and Zou 2005, "A
!> software package for the numerical integration of ODEs by means of high-order Taylor methods",
!> sec. 2). The series of v stands beside those of theta, u and w = ln v. All quantities are
!> nondimensional.
module block_series
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use block_state, only: index_of_ln_v, index_of_theta, index_of_u, largest_ln_v, least_ln_v
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: series_of_block, slow_series_of_block

contains

   !> Series of the solution: v' = v w' is -gamma^2 [u + (theta + w)/xi], linear in the state, and
   !> w' follows from it term by term.
   pure subroutine series_of_block(epsilon, xi, gamma, unit, degree, delays, z, y)
      !> Sensitivity of the velocity relaxation
      real(wp), intent(in) :: epsilon
      !> Spring constant
      real(wp), intent(in) :: xi
      !> Frequency
      real(wp), intent(in) :: gamma
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Degree of the series
      integer, intent(in) :: degree
      !> Number of delayed values, 0 or 1
      integer, intent(in) :: delays
      !> Coefficients of w(t - tau), or nothing
      real(wp), intent(in) :: z(0:degree, delays)
      !> Coefficients of theta, u, w; y(0, :) is given
      real(wp), intent(inout) :: y(0:degree, 3)
      !> Coefficients of v, the last first, of theta + (1 + epsilon) w(t - tau), and of unit w'
      real(wp), dimension(0:degree) :: v_back, relaxing, rate
      real(wp) :: by_v, compliance, delayed_w, earlier, pull, share, theta, total, u, v, v_rate, w
      integer :: j, k

      if (y(0, index_of_ln_v) < least_ln_v .or. y(0, index_of_ln_v) > largest_ln_v) then
         y(1:, :) = ieee_value(1.0_wp, ieee_quiet_nan)
         return
      end if
      theta = y(0, index_of_theta)
      u = y(0, index_of_u)
      w = y(0, index_of_ln_v)
      v = exp(w)
      v_back(degree) = v
      by_v = 1.0_wp/v
      compliance = 1.0_wp/xi
      pull = -gamma**2*unit
      do k = 0, degree - 1
         ! first what has been known for long: the newest terms need not wait for it
         total = 0.0_wp
         earlier = 0.0_wp
         do j = 0, k - 1
            total = total + v_back(degree - k + j)*relaxing(j)
            earlier = earlier + v_back(degree - k + j)*rate(j)
         end do
         delayed_w = w
         if (delays > 0) delayed_w = z(k, 1)
         relaxing(k) = theta + (1.0_wp + epsilon)*delayed_w
         v_rate = pull*(u + compliance*(theta + w))
         rate(k) = by_v*(v_rate - earlier)
         share = 1.0_wp/(k + 1)
         theta = -unit*share*(total + v_back(degree)*relaxing(k))
         u = unit*share*merge(v - 1.0_wp, v, k == 0)
         w = share*rate(k)
         v = share*v_rate
         y(k + 1, index_of_theta) = theta
         y(k + 1, index_of_u) = u
         y(k + 1, index_of_ln_v) = w
         v_back(degree - k - 1) = v
      end do
   end subroutine series_of_block

   !> A better series of the slow solution: w = -theta - xi u - (xi/gamma^2) v' with v' as it was,
   !> and theta and u by (4).
   pure subroutine slow_series_of_block(epsilon, xi, gamma, unit, degree, delays, z, y)
      !> Sensitivity of the velocity relaxation
      real(wp), intent(in) :: epsilon
      !> Spring constant
      real(wp), intent(in) :: xi
      !> Frequency
      real(wp), intent(in) :: gamma
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Degree of the series
      integer, intent(in) :: degree
      !> Number of delayed values, 0 or 1
      integer, intent(in) :: delays
      !> Coefficients of w(t - tau), or nothing
      real(wp), intent(in) :: z(0:degree, delays)
      !> Coefficients of theta, u, w as they were; better ones
      real(wp), intent(inout) :: y(0:degree, 3)
      !> Coefficients of w, of v, of theta + (1 + epsilon) w(t - tau), and of unit v' as it was
      real(wp), dimension(0:degree) :: w, v, relaxing, v_rate
      real(wp) :: inertia, share, total
      integer :: j, k

      w = y(:, index_of_ln_v)
      v_rate = 0.0_wp
      v(0) = exp(min(w(0), largest_ln_v))
      do k = 1, degree
         v(k) = term_of_exponential(k, w(1:k), v(:k - 1))
         v_rate(k - 1) = k*v(k)
      end do
      inertia = xi/(gamma**2*unit)
      do k = 0, degree
         w(k) = -y(k, index_of_theta) - xi*y(k, index_of_u) - inertia*v_rate(k)
         if (k == 0) then
            if (w(0) < least_ln_v .or. w(0) > largest_ln_v) exit
            v(0) = exp(w(0))
         else
            v(k) = term_of_exponential(k, w(1:k), v(:k - 1))
         end if
         if (k == degree) then
            y(:, index_of_ln_v) = w
            return
         end if
         relaxing(k) = w(k)
         if (delays > 0) relaxing(k) = z(k, 1)
         relaxing(k) = y(k, index_of_theta) + (1.0_wp + epsilon)*relaxing(k)
         total = 0.0_wp
         do j = 0, k
            total = total + v(k - j)*relaxing(j)
         end do
         share = unit/(k + 1)
         y(k + 1, index_of_theta) = -share*total
         y(k + 1, index_of_u) = share*merge(v(0) - 1.0_wp, v(k), k == 0)
      end do
      y = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine slow_series_of_block

   !> Coefficient k of v = exp(w): v' = w' v.
   pure function term_of_exponential(k, w, v) result(term)
      !> Which, > 0
      integer, intent(in) :: k
      !> Coefficients of w, the first left out
      real(wp), intent(in) :: w(k)
      !> Coefficients of v below k
      real(wp), intent(in) :: v(0:k - 1)
      real(wp) :: term
      integer :: j

      term = 0.0_wp
      do j = 1, k
         term = term + j*w(j)*v(k - j)
      end do
      term = term/k
   end function term_of_exponential
end module block_series
