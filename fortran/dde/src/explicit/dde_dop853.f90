! SPDX-License-Identifier: BSD-3-Clause
!> The explicit pair 8(5,3) of Dormand and Prince with its dense output of order 7 (Hairer, Norsett
!> and Wanner 1993, sec. II.5, II.6 and II.10).
module dde_dop853
   use dde_dop853_tableau
   use dde_explicit_pair, only: evaluate, explicit_pair, slope_count
   use dde_step_context, only: step_context
   use dde_tolerance, only: all_finite, scaled_norm
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: dop853

   !> Largest embedded errors of orders 3 and 5 for which the estimate is trusted, over
   !> tolerance**(1/2) and tolerance**(3/4). They are a few times the values of accurate steps.
   real(wp), parameter :: largest_e3 = 50.0_wp, largest_e5 = 3.0_wp

   !> Error of the dense output over the last term of its polynomial and tolerance**(1/8), the ratio
   !> of terms that follow each other where the pair's error is the tolerance. The term is at most
   !> (4/7)**4 (3/7)**3 = 0.0084 times its coefficient.
   real(wp), parameter :: share_of_last = 0.5_wp*4.0_wp**4*3.0_wp**3/7.0_wp**7

   !> The pair. Slope 13 is that at the end, slopes 14 to 16 serve the dense output.
   type, extends(explicit_pair) :: dop853
   contains
      procedure :: set_up, take_stages, take_dense_stages, find_error, find_coefficients
   end type dop853

contains

   !> Its constants. The explicit method is stable up to 6 (Hairer and Wanner 1996, sec. IV.2).
   pure subroutine set_up(self, nodes)
      class(dop853), intent(inout) :: self
      real(wp), allocatable, intent(out) :: nodes(:)

      self%order = 8
      self%stages = 12
      self%limited_by_stability = 2.5_wp
      self%places = [c2, c3, c4, c7, c5, c8, c6, c10, c9, c11, 1.0_wp]
      self%dense_places = [c14, c15, c16]
      nodes = real([0, 1, 0, 1, 0, 1, 0], wp)
   end subroutine set_up

   !> Stages 2 to 12, state and slope at the end of the step.
   pure subroutine take_stages(self, context, n, h, y, z, k, slope, stage, y_new, finite)
      class(dop853), intent(in) :: self
      type(step_context), intent(inout) :: context
      integer, intent(in) :: n
      real(wp), intent(in) :: h, y(n), z(size(context%problem%lag), size(self%places))
      real(wp), intent(inout) :: k(slope_count, n), slope(n), stage(n), y_new(n)
      logical, intent(inout) :: finite
      real(wp) :: t, t_end

      t = context%cursor%inside(context%cursor%t)
      t_end = context%cursor%inside(context%cursor%t + h)
      stage = y + h*a21*k(1, :)
      call evaluate(context, t + c2*h, z(:, 1), 2, stage, k, slope, finite)
      stage = y + h*(a31*k(1, :)) + h*a32*slope
      call evaluate(context, t + c3*h, z(:, 2), 3, stage, k, slope, finite)
      stage = y + h*(a41*k(1, :)) + h*a43*slope
      call evaluate(context, t + c4*h, z(:, 3), 4, stage, k, slope, finite)
      stage = y + h*(a51*k(1, :) + a53*k(3, :)) + h*a54*slope
      call evaluate(context, t + c5*h, z(:, 5), 5, stage, k, slope, finite)
      stage = y + h*(a61*k(1, :) + a64*k(4, :)) + h*a65*slope
      call evaluate(context, t + c6*h, z(:, 7), 6, stage, k, slope, finite)
      stage = y + h*(a71*k(1, :) + a74*k(4, :) + a75*k(5, :)) + h*a76*slope
      call evaluate(context, t + c7*h, z(:, 4), 7, stage, k, slope, finite)
      stage = y + h*(a81*k(1, :) + a84*k(4, :) + a85*k(5, :) + a86*k(6, :)) + h*a87*slope
      call evaluate(context, t + c8*h, z(:, 6), 8, stage, k, slope, finite)
      stage = y + h*(a91*k(1, :) + a94*k(4, :) + a95*k(5, :) + a96*k(6, :) + a97*k(7, :)) &
              + h*a98*slope
      call evaluate(context, t + c9*h, z(:, 9), 9, stage, k, slope, finite)
      stage = y + h*(a10_1*k(1, :) + a10_4*k(4, :) + a10_5*k(5, :) + a10_6*k(6, :) &
                     + a10_7*k(7, :) + a10_8*k(8, :)) + h*a10_9*slope
      call evaluate(context, t + c10*h, z(:, 8), 10, stage, k, slope, finite)
      stage = y + h*(a11_1*k(1, :) + a11_4*k(4, :) + a11_5*k(5, :) + a11_6*k(6, :) &
                     + a11_7*k(7, :) + a11_8*k(8, :) + a11_9*k(9, :)) + h*a11_10*slope
      call evaluate(context, t + c11*h, z(:, 10), 11, stage, k, slope, finite)
      stage = y + h*(a12_1*k(1, :) + a12_4*k(4, :) + a12_5*k(5, :) + a12_6*k(6, :) &
                     + a12_7*k(7, :) + a12_8*k(8, :) + a12_9*k(9, :) + a12_10*k(10, :)) &
              + h*a12_11*slope
      call evaluate(context, t_end, z(:, 11), 12, stage, k, slope, finite)
      y_new = y + h*(b1*k(1, :) + b6*k(6, :) + b7*k(7, :) + b8*k(8, :) &
                     + b9*k(9, :) + b10*k(10, :) + b11*k(11, :) + b12*k(12, :))
      finite = finite .and. all_finite(n, y_new)
      call evaluate(context, t_end, z(:, 11), 13, y_new, k, slope, finite)
   end subroutine take_stages

   !> Slopes 14 to 16, for the dense output. It is of one order less than the pair, and where a
   !> component decays within the step its error can be large while that at the end is small. It is
   !> estimated by the last coefficient.
   pure subroutine take_dense_stages(self, context, n, h, scale, y, z, k, slope, stage, finite, &
                                     error)
      class(dop853), intent(in) :: self
      type(step_context), intent(inout) :: context
      integer, intent(in) :: n
      real(wp), intent(in) :: h, scale(n), y(n)
      real(wp), intent(in) :: z(size(context%problem%lag), size(self%dense_places))
      real(wp), intent(inout) :: k(slope_count, n), slope(n), stage(n)
      logical, intent(inout) :: finite
      real(wp), intent(out) :: error
      real(wp) :: t

      t = context%cursor%t
      stage = y + h*(a14_1*k(1, :) + a14_7*k(7, :) + a14_8*k(8, :) + a14_9*k(9, :) &
                     + a14_10*k(10, :) + a14_11*k(11, :) + a14_12*k(12, :)) + h*a14_13*slope
      call evaluate(context, t + c14*h, z(:, 1), 14, stage, k, slope, finite)
      stage = y + h*(a15_1*k(1, :) + a15_6*k(6, :) + a15_7*k(7, :) + a15_8*k(8, :) &
                     + a15_11*k(11, :) + a15_12*k(12, :) + a15_13*k(13, :)) + h*a15_14*slope
      call evaluate(context, t + c15*h, z(:, 2), 15, stage, k, slope, finite)
      stage = y + h*(a16_1*k(1, :) + a16_6*k(6, :) + a16_7*k(7, :) + a16_8*k(8, :) &
                     + a16_9*k(9, :) + a16_13*k(13, :) + a16_14*k(14, :)) + h*a16_15*slope
      call evaluate(context, t + c16*h, z(:, 3), 16, stage, k, slope, finite)
      stage = h*(d71*k(1, :) + d76*k(6, :) + d77*k(7, :) + d78*k(8, :) &
                 + d79*k(9, :) + d7_10*k(10, :) + d7_11*k(11, :) + d7_12*k(12, :) &
                 + d7_13*k(13, :) + d7_14*k(14, :) + d7_15*k(15, :) + d7_16*k(16, :))
      error = share_of_last*sqrt(sqrt(sqrt(context%tolerance%level)))*scaled_norm(n, stage, scale)
   end subroutine take_dense_stages

   !> The largest e5^2/sqrt(e5^2 + 0.01 e3^2) of all components, with e3 and e5 over the tolerance
   !> of the component (Hairer, Norsett and Wanner 1993, eq. (II.10.17), for each component alone:
   !> a large e3 of one must not hide the e5 of another). It assumes that e3 is of size h^4 and e5
   !> of size h^6. In a step far too long for that e5 can be small by chance while e3 is large.
   !> Therefore each of them has a bound of its own.
   pure subroutine find_error(self, n, k, h, scale, tolerance, embedded, error)
      class(dop853), intent(in) :: self
      integer, intent(in) :: n
      real(wp), intent(in) :: k(slope_count, n), h, scale(n), tolerance
      real(wp), intent(out) :: embedded(n, 2), error
      real(wp) :: norm3, norm5, of_3, of_5, root
      integer :: i

      associate (e3 => embedded(:, 2), e5 => embedded(:, 1))
         e3 = h*((b1 - bhh1)*k(1, :) + b6*k(6, :) + b7*k(7, :) + b8*k(8, :) &
                 + (b9 - bhh2)*k(9, :) + b10*k(10, :) + b11*k(11, :) &
                 + (b12 - bhh3)*k(12, :))
         e5 = h*(er1*k(1, :) + er6*k(6, :) + er7*k(7, :) + er8*k(8, :) &
                 + er9*k(9, :) + er10*k(10, :) + er11*k(11, :) + er12*k(12, :))
         norm3 = scaled_norm(n, e3, scale)
         norm5 = scaled_norm(n, e5, scale)
         error = huge(1.0_wp)
         if (norm3 < error .and. norm5 < error) then
            root = sqrt(tolerance)
            error = max(norm3*root/largest_e3, norm5*sqrt(root)/largest_e5)
            do i = 1, n
               of_3 = 0.1_wp*abs(e3(i))/scale(i)
               of_5 = abs(e5(i))/scale(i)
               ! tiny: both may be 0
               error = max(error, of_5*(of_5/sqrt(of_5**2 + of_3**2 + tiny(1.0_wp))))
            end do
         end if
      end associate
   end subroutine find_error

   !> Newton coefficients of one component's dense output over the nodes 0, 1, 0, 1, 0, 1, 0.
   pure subroutine find_coefficients(self, k, h, y, y_new, a)
      class(dop853), intent(in) :: self
      real(wp), intent(in) :: k(slope_count), h, y, y_new
      real(wp), contiguous, intent(out) :: a(0:)
      real(wp) :: rise

      rise = y_new - y
      a(0) = y
      a(1) = rise
      a(2) = rise - h*k(1)
      a(3) = h*(k(1) + k(13)) - 2.0_wp*rise
      a(4) = h*(d41*k(1) + d46*k(6) + d47*k(7) + d48*k(8) + d49*k(9) + d4_10*k(10) &
                + d4_11*k(11) + d4_12*k(12) + d4_13*k(13) + d4_14*k(14) + d4_15*k(15) &
                + d4_16*k(16))
      a(5) = h*(d51*k(1) + d56*k(6) + d57*k(7) + d58*k(8) + d59*k(9) + d5_10*k(10) &
                + d5_11*k(11) + d5_12*k(12) + d5_13*k(13) + d5_14*k(14) + d5_15*k(15) &
                + d5_16*k(16))
      a(6) = -h*(d61*k(1) + d66*k(6) + d67*k(7) + d68*k(8) + d69*k(9) + d6_10*k(10) &
                 + d6_11*k(11) + d6_12*k(12) + d6_13*k(13) + d6_14*k(14) + d6_15*k(15) &
                 + d6_16*k(16))
      a(7) = -h*(d71*k(1) + d76*k(6) + d77*k(7) + d78*k(8) + d79*k(9) + d7_10*k(10) &
                 + d7_11*k(11) + d7_12*k(12) + d7_13*k(13) + d7_14*k(14) + d7_15*k(15) &
                 + d7_16*k(16))
   end subroutine find_coefficients
end module dde_dop853
