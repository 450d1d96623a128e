!> Classes of motion from exponents, and the verdict of three witnesses.
module test_motion_classes
   use dde_errors, only: text
   use expectations, only: expect
   use exponent_averages, only: exponent_type
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use motion_classes, only: agree, chaos, class_by_exponents, class_names, clear, contradicted, &
                             cycle_motion, fixed_point, no_class_by_exponents, none, &
                             not_confirmed, torus, undecided
   implicit none (type, external)
   private
   public :: collect_motion_classes

   !> What is as good as zero, and the longest error bar of a zero.
   real(wp), parameter :: zero_level = 1.0e-4_wp, longest_bar = 1.0e-3_wp

contains

   !> All tests of this suite.
   subroutine collect_motion_classes(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("fixed point", test_fixed_point), &
                   new_unittest("cycle", test_cycle), &
                   new_unittest("torus", test_torus), &
                   new_unittest("chaos", test_chaos), &
                   new_unittest("undecided", test_undecided), &
                   new_unittest("verdict of three", test_agreement), &
                   new_unittest("names", test_names)]
   end subroutine collect_motion_classes

   !> Exponents with these values and errors tell this class.
   subroutine expect_class(error, values, errors, class)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Values, descending
      real(wp), intent(in) :: values(:)
      !> Standard errors
      real(wp), intent(in) :: errors(:)
      !> The class
      integer, intent(in) :: class
      character(len=:), allocatable :: words
      integer :: found, i

      found = class_by_exponents([(exponent_type(values(i), errors(i)), i=1, size(values))], &
                                 zero_level, longest_bar)
      words = ""
      do i = 1, size(values)
         words = words//" "//text(values(i))//" +- "//text(errors(i))
      end do
      call expect(error, found == class, "exponents"//words//" tell "//trim(class_names(class)) &
                  //" (they told "//trim(class_names(found))//")")
   end subroutine expect_class

   !> All negative.
   subroutine test_fixed_point(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_class(error, [-0.1_wp, -0.1_wp, -2.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], fixed_point)
      call expect_class(error, [-0.1_wp], [0.01_wp], fixed_point)
      call expect_class(error, [-1.01e-4_wp, -0.3_wp], [3.3e-5_wp, 0.0_wp], fixed_point)
   end subroutine test_fixed_point

   !> One zero, the others negative.
   subroutine test_cycle(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_class(error, [0.0_wp, -0.1_wp, -0.2_wp], [0.0_wp, 0.0_wp, 0.0_wp], cycle_motion)
      call expect_class(error, [9.9e-5_wp, -0.1_wp], [0.0_wp, 0.0_wp], cycle_motion)
      call expect_class(error, [-9.9e-5_wp, -0.1_wp], [0.0_wp, 0.0_wp], cycle_motion)
      call expect_class(error, [9.9e-5_wp, -0.1_wp], [3.3e-4_wp, 0.0_wp], cycle_motion)
      call expect_class(error, [1.0e-5_wp, -1.1e-4_wp], [1.0e-6_wp, 1.0e-6_wp], cycle_motion)
   end subroutine test_cycle

   !> Two zeros, the others negative.
   subroutine test_torus(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_class(error, [1.0e-5_wp, -1.0e-5_wp, -0.1_wp], [0.0_wp, 0.0_wp, 0.0_wp], torus)
      call expect_class(error, [9.9e-5_wp, -9.9e-5_wp, -0.1_wp], [3.3e-4_wp, 3.3e-4_wp, 0.0_wp], &
                        torus)
   end subroutine test_torus

   !> Positive ones with a zero, however long its bar, or nothing but positive ones.
   subroutine test_chaos(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_class(error, [0.05_wp, 1.0e-5_wp, -0.3_wp], [1.0e-3_wp, 0.0_wp, 0.0_wp], chaos)
      call expect_class(error, [0.05_wp, 2.0e-3_wp, -0.3_wp], [1.0e-3_wp, 1.0e-3_wp, 0.0_wp], chaos)
      call expect_class(error, [0.05_wp, 0.02_wp, 1.0e-5_wp], [1.0e-3_wp, 1.0e-3_wp, 0.0_wp], chaos)
      call expect_class(error, [0.05_wp, 1.0e-5_wp], [1.0e-3_wp, 0.0_wp], chaos)
      call expect_class(error, [0.05_wp, 0.02_wp], [1.0e-3_wp, 1.0e-3_wp], chaos)
      call expect_class(error, [0.05_wp], [1.0e-3_wp], chaos)
   end subroutine test_chaos

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
      call expect_class(error, [0.0_wp, 0.0_wp, 0.0_wp, -0.1_wp], &
                        [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], undecided)
      call expect_class(error, [0.0_wp], [0.0_wp], undecided)
      call expect_class(error, [1.0e-5_wp, 0.0_wp], [0.0_wp, 0.0_wp], undecided)
      call expect_class(error, [1.0e-5_wp, 1.0e-5_wp, 0.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], undecided)
   end subroutine test_undecided

   !> Every class by exponents with every two opinions, where the exponents are clear and where
   !> they are not.
   subroutine test_agreement(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: by_exponents, by_section, by_spectrum, found, known, reason, sharp, witness
      type(exponent_type) :: exponents(3)

      exponents%value = [0.05_wp, 0.0_wp, -0.1_wp]
      do sharp = 0, 1
         exponents%error = merge(1.0e-3_wp, 1.0e-2_wp, sharp == 1)*[1, 0, 1]
         call expect(error, clear(exponents) .eqv. sharp == 1, "clear")
         do by_exponents = undecided, chaos
            do by_section = undecided, chaos
               do by_spectrum = undecided, chaos
                  known = by_exponents
                  witness = by_section
                  if (by_section == undecided) witness = by_spectrum
                  if (witness == undecided .and. sharp == 0) known = undecided
                  if (witness /= undecided .and. witness /= by_exponents) known = undecided
                  call agree(exponents, by_exponents, by_section, by_spectrum, found, reason)
                  call expect(error, found == known, trim(class_names(by_exponents))//", " &
                              //trim(class_names(by_section))//" and " &
                              //trim(class_names(by_spectrum))//" make " &
                              //trim(class_names(known)))
                  call expect(error, (reason == none) .eqv. (found /= undecided), "a reason")
               end do
            end do
         end do
      end do
      call expect(error, .not. clear([exponent_type(2.0e-3_wp, 1.0e-5_wp), &
                                      exponent_type(1.99e-3_wp, 1.0e-5_wp), &
                                      exponent_type(0.0_wp, 0.0_wp)]), "an unstable cycle")
      call agree(exponents, undecided, torus, torus, found, reason)
      call expect(error, reason == no_class_by_exponents, "no class by exponents")
      call agree(exponents, cycle_motion, torus, undecided, found, reason)
      call expect(error, reason == contradicted, "contradicted")
      exponents(1)%error = 1.0_wp
      call agree(exponents, torus, undecided, undecided, found, reason)
      call expect(error, reason == not_confirmed, "not confirmed")
   end subroutine test_agreement

   !> Each number has its name.
   subroutine test_names(error)
      type(error_type), allocatable, intent(out) :: error

      call expect(error, all(class_names([undecided, fixed_point, cycle_motion, torus, chaos]) == &
                             ["undecided  ", "fixed point", "cycle      ", "torus      ", &
                              "chaos      "]), "names of classes")
   end subroutine test_names
end module test_motion_classes
