!> Root finding by GSL: known roots, and brackets or functions that cannot do.
module test_gsl_roots
   use, intrinsic :: ieee_arithmetic, only: ieee_get_halting_mode, ieee_invalid, ieee_quiet_nan, &
                                            ieee_set_halting_mode, ieee_value
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect_close, expect_failure, expect_success
   use gsl_roots, only: find_falling_root, find_root, scalar_function_type
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   implicit none (type, external)
   private
   public :: collect_gsl_roots

   !> cos x - slope x.
   type, extends(scalar_function_type) :: cosine_less_line
      !> Slope of the line
      real(wp) :: slope = 1.0_wp
   contains
      procedure :: value => cosine_less_line_value
   end type cosine_less_line

   !> -1 up to one x, 1 from another on, no number between.
   type, extends(scalar_function_type) :: hole
      !> Where it begins and ends
      real(wp) :: left = 0.0_wp, right = 1.0_wp
   contains
      procedure :: value => hole_value
   end type hole

contains

   !> All tests of this suite.
   subroutine collect_gsl_roots(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("cos x = x", test_cosine), &
                   new_unittest("a parameter of the function", test_parameter), &
                   new_unittest("a root at the end", test_root_at_end), &
                   new_unittest("a jump", test_jump), &
                   new_unittest("where a function falls", test_falling), &
                   new_unittest("signs that do not differ", test_same_signs), &
                   new_unittest("a reversed bracket", test_reversed), &
                   new_unittest("no convergence", test_no_convergence)]
   end subroutine collect_gsl_roots

   !> Dottie's number.
   subroutine test_cosine(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: root

      call find_root(cosine_less_line(), 0.0_wp, 1.0_wp, root, failure)
      call expect_success(error, failure)
      call expect_close(error, root, 0.73908513321516064166_wp, 1.0e-15_wp, "root")
   end subroutine test_cosine

   !> cos x = 0: the function is called with its own parameters.
   subroutine test_parameter(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: root

      call find_root(cosine_less_line(slope=0.0_wp), 4.0_wp, 5.0_wp, root, failure)
      call expect_success(error, failure)
      call expect_close(error, root, 1.5_wp*acos(-1.0_wp), 5.0e-15_wp, "root")
   end subroutine test_parameter

   !> cos x = x from starts far below and above the root.
   subroutine test_falling(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp), parameter :: starts(4) = [1.0e-3_wp, 0.7_wp, 0.8_wp, 1.0e3_wp]
      real(wp) :: root
      integer :: i

      do i = 1, size(starts)
         call find_falling_root(cosine_less_line(), starts(i), root, failure)
         call expect_success(error, failure)
         call expect_close(error, root, 0.73908513321516064166_wp, 1.0e-15_wp, "root")
      end do
   end subroutine test_falling

   !> 0.73908... or its neighbour as one end of the bracket.
   subroutine test_root_at_end(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp), parameter :: known = 0.73908513321516064166_wp
      real(wp) :: root

      call find_root(cosine_less_line(), known*(1.0_wp - 2.0e-16_wp), 7.0_wp, root, failure)
      call expect_success(error, failure)
      call expect_close(error, root, known, 2.0e-15_wp, "root")
   end subroutine test_root_at_end

   !> A jump from -1 to 1 at 1/3, where only halving helps, is located to the last bits.
   subroutine test_jump(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp), parameter :: third = 1.0_wp/3.0_wp
      real(wp) :: root

      call find_root(hole(third, nearest(third, 1.0_wp)), -1.0_wp, 2.5_wp, root, failure)
      call expect_success(error, failure)
      call expect_close(error, root, third, 1.0e-15_wp, "root")
   end subroutine test_jump

   !> A bracket without a change of sign is refused with both values.
   subroutine test_same_signs(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: root

      call find_root(cosine_less_line(), 1.0_wp, 2.0_wp, root, failure)
      call expect_failure(error, failure, &
                          "f(1.0) = -0.45969769413186 and f(2.0) = -2.41614683654714")
      call expect_failure(error, failure, "opposite signs expected")
      call find_root(cosine_less_line(), -1.0_wp, 0.5_wp, root, failure)
      call expect_failure(error, failure, "opposite signs expected")
   end subroutine test_same_signs

   !> A bracket whose ends are exchanged, or one, is refused as such.
   subroutine test_reversed(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: root

      call find_root(cosine_less_line(), 1.0_wp, 0.5_wp, root, failure)
      call expect_failure(error, failure, "bracket 1.0..0.5; lower end < upper end expected")
      call find_root(cosine_less_line(), 1.0_wp, 1.0_wp, root, failure)
      call expect_failure(error, failure, "bracket 1.0..1.0")
   end subroutine test_reversed

   !> A function without values inside the bracket ends in words, not in a wrong root.
   subroutine test_no_convergence(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: root
      logical :: trapping

      call ieee_get_halting_mode(ieee_invalid, trapping)
      call ieee_set_halting_mode(ieee_invalid, .false.)
      call find_root(hole(), -1.0_wp, 2.5_wp, root, failure)
      call ieee_set_halting_mode(ieee_invalid, trapping)
      call expect_failure(error, failure, "no convergence in 200 iterations")
   end subroutine test_no_convergence

   !> cos x - slope x.
   real(wp) function cosine_less_line_value(self, x) result(value)
      class(cosine_less_line), intent(in) :: self
      real(wp), intent(in) :: x

      value = cos(x) - self%slope*x
   end function cosine_less_line_value

   !> -1, no number, or 1.
   real(wp) function hole_value(self, x) result(value)
      class(hole), intent(in) :: self
      real(wp), intent(in) :: x

      value = ieee_value(x, ieee_quiet_nan)
      if (x <= self%left) value = -1.0_wp
      if (x >= self%right) value = 1.0_wp
   end function hole_value
end module test_gsl_roots
