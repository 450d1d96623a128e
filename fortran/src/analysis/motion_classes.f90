!> The classes of motion, and the class by Lyapunov exponents.
module motion_classes
   use exponent_averages, only: error_bars, exponent_type, without_sign
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: agreed, chaos, class_by_exponents, class_names, cycle_motion, fixed_point, torus
   public :: undecided

   !> Classes of motion.
   enum, bind(c)
      enumerator :: undecided, fixed_point, cycle_motion, torus, chaos
   end enum

   !> Their names, from `undecided` on.
   character(len=11), parameter :: class_names(0:4) = ["undecided  ", "fixed point", &
                                                       "cycle      ", "torus      ", "chaos      "]

contains

   !> The class by leading exponents: all negative, a fixed point; one zero, the others negative, a
   !> cycle; two zero, a torus; positive ones, chaos. It is undecided if there are positive and
   !> negative exponents but no zero one, if all or more than two are zero, or if the error bar of a
   !> zero exponent is too long.
   pure integer function class_by_exponents(exponents, zero_level, longest_bar) result(found)
      !> Exponents, descending
      type(exponent_type), intent(in) :: exponents(:)
      !> An exponent this close to zero is zero
      real(wp), intent(in) :: zero_level
      !> Longest error bar (of three standard errors) of a zero exponent
      real(wp), intent(in) :: longest_bar
      logical :: zero(size(exponents))
      integer :: positive, zeros

      zero = without_sign(exponents, zero_level)
      positive = count(exponents%value > 0.0_wp .and. .not. zero)
      zeros = count(zero)
      found = undecided
      if (positive > 0) then
         if (zeros > 0 .or. positive == size(exponents)) found = chaos
      else if (zeros < size(exponents) &
               .and. .not. any(zero .and. error_bars*exponents%error > longest_bar)) then
         select case (zeros)
         case (0)
            found = fixed_point
         case (1)
            found = cycle_motion
         case (2)
            found = torus
         case default
            found = undecided
         end select
      end if
   end function class_by_exponents

   !> The class by exponents, if at least one of the others confirms it and none contradicts it.
   pure integer function agreed(by_exponents, by_section, by_spectrum) result(found)
      !> Class by exponents
      integer, intent(in) :: by_exponents
      !> Class by the section; `undecided` neither confirms nor contradicts
      integer, intent(in) :: by_section
      !> Class by the spectrum; `undecided` neither confirms nor contradicts
      integer, intent(in) :: by_spectrum

      associate (others => [by_section, by_spectrum])
         found = by_exponents
         if (any(others /= undecided .and. others /= found)) found = undecided
         if (all(others == undecided)) found = undecided
      end associate
   end function agreed
end module motion_classes
