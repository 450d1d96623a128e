!> Runs one suite of unit tests, named by the first argument; without one, all of them.
program tester
   use, intrinsic :: iso_fortran_env, only: error_unit
   use mctc_env_testing, only: new_testsuite, run_testsuite, testsuite_type
   use test_dde_solutions, only: collect_dde_solutions
   implicit none
   type(testsuite_type), allocatable :: suites(:)
   character(len=32) :: wanted
   integer :: failed, i, run

   suites = [new_testsuite('dde_solutions', collect_dde_solutions)]
   wanted = ''
   if (command_argument_count() > 0) call get_command_argument(1, wanted)
   failed = 0
   run = 0
   do i = 1, size(suites)
      if (wanted /= '' .and. wanted /= suites(i)%name) cycle
      write (error_unit, '(2a)') 'Testing: ', suites(i)%name
      call run_testsuite(suites(i)%collect, error_unit, failed)
      run = run + 1
   end do
   if (run == 0) error stop 'no suite of that name'
   if (failed > 0) error stop 'some tests failed'
end program tester
