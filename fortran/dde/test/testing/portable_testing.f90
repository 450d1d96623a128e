! SPDX-License-Identifier: BSD-3-Clause
!> What the unit tests use of mctc-lib's module of the same name, for compilers that cannot read
!> Debian's build of it (only gfortran can).
module mctc_env_testing
   implicit none (type, external)
   private
   public :: error_type, new_testsuite, new_unittest, run_testsuite, test_failed, testsuite_type, &
             unittest_type

   !> Why a test failed.
   type :: error_type
      !> In words
      character(len=:), allocatable :: message
   end type error_type

   abstract interface
      !> A test.
      subroutine test_interface(error)
         import :: error_type
         implicit none (type, external)
         type(error_type), allocatable, intent(out) :: error
      end subroutine test_interface
   end interface

   !> A test with its name.
   type :: unittest_type
      !> What is tested
      character(len=:), allocatable :: name
      !> The test
      procedure(test_interface), pointer, nopass :: test => null()
   end type unittest_type

   abstract interface
      !> Lists the tests of a suite.
      subroutine collect_interface(testsuite)
         import :: unittest_type
         implicit none (type, external)
         type(unittest_type), allocatable, intent(out) :: testsuite(:)
      end subroutine collect_interface
   end interface

   !> A suite with its name.
   type :: testsuite_type
      !> Name of the suite
      character(len=:), allocatable :: name
      !> Lists its tests
      procedure(collect_interface), pointer, nopass :: collect => null()
   end type testsuite_type

contains

   !> A test with its name.
   function new_unittest(name, test) result(unittest)
      character(len=*), intent(in) :: name
      !> The test
      procedure(test_interface) :: test
      type(unittest_type) :: unittest

      unittest%name = name
      unittest%test => test
   end function new_unittest

   !> A suite with its name.
   function new_testsuite(name, collect) result(testsuite)
      character(len=*), intent(in) :: name
      !> Lists its tests
      procedure(collect_interface) :: collect
      type(testsuite_type) :: testsuite

      testsuite%name = name
      testsuite%collect => collect
   end function new_testsuite

   !> Let a test fail.
   subroutine test_failed(error, message)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), intent(in) :: message

      allocate (error)
      error%message = message
   end subroutine test_failed

   !> Run the tests of a suite and tell how each ended.
   subroutine run_testsuite(collect, unit, failed)
      !> Lists the tests
      procedure(collect_interface) :: collect
      integer, intent(in) :: unit
      integer, intent(inout) :: failed
      type(unittest_type), allocatable :: tests(:)
      type(error_type), allocatable :: error
      integer :: i

      call collect(tests)
      do i = 1, size(tests)
         call tests(i)%test(error)
         if (allocated(error)) then
            failed = failed + 1
            write (unit, "(4a)") "  ", tests(i)%name, " [FAILED] ", error%message
         else
            write (unit, "(3a)") "  ", tests(i)%name, " [PASSED]"
         end if
      end do
   end subroutine run_testsuite
end module mctc_env_testing
