!> Namelists that cannot be read.
module test_io_inputs
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect_failure
   use exponents_input, only: exponents_settings_type, read_exponents
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use scene_input, only: scene_type
   implicit none (type, external)
   private
   public :: collect_io_inputs

contains

   !> All tests of this suite.
   subroutine collect_io_inputs(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("exponents without a file", test_exponents_without_file)]
   end subroutine collect_io_inputs

   !> A file that is gone before the group &exponents is read is named.
   subroutine test_exponents_without_file(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(exponents_settings_type) :: settings
      type(scene_type) :: scene

      call read_exponents("no-such-file.nml", scene, settings, failure)
      call expect_failure(error, failure, "no-such-file.nml")
   end subroutine test_exponents_without_file
end module test_io_inputs
