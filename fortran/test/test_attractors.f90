module test_attractors
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   implicit none (type, external)
   private
   public :: collect_attractors
contains
   subroutine collect_attractors(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)
      allocate (testsuite(0))
   end subroutine collect_attractors
end module test_attractors
