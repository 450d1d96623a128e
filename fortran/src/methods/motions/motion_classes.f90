! SPDX-License-Identifier: BSD-3-Clause
!> The classes of motion, and the class by Lyapunov exponents.
module motion_classes
   use exponent_averages, only: error_bars, exponent_type, positive, sign_of, unclear, zero
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: agree, chaos, class_by_exponents, class_names, clear_by_exponents, cycle_motion
   public :: fixed_point, leaves_cycle, three_torus, torus, undecided
   public :: contradicted, no_class_by_exponents, none, not_confirmed, not_stationary, reason_names
   public :: unstable_rest

   !> Classes of motion.
   enum, bind(c)
      enumerator :: undecided, fixed_point, cycle_motion, torus, three_torus, chaos
   end enum

   !> Names of the classes, from `undecided` on.
   character(len=11), parameter :: class_names(0:5) = ["undecided  ", "fixed point", &
                                                       "cycle      ", "torus      ", &
                                                       "3-torus    ", "chaos      "]

   !> Why a class is undecided.
   enum, bind(c)
      enumerator :: none, no_class_by_exponents, contradicted, not_confirmed, unstable_rest, &
                    not_stationary
   end enum

   !> Names of the reasons, from `none` on.
   character(len=21), parameter :: reason_names(0:5) = ["none                 ", &
                                                        "no class by exponents", &
                                                        "contradicted         ", &
                                                        "not confirmed        ", &
                                                        "unstable rest        ", &
                                                        "not stationary       "]

   !> A rate of growth far from zero: its distance in standard errors (during an approach those of a
   !> cycle may be three, by chance), and its e-foldings in the time of the measurement (a slow
   !> motion makes fewer in a vector that neither grows nor shrinks).
   real(wp), parameter :: least_distance = 6.0_wp, least_change = 3.0_wp

contains

   !> The class by leading exponents: all negative, a fixed point; one zero, the others negative, a
   !> cycle; two zero, a torus; three zero and the fourth far from zero, a 3-torus; positive ones,
   !> chaos. It is undecided if there are positive and negative exponents but no zero one, if all or
   !> more than three are zero, if the error bar of a zero exponent is too long, or if one that is
   !> not zero has no sign.
   pure integer function class_by_exponents(exponents, zero_level, longest_bar) result(found)
      !> Exponents, descending
      type(exponent_type), intent(in) :: exponents(:)
      !> An exponent this close to zero is zero
      real(wp), intent(in) :: zero_level
      !> Longest error bar (of three standard errors) of a zero exponent
      real(wp), intent(in) :: longest_bar
      integer :: signs(size(exponents))

      signs = sign_of(exponents, zero_level, longest_bar)
      found = undecided
      if (any(signs == positive)) then
         if (any(signs == zero .or. signs == unclear) .or. all(signs == positive)) found = chaos
      else if (any(signs /= zero) .and. all(signs /= unclear)) then
         select case (count(signs == zero))
         case (0)
            found = fixed_point
         case (1)
            found = cycle_motion
         case (2)
            found = torus
         case (3)
            if (-exponents(4)%value > least_distance*exponents(4)%error) found = three_torus
         case default
            found = undecided
         end select
      end if
   end function class_by_exponents

   !> The class by exponents, if the section confirms it, or the spectrum where the section shows
   !> nothing, or if it is clear by the exponents alone. A section that is smooth or repeats
   !> outweighs a spectrum: lines too close to each other look like a continuum.
   pure subroutine agree(by_exponents, clear, by_section, by_spectrum, found, reason)
      !> Class by exponents
      integer, intent(in) :: by_exponents
      !> Whether the class by exponents is so clear that it needs no confirmation
      logical, intent(in) :: clear
      !> Class by the section; `undecided` neither confirms nor contradicts
      integer, intent(in) :: by_section
      !> Class by the spectrum; `undecided` neither confirms nor contradicts
      integer, intent(in) :: by_spectrum
      !> The class; why it is undecided, of `reason_names`
      integer, intent(out) :: found, reason

      associate (witness => merge(by_spectrum, by_section, by_section == undecided))
         found = undecided
         if (by_exponents == undecided) then
            reason = no_class_by_exponents
         else if (witness /= undecided .and. witness /= by_exponents) then
            reason = contradicted
         else if (witness == undecided .and. .not. clear) then
            reason = not_confirmed
         else
            found = by_exponents
            reason = none
         end if
      end associate
   end subroutine agree

   !> Whether the leading exponents are two equal ones that are positive, as those of an unstable
   !> cycle that the motion has not left yet.
   pure logical function leaves_cycle(exponents) result(value)
      !> Exponents, descending
      type(exponent_type), intent(in) :: exponents(:)

      value = .false.
      if (size(exponents) < 2) return
      associate (first => exponents(1), second => exponents(2))
         value = second%value > error_bars*second%error &
                 .and. first%value - second%value <= error_bars*max(first%error, second%error)
      end associate
   end function leaves_cycle

   !> Whether one exponent is the flow's and all others are far from zero: then they need no
   !> confirmation. If all of them are negative, the attractor is a cycle.
   pure logical function clear_by_exponents(exponents, time) result(value)
      !> Exponents, descending
      type(exponent_type), intent(in) :: exponents(:)
      !> Time in which they were measured
      real(wp), intent(in) :: time

      value = count(abs(exponents%value) > least_distance*exponents%error &
                    .and. abs(exponents%value)*time >= least_change) == size(exponents) - 1
   end function clear_by_exponents
end module motion_classes
