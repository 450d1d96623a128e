! SPDX-License-Identifier: BSD-3-Clause
!> The explicit pair 8(5,3) of Dormand and Prince with its dense output of order 7 (Hairer, Norsett
!> and Wanner 1993, sec. II.5, II.6 and II.10).
module dde_dop853
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_dop853_tableau
   use dde_explicit_pair, only: explicit_pair, slope_count
   use dde_step_context, only: step_context
   use dde_tolerance, only: all_finite, scaled_norm
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: dop853

   !> Largest embedded errors of orders 3 and 5 for which the estimate is trusted, over
   !> tolerance**(1/2) and tolerance**(3/4). They are a few times the values of accurate steps.
   real(wp), parameter :: largest_e3 = 50.0_wp, largest_e5 = 3.0_wp

   !> Embedded error of order 3 over the length of the step and its slopes from which on the step is
   !> far too long: 0.03 where h times the rate of a decay is 4, 0.1 at 5.66, where e5 vanishes.
   real(wp), parameter :: far_too_long = 0.06_wp

   !> Error of the dense output over the last term of its polynomial and tolerance**(1/8), the ratio
   !> of terms that follow each other where the pair's error is the tolerance. The term is at most
   !> (4/7)**4 (3/7)**3 = 0.0084 times its coefficient.
   real(wp), parameter :: share_of_last = 0.5_wp*4.0_wp**4*3.0_wp**3/7.0_wp**7

   !> Places of delayed values in a step, ascending, its end the last, and of its dense output: the
   !> past is read in one direction
   real(wp), parameter :: places(11) = [c2, c3, c4, c7, c5, c8, c6, c10, c9, c11, 1.0_wp], &
                          dense_places(3) = [c14, c15, c16]

   !> The pair. Slope 13 is that at the end, slopes 14 to 16 serve the dense output.
   type, extends(explicit_pair) :: dop853
   contains
      procedure :: set_up, take_step, find_coefficients
   end type dop853

contains

   !> Its constants. The explicit method is stable up to 6 (Hairer and Wanner 1996, sec. IV.2).
   pure subroutine set_up(self, nodes)
      class(dop853), intent(inout) :: self
      real(wp), allocatable, intent(out) :: nodes(:)

      self%order = 8
      self%stages = 12
      self%limited_by_stability = 2.5_wp
      self%places = size(places)
      nodes = real([0, 1, 0, 1, 0, 1, 0], wp)
   end subroutine set_up

   !> A step, compiled for one to four equations and for any number.
   pure subroutine take_step(self, context, n, h, y, z, k, slope, stage, aside, y_new, scale, &
                             embedded, finite, error)
      class(dop853), intent(in) :: self
      type(step_context), intent(inout) :: context
      integer, intent(in) :: n
      real(wp), intent(in) :: h, y(n)
      real(wp), intent(inout) :: z(size(context%problem%lag), self%places)
      real(wp), intent(inout), dimension(n) :: slope, stage, aside, y_new, scale
      real(wp), intent(inout) :: k(slope_count, n), embedded(n, 2)
      logical, intent(out) :: finite
      real(wp), intent(out) :: error
      real(wp) :: norm3, norm5, of_3, of_5, root, slopes, t, t_end, times(size(places))
      integer :: i

      ! few equations with constant delays, or any problem
      select case (merge(n, 0, context%problem%moving == 0))
      case (1)
         block
            integer, parameter :: m = 1
            logical, parameter :: moves = .false.
            include "dop853_step.inc"
         end block
      case (2)
         block
            integer, parameter :: m = 2
            logical, parameter :: moves = .false.
            include "dop853_step.inc"
         end block
      case (3)
         block
            integer, parameter :: m = 3
            logical, parameter :: moves = .false.
            include "dop853_step.inc"
         end block
      case (4)
         block
            integer, parameter :: m = 4
            logical, parameter :: moves = .false.
            include "dop853_step.inc"
         end block
      case default
         associate (m => n, moves => context%problem%moving > 0)
            include "dop853_step.inc"
         end associate
      end select
   end subroutine take_step

   !> Slope number `j` at time `t` in state `y`, unless an earlier slope of the step was not finite.
   pure subroutine evaluate(n, moves, context, t, z, j, y, k, slope, finite)
      integer, intent(in) :: n
      !> Whether delays move
      logical, intent(in) :: moves
      type(step_context), intent(inout) :: context
      !> Time, delayed values and state
      real(wp), intent(in) :: t, y(n)
      real(wp), intent(inout) :: z(size(context%problem%lag))
      integer, intent(in) :: j
      !> All slopes, and this one, which is computed in one piece
      real(wp), intent(inout) :: k(slope_count, n), slope(n)
      !> Whether all slopes so far are finite
      logical, intent(inout) :: finite
      real(wp) :: total
      integer :: i

      if (.not. finite) return
      call context%evaluate_stage(moves, t, y, z, slope)
      total = 0.0_wp
      do i = 1, n
         k(j, i) = slope(i)
         total = total + abs(slope(i))
      end do
      finite = ieee_is_finite(total)
   end subroutine evaluate

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
