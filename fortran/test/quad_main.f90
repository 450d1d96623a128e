!> Runs the unit tests of the solver in quadruple precision.
program quad_tester
   use, intrinsic :: iso_fortran_env, only: error_unit
   use mctc_env_testing, only: run_testsuite
   use test_quadruple, only: collect_quadruple
   implicit none (type, external)
   integer :: failed

   failed = 0
   call run_testsuite(collect_quadruple, error_unit, failed)
   if (failed > 0) error stop "some tests failed"
end program quad_tester
