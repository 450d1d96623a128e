module test_attractor_points
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   implicit none (type, external)
   private
   public :: collect_attractor_points
contains
   subroutine collect_attractor_points(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)
      allocate (testsuite(0))
   end subroutine collect_attractor_points
end module test_attractor_points
