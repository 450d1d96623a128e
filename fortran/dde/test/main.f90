!> Runs one suite of unit tests, named by the first argument; without one, all of them.
program dde_tester
   use, intrinsic :: iso_fortran_env, only: error_unit
   use mctc_env_testing, only: new_testsuite, run_testsuite, testsuite_type
   use test_dde_behaviour, only: collect_dde_behaviour
   use test_dde_breaks, only: collect_dde_breaks
   use test_dde_continuation, only: collect_dde_continuation
   use test_dde_controller, only: collect_dde_controller
   use test_dde_convergence, only: collect_dde_convergence
   use test_dde_copies, only: collect_dde_copies
   use test_dde_events, only: collect_dde_events
   use test_dde_history, only: collect_dde_history
   use test_dde_implicit_order, only: collect_dde_implicit_order
   use test_dde_large, only: collect_dde_large
   use test_dde_memory, only: collect_dde_memory
   use test_dde_order, only: collect_dde_order
   use test_dde_past_series, only: collect_dde_past_series
   use test_dde_pieces, only: collect_dde_pieces
   use test_dde_receivers, only: collect_dde_receivers
   use test_dde_refusals, only: collect_dde_refusals
   use test_dde_sizes, only: collect_dde_sizes
   use test_dde_solutions, only: collect_dde_solutions
   use test_dde_stops, only: collect_dde_stops
   use test_dde_time, only: collect_dde_time
   use test_dde_work, only: collect_dde_work
   implicit none (type, external)
   type(testsuite_type), allocatable :: suites(:)
   character(len=32) :: wanted
   integer :: failed, i, run

   allocate (suites, source=[new_testsuite("dde_behaviour", collect_dde_behaviour), &
                             new_testsuite("dde_breaks", collect_dde_breaks), &
                             new_testsuite("dde_continuation", collect_dde_continuation), &
                             new_testsuite("dde_controller", collect_dde_controller), &
                             new_testsuite("dde_convergence", collect_dde_convergence), &
                             new_testsuite("dde_copies", collect_dde_copies), &
                             new_testsuite("dde_events", collect_dde_events), &
                             new_testsuite("dde_history", collect_dde_history), &
                             new_testsuite("dde_implicit_order", collect_dde_implicit_order), &
                             new_testsuite("dde_large", collect_dde_large), &
                             new_testsuite("dde_memory", collect_dde_memory), &
                             new_testsuite("dde_order", collect_dde_order), &
                             new_testsuite("dde_past_series", collect_dde_past_series), &
                             new_testsuite("dde_pieces", collect_dde_pieces), &
                             new_testsuite("dde_receivers", collect_dde_receivers), &
                             new_testsuite("dde_refusals", collect_dde_refusals), &
                             new_testsuite("dde_sizes", collect_dde_sizes), &
                             new_testsuite("dde_solutions", collect_dde_solutions), &
                             new_testsuite("dde_stops", collect_dde_stops), &
                             new_testsuite("dde_time", collect_dde_time), &
                             new_testsuite("dde_work", collect_dde_work)])
   wanted = ""
   if (command_argument_count() > 0) call get_command_argument(1, wanted)
   failed = 0
   run = 0
   do i = 1, size(suites)
      if (wanted /= "" .and. wanted /= suites(i)%name) cycle
      write (error_unit, "(2a)") "Testing: ", suites(i)%name
      call run_testsuite(suites(i)%collect, error_unit, failed)
      run = run + 1
   end do
   ! the variables of a program live on after its end, where a leak checker would count them
   deallocate (suites)
   if (run == 0) error stop "no suite of that name"
   if (failed > 0) error stop "some tests failed"
end program dde_tester
