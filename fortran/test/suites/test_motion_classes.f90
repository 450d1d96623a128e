! SPDX-License-Identifier: BSD-3-Clause
!> Classes of motion from exponents, and the verdict of three witnesses.
module test_motion_classes
   use dde_errors, only: text
   use expectations, only: expect
   use exponent_averages, only: exponent_type
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use motion_classes, only: agree, chaos, class_by_exponents, class_names, clear_by_exponents, &
                             contradicted, cycle_motion, fixed_point, leaves_cycle, &
                             no_class_by_exponents, none, not_confirmed, three_torus, torus, &
                             undecided
   implicit none (type, external)
   private
   public :: collect_motion_classes

   !> What is as good as zero, and the longest error bar of a zero.
   real(wp), parameter :: zero_level = 1.0e-4_wp, longest_bar = 1.0e-3_wp

contains

   subroutine collect_motion_classes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("classes by exponents", test_classes), &
                   new_unittest("3-torus", test_three_torus), &
                   new_unittest("undecided", test_undecided), &
                   new_unittest("clear exponents", test_clear), &
                   new_unittest("near an unstable cycle", test_leaving), &
                   new_unittest("verdict of three", test_agreement)]
   end subroutine collect_motion_classes

   !> Exponents with these values and errors tell this class.
   subroutine expect_class(error, values, errors, class)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: values(:), errors(:)
      integer, intent(in) :: class
      character(len=:), allocatable :: words
      integer :: found, i

      found = class_by_exponents(exponents_of(values, errors), zero_level, longest_bar)
      words = ""
      do i = 1, size(values)
         words = words//" "//text(values(i))//" +- "//text(errors(i))
      end do
      call expect(error, found == class, "exponents"//words//" tell "//trim(class_names(class)) &
                  //" (they told "//trim(class_names(found))//")")
   end subroutine expect_class

   !> Exponents with their errors.
   pure function exponents_of(values, errors) result(exponents)
      real(wp), intent(in) :: values(:), errors(:)
      type(exponent_type) :: exponents(size(values))

      exponents%value = values
      exponents%error = errors
   end function exponents_of

   !> All negative; one zero; two zeros; positive ones with a zero, however long its bar, or nothing
   !> but positive ones.
   subroutine test_classes(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_class(error, [-0.1_wp, -0.1_wp, -2.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], fixed_point)
      call expect_class(error, [-0.1_wp], [0.01_wp], fixed_point)
      call expect_class(error, [-1.01e-4_wp, -0.3_wp], [3.3e-5_wp, 0.0_wp], fixed_point)
      call expect_class(error, [0.0_wp, -0.1_wp, -0.2_wp], [0.0_wp, 0.0_wp, 0.0_wp], cycle_motion)
      call expect_class(error, [9.9e-5_wp, -0.1_wp], [0.0_wp, 0.0_wp], cycle_motion)
      call expect_class(error, [-9.9e-5_wp, -0.1_wp], [0.0_wp, 0.0_wp], cycle_motion)
      call expect_class(error, [9.9e-5_wp, -0.1_wp], [3.3e-4_wp, 0.0_wp], cycle_motion)
      call expect_class(error, [1.0e-5_wp, -1.1e-4_wp], [1.0e-6_wp, 1.0e-6_wp], cycle_motion)
      call expect_class(error, [1.0e-5_wp, -1.0e-5_wp, -0.1_wp], [0.0_wp, 0.0_wp, 0.0_wp], torus)
      call expect_class(error, [9.9e-5_wp, -9.9e-5_wp, -0.1_wp], [3.3e-4_wp, 3.3e-4_wp, 0.0_wp], &
                        torus)
      call expect_class(error, [0.05_wp, 1.0e-5_wp, -0.3_wp], [1.0e-3_wp, 0.0_wp, 0.0_wp], chaos)
      call expect_class(error, [0.05_wp, 2.0e-3_wp, -0.3_wp], [1.0e-3_wp, 1.0e-3_wp, 0.0_wp], chaos)
      call expect_class(error, [0.05_wp, 0.02_wp, 1.0e-5_wp], [1.0e-3_wp, 1.0e-3_wp, 0.0_wp], chaos)
      call expect_class(error, [0.05_wp, 1.0e-5_wp], [1.0e-3_wp, 0.0_wp], chaos)
      call expect_class(error, [0.05_wp, 0.02_wp], [1.0e-3_wp, 1.0e-3_wp], chaos)
      call expect_class(error, [0.05_wp], [1.0e-3_wp], chaos)
   end subroutine test_classes

   !> Three zeros, the fourth at least six standard errors below zero.
   subroutine test_three_torus(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: values(4) = [1.0e-5_wp, 0.0_wp, -1.0e-5_wp, -6.1e-3_wp]
      real(wp), parameter :: bars(4) = [1.0e-6_wp, 0.0_wp, 1.0e-5_wp, 1.0e-3_wp]

      call expect_class(error, values, bars, three_torus)
      call expect_class(error, [values, -0.1_wp], [bars, 0.0_wp], three_torus)
      call expect_class(error, [values(:3), -5.9e-3_wp], bars, undecided)
      ! a positive exponent, however weak, and one whose bar is too long
      call expect_class(error, [1.1e-4_wp, values(2:)], bars, chaos)
      call expect_class(error, values, [3.4e-4_wp, bars(2:)], undecided)
   end subroutine test_three_torus

   !> A zero missed, one with a long bar, one without sign that is not zero, too many zeros, or
   !> nothing but zeros.
   subroutine test_undecided(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_class(error, [0.05_wp, -0.01_wp, -0.3_wp], [1.0e-3_wp, 1.0e-3_wp, 0.0_wp], &
                        undecided)
      call expect_class(error, [1.1e-4_wp, -0.3_wp], [0.0_wp, 0.0_wp], undecided)
      call expect_class(error, [0.0_wp, -0.1_wp], [3.4e-4_wp, 0.0_wp], undecided)
      call expect_class(error, [1.1e-4_wp, -0.1_wp], [3.0e-4_wp, 0.0_wp], undecided)
      call expect_class(error, [0.0_wp, -1.0e-3_wp, -0.1_wp], [0.0_wp, 3.4e-4_wp, 0.0_wp], &
                        undecided)
      call expect_class(error, [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, -0.1_wp], &
                        [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], undecided)
      call expect_class(error, [0.0_wp], [0.0_wp], undecided)
      call expect_class(error, [1.0e-5_wp, 0.0_wp], [0.0_wp, 0.0_wp], undecided)
      call expect_class(error, [1.0e-5_wp, 1.0e-5_wp, 0.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], undecided)
   end subroutine test_undecided

   !> All but one at least six standard errors and three e-foldings from zero.
   subroutine test_clear(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_clear(error, [0.05_wp, 0.0_wp, -0.1_wp], 8.3e-3_wp, 61.0_wp, .true.)
      call expect_clear(error, [0.05_wp, 0.0_wp, -0.1_wp], 8.4e-3_wp, 61.0_wp, .false.)
      call expect_clear(error, [0.05_wp, 0.0_wp, -0.1_wp], 8.3e-3_wp, 59.0_wp, .false.)
      call expect_clear(error, [0.0_wp, 0.0_wp, -0.1_wp], 1.0e-6_wp, 1.0e3_wp, .false.)
      call expect_clear(error, [0.05_wp, -0.05_wp, -0.1_wp], 1.0e-6_wp, 1.0e3_wp, .false.)
   end subroutine test_clear

   !> Exponents with one error bar must be clear, or not.
   subroutine expect_clear(error, values, bar, time, expected)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: values(:), bar, time
      logical, intent(in) :: expected
      integer :: i

      call expect(error, expected .eqv. &
                  clear_by_exponents(exponents_of(values, [(bar, i=1, size(values))]), time), &
                  text(values(1))//" and others +- "//text(bar)//" in "//text(time))
   end subroutine expect_clear

   !> Two positive exponents that are equal.
   subroutine test_leaving(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_leaving(error, [2.0e-3_wp, 1.971e-3_wp, 0.0_wp], .true.)
      call expect_leaving(error, [2.0e-3_wp, 1.969e-3_wp, 0.0_wp], .false.)
      call expect_leaving(error, [2.9e-5_wp, 2.9e-5_wp, 0.0_wp], .false.)
      call expect_leaving(error, [2.0e-3_wp], .false.)
   end subroutine test_leaving

   !> Exponents must be those near an unstable cycle, or not.
   subroutine expect_leaving(error, values, expected)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: values(:)
      logical, intent(in) :: expected
      integer :: i

      call expect(error, expected .eqv. &
                  leaves_cycle(exponents_of(values, [(1.0e-5_wp, i=1, size(values))])), &
                  text(values(1))//" and "//text(size(values) - 1)//" others")
   end subroutine expect_leaving

   !> Every class by exponents with every two opinions, where the exponents are clear and where
   !> they are not.
   subroutine test_agreement(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: by_exponents, by_section, by_spectrum, found, known, reason, sharp, witness

      do sharp = 0, 1
         do by_exponents = undecided, chaos
            do by_section = undecided, chaos
               do by_spectrum = undecided, chaos
                  known = by_exponents
                  witness = by_section
                  if (by_section == undecided) witness = by_spectrum
                  if (witness == undecided .and. sharp == 0) known = undecided
                  if (witness /= undecided .and. witness /= by_exponents) known = undecided
                  call agree(by_exponents, sharp == 1, by_section, by_spectrum, found, reason)
                  call expect(error, found == known, trim(class_names(by_exponents))//", " &
                              //trim(class_names(by_section))//" and " &
                              //trim(class_names(by_spectrum))//" make " &
                              //trim(class_names(known)))
                  call expect(error, (reason == none) .eqv. (found /= undecided), "a reason")
               end do
            end do
         end do
      end do
      call agree(undecided, .true., torus, torus, found, reason)
      call expect(error, reason == no_class_by_exponents, "no class by exponents")
      call agree(cycle_motion, .true., torus, undecided, found, reason)
      call expect(error, reason == contradicted, "contradicted")
      call agree(torus, .false., undecided, undecided, found, reason)
      call expect(error, reason == not_confirmed, "not confirmed")
   end subroutine test_agreement
end module test_motion_classes
