!> Taylor series of solutions of the block's equation (4), in powers of a unit of time: coefficients
!> of products and of exp(w) from those of their factors, term by term (Jorba and Zou 2005, "A
!> software package for the numerical integration of ODEs by means of high-order Taylor methods",
!> sec. 2). The series of v stands beside those of theta, u and w = ln v. All quantities are
!> nondimensional.
module block_series
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use block_parameters, only: block_parameters_type
   use block_state, only: index_of_ln_v, index_of_theta, index_of_u, largest_ln_v, least_ln_v
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: series_of_block, slow_series_of_block

contains

   !> Series of the solution: v' = v w' is -gamma^2 [u + (theta + w)/xi], linear in the state, and
   !> w' follows from it term by term.
   pure subroutine series_of_block(p, unit, degree, delays, z, y)
      !> Parameters of the block
      type(block_parameters_type), intent(in) :: p
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Degree of the series; number of delayed values, 0 or 1
      integer, intent(in) :: degree, delays
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
      compliance = 1.0_wp/p%xi
      pull = -p%gamma**2*unit
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
         relaxing(k) = theta + (1.0_wp + p%epsilon)*delayed_w
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

   !> A better series of the slow solution: w = -theta - xi u - (xi/gamma^2) v' with v as it was,
   !> and theta and u by (4).
   pure subroutine slow_series_of_block(p, unit, degree, delays, z, y)
      !> Parameters of the block
      type(block_parameters_type), intent(in) :: p
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Degree of the series; number of delayed values, 0 or 1
      integer, intent(in) :: degree, delays
      !> Coefficients of w(t - tau), or nothing
      real(wp), intent(in) :: z(0:degree, delays)
      !> Coefficients of theta, u, w as they were; better ones
      real(wp), intent(inout) :: y(0:degree, 3)
      !> Coefficients of v, the last first, of theta + (1 + epsilon) w(t - tau), of unit w', and of
      !> unit v' as it was
      real(wp), dimension(0:degree) :: v_back, relaxing, rate, v_rate
      real(wp) :: delayed_w, earlier, inertia, share, theta, total, u, v, v_first, w
      integer :: j, k

      call rate_as_it_was(unit, degree, y, v_rate)
      inertia = p%xi/(p%gamma**2*unit)
      theta = y(0, index_of_theta)
      u = y(0, index_of_u)
      w = -theta - p%xi*u - inertia*v_rate(0)
      if (.not. (w >= least_ln_v .and. w <= largest_ln_v)) then
         y = ieee_value(1.0_wp, ieee_quiet_nan)
         return
      end if
      v_first = exp(w)
      v = v_first
      do k = 0, degree
         ! first what has been known for long, as above
         total = 0.0_wp
         earlier = 0.0_wp
         do j = 1, k - 1
            total = total + v_back(degree - k + j)*relaxing(j)
            earlier = earlier + v_back(degree - k + j)*rate(j - 1)
         end do
         if (k > 0) then
            w = -theta - p%xi*u - inertia*v_rate(k)
            rate(k - 1) = k*w
            v = (earlier + v_first*rate(k - 1))/k
         end if
         y(k, index_of_theta) = theta
         y(k, index_of_u) = u
         y(k, index_of_ln_v) = w
         v_back(degree - k) = v
         delayed_w = w
         if (delays > 0) delayed_w = z(k, 1)
         relaxing(k) = theta + (1.0_wp + p%epsilon)*delayed_w
         total = total + v_first*relaxing(k)
         if (k > 0) total = total + v*relaxing(0)
         share = unit/(k + 1)
         theta = -share*total
         u = share*merge(v - 1.0_wp, v, k == 0)
      end do
   end subroutine slow_series_of_block

   !> Coefficients of unit v', by u' = v - 1; the last that is known, for which those of u do not
   !> suffice, by v' = w' v.
   pure subroutine rate_as_it_was(unit, degree, y, v_rate)
      real(wp), intent(in) :: unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: y(0:degree, 3)
      !> Those of unit v', the last 0
      real(wp), intent(out) :: v_rate(0:degree)
      integer :: k

      v_rate(degree - 1:) = 0.0_wp
      do k = 0, degree - 2
         v_rate(k) = (k + 1)*(k + 2)/unit*y(k + 2, index_of_u)
      end do
      associate (w => y(:, index_of_ln_v), last => v_rate(degree - 1))
         last = degree*w(degree + 1)*exp(min(w(1), largest_ln_v))
         do k = 1, degree - 1
            last = last + k*w(k + 1)*v_rate(degree - k - 1)/(degree - k)
         end do
      end associate
   end subroutine rate_as_it_was
end module block_series
