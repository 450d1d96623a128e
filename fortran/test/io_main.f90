!> Runs the unit tests of what reads namelists.
program io_tester
   use, intrinsic :: iso_fortran_env, only: error_unit
   use mctc_env_testing, only: run_testsuite
   use test_io_inputs, only: collect_io_inputs
   use test_io_refusals, only: collect_io_refusals
   use test_io_surveys, only: collect_io_surveys
   implicit none (type, external)
   integer :: failed

   failed = 0
   call run_testsuite(collect_io_inputs, error_unit, failed)
   call run_testsuite(collect_io_refusals, error_unit, failed)
   call run_testsuite(collect_io_surveys, error_unit, failed)
   if (failed > 0) error stop "some tests failed"
end program io_tester
