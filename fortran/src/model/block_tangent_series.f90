!> Taylor series of small disturbances of solutions of the block's equation (4): the derivatives of
!> the recurrences of `block_series`, with d theta, d u, d w and d v = v d w. All quantities are
!> nondimensional. Disturbances are computed four at a time: the recurrences of one wait for their
!> own last terms, those of four overlap.
module block_tangent_series
   use block_parameters, only: block_parameters_type
   use block_state, only: index_of_ln_v, index_of_theta, index_of_u
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: slow_tangent_series_of_block, tangent_series_of_block

   !> Disturbances computed at a time.
   integer, parameter :: lanes = 4

contains

   !> Series of disturbances: with r = theta + (1 + epsilon) w(t - tau),
   !>
   !>     d theta' = -(v dr + r dv),   du' = dv,   dv' = -gamma^2 [du + (d theta + dw)/xi],
   !>
   !> and dw from dv = v dw, term by term.
   pure subroutine tangent_series_of_block(p, unit, degree, delays, z, y, vectors, dz, dy)
      !> Parameters of the block
      type(block_parameters_type), intent(in) :: p
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Degree of the series; number of delayed values, 0 or 1
      integer, intent(in) :: degree, delays
      !> Coefficients of w(t - tau), or nothing; coefficients of theta, u, w
      real(wp), intent(in) :: z(0:degree, delays), y(0:degree, 3)
      !> Number of disturbances
      integer, intent(in) :: vectors
      !> Coefficients of the disturbances of w(t - tau), or nothing
      real(wp), intent(in) :: dz(0:degree, delays, vectors)
      !> Coefficients of d theta, du, dw; dy(0, :, :) is given
      real(wp), intent(inout) :: dy(0:degree, 3, vectors)
      real(wp), dimension(lanes, 0:degree) :: delayed, dr, dv, dw
      real(wp), dimension(lanes) :: by_dr, by_dv, by_dw, d_theta, du
      real(wp) :: by_v, compliance, pull, r(0:degree), share, v(0:degree)
      integer :: first, j, k, last, used

      pull = -p%gamma**2*unit
      compliance = 1.0_wp/p%xi
      v = velocity(unit, degree, y)
      r = state_rate(p, degree, delays, z, y)
      by_v = 1.0_wp/v(0)
      do first = 1, vectors, lanes
         last = min(vectors, first + lanes - 1)
         used = last - first + 1
         delayed = 0.0_wp
         if (delays > 0) delayed(:used, :) = transpose(dz(:, 1, first:last))
         d_theta = 0.0_wp
         du = 0.0_wp
         dw(:, 0) = 0.0_wp
         d_theta(:used) = dy(0, index_of_theta, first:last)
         du(:used) = dy(0, index_of_u, first:last)
         dw(:used, 0) = dy(0, index_of_ln_v, first:last)
         dv(:, 0) = v(0)*dw(:, 0)
         do k = 0, degree - 1
            if (delays == 0) delayed(:, k) = dw(:, k)
            dr(:, k) = d_theta + (1.0_wp + p%epsilon)*delayed(:, k)
            by_dr = 0.0_wp
            by_dv = 0.0_wp
            by_dw = 0.0_wp
            do j = 0, k
               by_dr = by_dr + v(k - j)*dr(:, j)
               by_dv = by_dv + r(k - j)*dv(:, j)
               by_dw = by_dw + v(k + 1 - j)*dw(:, j)
            end do
            share = 1.0_wp/(k + 1)
            dv(:, k + 1) = (share*pull)*(du + compliance*(d_theta + dw(:, k)))
            d_theta = -(unit*share)*(by_dr + by_dv)
            du = (unit*share)*dv(:, k)
            dw(:, k + 1) = by_v*(dv(:, k + 1) - by_dw)
            dy(k + 1, index_of_theta, first:last) = d_theta(:used)
            dy(k + 1, index_of_u, first:last) = du(:used)
            dy(k + 1, index_of_ln_v, first:last) = dw(:used, k + 1)
         end do
      end do
   end subroutine tangent_series_of_block

   !> A better series of disturbances of the slow solution: the derivative of
   !> w = -theta - xi u - (xi/gamma^2) v' with v as it was, and of (4).
   pure subroutine slow_tangent_series_of_block(p, unit, degree, delays, z, before, y, vectors, &
                                                dz, dy)
      !> Parameters of the block
      type(block_parameters_type), intent(in) :: p
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Degree of the series; number of delayed values, 0 or 1
      integer, intent(in) :: degree, delays
      !> Coefficients of w(t - tau), or nothing
      real(wp), intent(in) :: z(0:degree, delays)
      !> Coefficients of theta, u, w as they were, and better ones
      real(wp), intent(in) :: before(0:degree, 3), y(0:degree, 3)
      !> Number of disturbances
      integer, intent(in) :: vectors
      !> Coefficients of the disturbances of w(t - tau), or nothing
      real(wp), intent(in) :: dz(0:degree, delays, vectors)
      !> Coefficients of d theta, du, dw as they were; better ones
      real(wp), intent(inout) :: dy(0:degree, 3, vectors)
      real(wp), dimension(0:degree) :: dr, dv, dv_rate, dw, r, v, v_before
      real(wp) :: d_theta, du, inertia
      integer :: i, k

      inertia = p%xi/(p%gamma**2*unit)
      v_before = velocity(unit, degree, before)
      v = velocity(unit, degree, y)
      r = state_rate(p, degree, delays, z, y)
      do i = 1, vectors
         dv_rate(degree) = 0.0_wp
         dv_rate(degree - 1) = degree*dot_product(v_before(degree:0:-1), &
                                                  dy(:, index_of_ln_v, i))
         do k = 0, degree - 2
            dv_rate(k) = (k + 1)*(k + 2)/unit*dy(k + 2, index_of_u, i)
         end do
         d_theta = dy(0, index_of_theta, i)
         du = dy(0, index_of_u, i)
         do k = 0, degree
            dw(k) = -d_theta - p%xi*du - inertia*dv_rate(k)
            dy(k, :, i) = [d_theta, du, dw(k)]
            dv(k) = dot_product(v(k:0:-1), dw(:k))
            dr(k) = d_theta + (1.0_wp + p%epsilon)*dw(k)
            if (delays > 0) dr(k) = d_theta + (1.0_wp + p%epsilon)*dz(k, 1, i)
            d_theta = -unit/(k + 1)*(dot_product(v(k:0:-1), dr(:k)) &
                                     + dot_product(r(k:0:-1), dv(:k)))
            du = unit/(k + 1)*dv(k)
         end do
      end do
   end subroutine slow_tangent_series_of_block

   !> Coefficients of v, by v = 1 + u'; the last, for which those of u do not suffice, by v' = w' v.
   pure function velocity(unit, degree, y) result(v)
      real(wp), intent(in) :: unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: y(0:degree, 3)
      real(wp) :: v(0:degree)
      integer :: k

      v(0) = exp(y(0, index_of_ln_v))
      v(degree) = 0.0_wp
      do k = 1, degree - 1
         v(k) = (k + 1)/unit*y(k + 1, index_of_u)
      end do
      do k = 1, degree
         v(degree) = v(degree) + k*y(k, index_of_ln_v)*v(degree - k)/degree
      end do
   end function velocity

   !> Coefficients of r = theta + (1 + epsilon) w(t - tau).
   pure function state_rate(p, degree, delays, z, y) result(r)
      type(block_parameters_type), intent(in) :: p
      integer, intent(in) :: degree, delays
      real(wp), intent(in) :: z(0:degree, delays), y(0:degree, 3)
      real(wp) :: r(0:degree)

      if (delays > 0) then
         r = y(:, index_of_theta) + (1.0_wp + p%epsilon)*z(:, 1)
      else
         r = y(:, index_of_theta) + (1.0_wp + p%epsilon)*y(:, index_of_ln_v)
      end if
   end function state_rate
end module block_tangent_series
