! SPDX-License-Identifier: BSD-3-Clause
!> Classes of motion from exponents, the verdict of three witnesses, and approaches to rest.
module test_motion_classes
   use dde_errors, only: text
   use dde_kinds, only: wp
   use expectations, only: expect
   use exponent_averages, only: exponent_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use motion_classes, only: agree, chaos, class_by_exponents, class_names, clear_by_exponents, &
                             contradicted, cycle_motion, fixed_point, leaves_cycle, &
                             no_class_by_exponents, none, not_confirmed, three_torus, torus, &
                             undecided
   use rest, only: settles
   implicit none (type, external)
   private
   public :: collect_motion_classes

   !> What is as good as zero, and the longest error bar of a zero.
   real(wp), parameter :: zero_level = 1.0e-4_wp, longest_bar = 1.0e-3_wp

contains

   subroutine collect_motion_classes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("classes by exponents", test_classes), &
                   new_unittest("undecided", test_undecided), &
                   new_unittest("clear exponents, and those near a cycle", test_clear), &
                   new_unittest("verdict of three", test_agreement), &
                   new_unittest("decay, growth and neither", test_signals)]
   end subroutine collect_motion_classes

   !> Exponents with these values and errors, 0 where there are fewer, tell this class.
   subroutine expect_class(error, values, errors, class)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: values(:), errors(:)
      integer, intent(in) :: class
      integer :: found, i

      found = class_by_exponents(exponents_of(values, [errors, (0.0_wp, i=1, size(values))]), &
                                 zero_level, longest_bar)
      call expect(error, found == class, "exponents from "//text(values(1))//" to " &
                  //text(values(size(values)))//" tell "//trim(class_names(class)) &
                  //" (they told "//trim(class_names(found))//")")
   end subroutine expect_class

   !> Exponents with the first errors.
   pure function exponents_of(values, errors) result(exponents)
      real(wp), intent(in) :: values(:), errors(:)
      type(exponent_type) :: exponents(size(values))

      exponents%value = values
      exponents%error = errors(:size(values))
   end function exponents_of

   !> All negative; one zero; two zeros; positive ones with a zero, however long its bar, or nothing
   !> but positive ones; three zeros, the fourth at least six standard errors below zero.
   subroutine test_classes(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: no_errors(0) = [real(wp) ::]
      real(wp), parameter :: bars(4) = [1.0e-6_wp, 0.0_wp, 1.0e-5_wp, 1.0e-3_wp]
      real(wp), parameter :: zeros(3) = [1.0e-5_wp, 0.0_wp, -1.0e-5_wp]

      call expect_class(error, [-0.1_wp, -0.1_wp, -2.0_wp], no_errors, fixed_point)
      call expect_class(error, [-0.1_wp], [0.01_wp], fixed_point)
      call expect_class(error, [-1.01e-4_wp, -0.3_wp], [3.3e-5_wp], fixed_point)
      call expect_class(error, [9.9e-5_wp, -0.1_wp], no_errors, cycle_motion)
      call expect_class(error, [-9.9e-5_wp, -0.1_wp], no_errors, cycle_motion)
      call expect_class(error, [9.9e-5_wp, -0.1_wp], [3.3e-4_wp], cycle_motion)
      call expect_class(error, [1.0e-5_wp, -1.1e-4_wp], [1.0e-6_wp, 1.0e-6_wp], cycle_motion)
      call expect_class(error, [9.9e-5_wp, -9.9e-5_wp, -0.1_wp], [3.3e-4_wp, 3.3e-4_wp], torus)
      call expect_class(error, [0.05_wp, 1.0e-5_wp, -0.3_wp], [1.0e-3_wp], chaos)
      call expect_class(error, [0.05_wp, 2.0e-3_wp, -0.3_wp], [1.0e-3_wp, 1.0e-3_wp], chaos)
      call expect_class(error, [0.05_wp, 0.02_wp, 1.0e-5_wp], [1.0e-3_wp, 1.0e-3_wp], chaos)
      call expect_class(error, [0.05_wp, 0.02_wp], [1.0e-3_wp, 1.0e-3_wp], chaos)
      call expect_class(error, [zeros, -6.1e-3_wp], bars, three_torus)
      call expect_class(error, [zeros, -6.1e-3_wp, -0.1_wp], bars, three_torus)
      ! a positive exponent, however weak
      call expect_class(error, [1.1e-4_wp, zeros(2:), -6.1e-3_wp], bars, chaos)
   end subroutine test_classes

   !> A zero missed, one with a long bar, one without sign that is not zero, too many zeros, a
   !> fourth one that is near three zeros, or nothing but zeros.
   subroutine test_undecided(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: zeros(4) = 1.0e-5_wp
      real(wp), parameter :: bars(4) = [1.0e-6_wp, 0.0_wp, 1.0e-5_wp, 1.0e-3_wp]
      integer :: n

      call expect_class(error, [0.05_wp, -0.01_wp, -0.3_wp], [1.0e-3_wp, 1.0e-3_wp], undecided)
      call expect_class(error, [1.1e-4_wp, -0.3_wp], [0.0_wp], undecided)
      call expect_class(error, [0.0_wp, -0.1_wp], [3.4e-4_wp], undecided)
      call expect_class(error, [1.1e-4_wp, -0.1_wp], [3.0e-4_wp], undecided)
      call expect_class(error, [0.0_wp, -1.0e-3_wp, -0.1_wp], [0.0_wp, 3.4e-4_wp], undecided)
      call expect_class(error, [zeros, -0.1_wp], [0.0_wp], undecided)
      call expect_class(error, [zeros(:3), -5.9e-3_wp], bars, undecided)
      call expect_class(error, [zeros(:3), -6.1e-3_wp], [3.4e-4_wp, bars(2:)], undecided)
      do n = 1, 3
         call expect_class(error, zeros(:n), [0.0_wp], undecided)
      end do
   end subroutine test_undecided

   !> Clear: all but one at least six standard errors and three e-foldings from zero. Near an
   !> unstable cycle: two positive exponents that are equal.
   subroutine test_clear(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: values(3, 5) = reshape( &
         [0.05_wp, 0.0_wp, -0.1_wp, 0.05_wp, 0.0_wp, -0.1_wp, 0.05_wp, 0.0_wp, -0.1_wp, &
          0.0_wp, 0.0_wp, -0.1_wp, 0.05_wp, -0.05_wp, -0.1_wp], [3, 5])
      real(wp), parameter :: bar(5) = [8.3e-3_wp, 8.4e-3_wp, 8.3e-3_wp, 1.0e-6_wp, 1.0e-6_wp]
      real(wp), parameter :: time(5) = [61.0_wp, 61.0_wp, 59.0_wp, 1.0e3_wp, 1.0e3_wp]
      real(wp), parameter :: first(3) = [2.0e-3_wp, 2.0e-3_wp, 2.9e-5_wp]
      real(wp), parameter :: second(3) = [1.971e-3_wp, 1.969e-3_wp, 2.9e-5_wp]
      integer :: i

      do i = 1, 5
         call expect(error, clear_by_exponents(exponents_of(values(:, i), spread(bar(i), 1, 3)), &
                                               time(i)) .eqv. i == 1, "clear exponents "//text(i))
      end do
      do i = 1, 3
         call expect(error, leaves_cycle(exponents_of([first(i), second(i), 0.0_wp], &
                                                      spread(1.0e-5_wp, 1, 3))) .eqv. i == 1, &
                     "near a cycle "//text(i))
      end do
      call expect(error, .not. leaves_cycle(exponents_of(first(:1), [1.0e-5_wp])), "one exponent")
   end subroutine test_clear

   !> Every class by exponents with every two opinions, where the exponents are clear and where
   !> they are not: the class stands unless a witness, section before spectrum, contradicts, or none
   !> confirms exponents that are not clear.
   subroutine test_agreement(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: by_exponents, by_section, by_spectrum, found, known, reason, sharp, why, witness

      do sharp = 0, 1
         do by_exponents = undecided, chaos
            do by_section = undecided, chaos
               do by_spectrum = undecided, chaos
                  witness = merge(by_section, by_spectrum, by_section /= undecided)
                  why = none
                  if (witness == undecided .and. sharp == 0) why = not_confirmed
                  if (witness /= undecided .and. witness /= by_exponents) why = contradicted
                  if (by_exponents == undecided) why = no_class_by_exponents
                  known = merge(by_exponents, undecided, why == none)
                  call agree(by_exponents, sharp == 1, by_section, by_spectrum, found, reason)
                  call expect(error, found == known .and. reason == why, &
                              trim(class_names(by_exponents))//", " &
                              //trim(class_names(by_section))//" and " &
                              //trim(class_names(by_spectrum))//" make " &
                              //trim(class_names(known))//", reason "//text(why))
               end do
            end do
         end do
      end do
   end subroutine test_agreement

   !> Oscillations of either sign: what shrinks by a fifth from half to half, within 0.2, comes to
   !> rest, and so does what stays within 1e-3.
   subroutine test_signals(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: fifth = -log(0.8_wp)/200.0_wp
      ! fast decay, a little over a fifth and a little less, decay still far away, none, growth,
      ! none but very small, not so small
      real(wp), parameter :: amplitude(8) = [1.0_wp, 0.1_wp, 0.1_wp, 1.0_wp, 0.1_wp, 0.01_wp, &
                                             0.9e-3_wp, 1.1e-3_wp]
      real(wp), parameter :: rate(8) = [-0.1_wp, -1.1_wp*fifth, -0.9_wp*fifth, -1.1_wp*fifth, &
                                        0.0_wp, 0.002_wp, 0.0_wp, 0.0_wp]
      logical, parameter :: known(8) = [.true., .true., .false., .false., .false., .false., &
                                        .true., .false.]
      real(wp) :: w(4000)
      integer :: i, k

      do k = 1, size(known)
         w = [(amplitude(k)*exp(rate(k)*0.1_wp*i)*cos(0.07_wp*i), i=0, 3999)]
         call expect(error, all([settles(w), settles(-w)] .eqv. known(k)), "oscillation "//text(k))
      end do
      call expect(error, .not. settles(spread(0.1_wp, 1, 100)), "a constant away from 0")
      call expect(error, settles(spread(0.0_wp, 1, 100)), "always at rest")
   end subroutine test_signals
end module test_motion_classes
