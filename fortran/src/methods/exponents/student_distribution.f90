! SPDX-License-Identifier: BSD-3-Clause
!> Quantiles of Student's distribution without a library. A program that has more digits of them
!> sets `student_quantile`.
module student_distribution
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: student_quantile

   abstract interface
      !> The value that a variable of Student's distribution exceeds with a probability.
      pure real(wp) function find_quantile(probability, freedom) result(value)
         import :: wp
         implicit none (type, external)
         real(wp), value :: probability, freedom
      end function find_quantile
   end interface

   procedure(find_quantile), pointer :: student_quantile => quantile_by_halving

contains

   !> The value that a variable of Student's distribution exceeds with a probability, by halving.
   pure real(wp) function quantile_by_halving(probability, freedom) result(value)
      !> The probability, 0..1/2
      real(wp), value :: probability
      !> Degrees of freedom, a whole number > 0
      real(wp), value :: freedom
      real(wp) :: above, below
      integer :: i

      below = 0.0_wp
      above = 1.0_wp
      do while (beyond(above, nint(freedom)) > probability)
         above = 2.0_wp*above
      end do
      do i = 1, digits(1.0_wp) + exponent(above)
         value = 0.5_wp*(below + above)
         if (beyond(value, nint(freedom)) > probability) then
            below = value
         else
            above = value
         end if
      end do
   end function quantile_by_halving

   !> The probability beyond a value >= 0 (Abramowitz and Stegun 1964, 26.7.3 and 26.7.4).
   pure real(wp) function beyond(value, freedom) result(probability)
      real(wp), intent(in) :: value
      integer, intent(in) :: freedom
      real(wp) :: angle, sum, term
      integer :: k

      angle = atan(value/sqrt(real(freedom, wp)))
      term = merge(sin(angle), sin(angle)*cos(angle), modulo(freedom, 2) == 0)
      sum = 0.0_wp
      do k = 2 + modulo(freedom, 2), freedom, 2
         sum = sum + term
         term = term*cos(angle)**2*(k - 1)/k
      end do
      if (modulo(freedom, 2) == 1) sum = 2.0_wp/acos(-1.0_wp)*(angle + sum)
      probability = 0.5_wp*(1.0_wp - sum)
   end function beyond
end module student_distribution
