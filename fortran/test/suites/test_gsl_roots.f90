!> Root finding by GSL: known roots, and brackets or functions that cannot do.
module test_gsl_roots
   use, intrinsic :: ieee_arithmetic, only: ieee_get_halting_mode, ieee_invalid, ieee_quiet_nan, &
                                            ieee_set_halting_mode, ieee_value
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect_close, expect_failure, expect_success
   use gsl_roots, only: find_root, scalar_function_type
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   implicit none (type, external)
   private
   public :: collect_gsl_roots

   !> Dottie's number: cos x = x.
   real(wp), parameter :: dottie = 0.73908513321516064166_wp

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

   subroutine collect_gsl_roots(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("known roots", test_known_roots), &
                   new_unittest("refused brackets", test_refusals), &
                   new_unittest("no convergence", test_no_convergence)]
   end subroutine collect_gsl_roots

   !> cos x = x; cos x = 0, where the function is called with its own parameters; a bracket that
   !> ends at a root; a jump from -1 to 1 at 1/3, where only halving helps.
   subroutine test_known_roots(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: third = 1.0_wp/3.0_wp

      call check(cosine_less_line(), 0.0_wp, 1.0_wp, dottie, 1.0e-15_wp)
      call check(cosine_less_line(slope=0.0_wp), 4.0_wp, 5.0_wp, 1.5_wp*acos(-1.0_wp), 5.0e-15_wp)
      call check(cosine_less_line(), dottie*(1.0_wp - 2.0e-16_wp), 7.0_wp, dottie, 2.0e-15_wp)
      call check(hole(third, nearest(third, 1.0_wp)), -1.0_wp, 2.5_wp, third, 1.0e-15_wp)

   contains

      !> The root in a bracket is the known one.
      subroutine check(f, lower, upper, known, within)
         class(scalar_function_type), intent(in) :: f
         real(wp), intent(in) :: lower, upper, known, within
         type(failure_type), allocatable :: failure
         real(wp) :: root

         call find_root(f, lower, upper, root, failure)
         call expect_success(error, failure)
         call expect_close(error, root, known, within, "root above "//text(lower))
      end subroutine check
   end subroutine test_known_roots

   !> A bracket without a change of sign is refused with both values, a reversed or empty one with
   !> its ends.
   subroutine test_refusals(error)
      type(error_type), allocatable, intent(out) :: error

      call check(1.0_wp, 2.0_wp, "f(1.0) = -0.45969769413186 and f(2.0) = -2.41614683654714; " &
                 //"opposite signs expected")
      call check(-1.0_wp, 0.5_wp, "opposite signs expected")
      call check(1.0_wp, 0.5_wp, "bracket 1.0..0.5; lower end < upper end expected")
      call check(1.0_wp, 1.0_wp, "bracket 1.0..1.0")

   contains

      !> The bracket is refused with these words.
      subroutine check(lower, upper, words)
         real(wp), intent(in) :: lower, upper
         character(len=*), intent(in) :: words
         type(failure_type), allocatable :: failure
         real(wp) :: root

         call find_root(cosine_less_line(), lower, upper, root, failure)
         call expect_failure(error, failure, words)
      end subroutine check
   end subroutine test_refusals

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
