! SPDX-License-Identifier: BSD-3-Clause
!> The explicit pair 5(4) of Bogacki and Shampine (1996, "An efficient Runge-Kutta (4,5) pair",
!> Comput. Math. Applic. 32, 15). Its dense output of order 4 takes no further stages: the cubic
!> Hermite polynomial, and a multiple of s**2 (1 - s)**2.
module dde_bogacki_shampine
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_explicit_pair, only: explicit_pair, slope_count
   use dde_step_context, only: step_context
   use dde_tolerance, only: scaled_norm
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: bogacki_shampine

   !> Error estimate over the embedded errors. With it global errors over the tolerance are about
   !> those of the pair 8(5,3).
   real(wp), parameter :: strictness = 5.0_wp

   !> Times of stages 2 to 6; that of stage 7 is 1
   real(wp), parameter :: &
      c2 = 1.0_wp/6.0_wp, c3 = 2.0_wp/9.0_wp, c4 = 3.0_wp/7.0_wp, c5 = 2.0_wp/3.0_wp, c6 = 0.75_wp

   !> Places of delayed values
   real(wp), parameter :: places(6) = [c2, c3, c4, c5, c6, 1.0_wp]

   !> Weights of the stages 2 to 7, row by row
   real(wp), parameter :: &
      a21 = 1.0_wp/6.0_wp, &
      a31 = 2.0_wp/27.0_wp, a32 = 4.0_wp/27.0_wp, &
      a41 = 183.0_wp/1372.0_wp, a42 = -162.0_wp/343.0_wp, a43 = 1053.0_wp/1372.0_wp, &
      a51 = 68.0_wp/297.0_wp, a52 = -4.0_wp/11.0_wp, a53 = 42.0_wp/143.0_wp, &
      a54 = 1960.0_wp/3861.0_wp, &
      a61 = 597.0_wp/22528.0_wp, a62 = 81.0_wp/352.0_wp, a63 = 63099.0_wp/585728.0_wp, &
      a64 = 58653.0_wp/366080.0_wp, a65 = 4617.0_wp/20480.0_wp, &
      a71 = 174197.0_wp/959244.0_wp, a72 = -30942.0_wp/79937.0_wp, &
      a73 = 8152137.0_wp/19744439.0_wp, a74 = 666106.0_wp/1039181.0_wp, &
      a75 = -29421.0_wp/29068.0_wp, a76 = 482048.0_wp/414219.0_wp

   !> Weights of the end
   real(wp), parameter :: &
      b1 = 587.0_wp/8064.0_wp, b3 = 4440339.0_wp/15491840.0_wp, b4 = 24353.0_wp/124800.0_wp, &
      b5 = 387.0_wp/44800.0_wp, b6 = 2152.0_wp/5985.0_wp, b7 = 7267.0_wp/94080.0_wp

   !> Weights of the two embedded errors of order 4
   real(wp), parameter :: &
      e1 = -3.0_wp/1280.0_wp, e3 = 6561.0_wp/632320.0_wp, e4 = -343.0_wp/20800.0_wp, &
      e5 = 243.0_wp/12800.0_wp, e6 = -1.0_wp/95.0_wp, &
      f1 = 3817.0_wp/1959552.0_wp, f3 = -140181.0_wp/15491840.0_wp, &
      f4 = 4224731.0_wp/272937600.0_wp, f5 = -8557.0_wp/403200.0_wp, f6 = 57928.0_wp/4363065.0_wp, &
      f7 = 23930231.0_wp/4366535040.0_wp, f8 = -3293.0_wp/556956.0_wp

   !> Dense output: of the weights that give order 4, those with the least error of order 5, in the
   !> mean square over all trees and over the step. With them the mean of the polynomial over the
   !> step has order 5.
   real(wp), parameter :: &
      d1 = -11269.0_wp/8064.0_wp, d3 = 7254279.0_wp/3098368.0_wp, d4 = 110789.0_wp/224640.0_wp, &
      d5 = -1161.0_wp/8960.0_wp, d6 = -9512.0_wp/3591.0_wp, d7 = -7267.0_wp/6272.0_wp, &
      d8 = 5.0_wp/2.0_wp

   !> The pair. Slope 8 is that at the end.
   type, extends(explicit_pair) :: bogacki_shampine
   contains
      procedure :: set_up, take_step, find_coefficients
   end type bogacki_shampine

contains

   !> Its constants. The explicit method is stable up to 4.
   pure subroutine set_up(self, nodes)
      class(bogacki_shampine), intent(inout) :: self
      real(wp), allocatable, intent(out) :: nodes(:)

      self%order = 5
      self%stages = 7
      self%limited_by_stability = 1.75_wp
      self%places = size(places)
      nodes = real([0, 1, 0, 1], wp)
   end subroutine set_up

   !> A step, compiled for one to four equations and for any number.
   pure subroutine take_step(self, context, n, h, y, z, k, slope, stage, aside, y_new, scale, &
                             embedded, finite, error)
      class(bogacki_shampine), intent(in) :: self
      type(step_context), intent(inout) :: context
      integer, intent(in) :: n
      real(wp), intent(in) :: h, y(n)
      real(wp), intent(inout) :: z(size(context%problem%lag), self%places)
      real(wp), intent(inout), dimension(n) :: slope, stage, aside, y_new, scale
      real(wp), intent(inout) :: k(slope_count, n), embedded(n, 2)
      logical, intent(out) :: finite
      real(wp), intent(out) :: error
      real(wp) :: t, t_end, times(size(places)), total
      integer :: i

      ! few equations with constant delays, or any problem
      select case (merge(n, 0, context%problem%moving == 0))
      case (1)
         block
            integer, parameter :: m = 1
            logical, parameter :: moves = .false.
            include "bogacki_shampine_step.inc"
         end block
      case (2)
         block
            integer, parameter :: m = 2
            logical, parameter :: moves = .false.
            include "bogacki_shampine_step.inc"
         end block
      case (3)
         block
            integer, parameter :: m = 3
            logical, parameter :: moves = .false.
            include "bogacki_shampine_step.inc"
         end block
      case (4)
         block
            integer, parameter :: m = 4
            logical, parameter :: moves = .false.
            include "bogacki_shampine_step.inc"
         end block
      case default
         associate (m => n, moves => context%problem%moving > 0)
            include "bogacki_shampine_step.inc"
         end associate
      end select
   end subroutine take_step

   !> Newton coefficients of one component's dense output over the nodes 0, 1, 0, 1.
   pure subroutine find_coefficients(self, k, h, y, y_new, a)
      class(bogacki_shampine), intent(in) :: self
      real(wp), intent(in) :: k(slope_count), h, y, y_new
      real(wp), contiguous, intent(out) :: a(0:)
      real(wp) :: rise

      rise = y_new - y
      a(0) = y
      a(1) = rise
      a(2) = rise - h*k(1)
      a(3) = h*(k(1) + k(8)) - 2.0_wp*rise
      a(4) = h*(d1*k(1) + d3*k(3) + d4*k(4) + d5*k(5) + d6*k(6) + d7*k(7) + d8*k(8))
   end subroutine find_coefficients
end module dde_bogacki_shampine
