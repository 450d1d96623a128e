! SPDX-License-Identifier: BSD-3-Clause
!> What changes nothing, by all methods: other names and units, cuts of a run, threads, copies and
!> components beside.
module test_dde_invariance
   use banded_problems, only: in_a_band
   use dde, only: continuation_type, dde_problem_type, integrate, integration_options, &
                  integration_result, methods, table_sampler, too_many_steps
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use layer_problems, only: layer
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   !$ use omp_lib, only: omp_get_num_threads
   use piecewise_problems, only: logistic
   use published_problems, only: enzyme, infection, mackey_glass, published_infection
   use renamed_problems, only: renamed
   use solving, only: at_tolerance, run
   use stiff_problems, only: exponential_decay, follower, prothero_robinson
   use test_problems, only: constant_past, sine, wille_baker
   use undelayed_problems, only: swing
   implicit none (type, external)
   private
   public :: collect_dde_invariance

   !> One of the runs side by side.
   type :: run_type
      class(dde_problem_type), allocatable :: problem
      character(len=8) :: method
      type(integration_result) :: outcome
      type(table_sampler) :: table
      type(failure_type), allocatable :: failure
   end type run_type

contains

   subroutine collect_dde_invariance(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("other units, another order", test_names), &
                   new_unittest("a run equals its parts", test_parts), &
                   new_unittest("threads", test_threads), &
                   new_unittest("components beside and copies", test_copies), &
                   new_unittest("one loose component", test_loose), &
                   new_unittest("few equations", test_few)]
   end subroutine collect_dde_invariance

   !> With state, time and absolute tolerance in units that are powers of two the bits are the same.
   !> With components in other units each, and components and delays in reversed order, they are by
   !> explicit methods; linear systems are then eliminated in another order. From t = 100, with a
   !> unit of time of eight spacings there, and in two parts, the solution is the same.
   subroutine test_names(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(methods)
         call rename("layer", layer(30.0_wp, 0.5_wp), 3.75_wp)
         call rename("infection", infection(), 20.0_wp)
         call rename("two delays", wille_baker(), 4.0_wp)
         call rename("oscillator", swing(), 10.0_wp)
         if (methods(i) /= "taylor") call rename("enzyme", enzyme(), 10.0_wp)
      end do

   contains

      subroutine rename(name, problem, t_end)
         character(len=*), intent(in) :: name
         class(constant_past), intent(in) :: problem
         real(wp), intent(in) :: t_end
         integer, parameter :: powers(5) = [-40, 13, 40, -100, 0], of_time(5) = [7, -20, 0, 3, -43]
         real(wp), parameter :: start(5) = [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 100.0_wp]
         type(continuation_type) :: state
         type(integration_options) :: options
         type(integration_result) :: known, outcome
         type(renamed) :: other
         integer :: j, k
         logical :: same

         options = at_tolerance(1.0e-9_wp, methods(i))
         options%absolute = 2.0_wp**(-20)
         call run(error, problem, 0.0_wp, t_end, options, known)
         do j = 1, size(powers)
            if (allocated(error)) return
            other = renamed(problem, [(2.0_wp**(powers(j)*merge(k, 1, j == 4)), k=1, problem%n)], &
                            2.0_wp**of_time(j), reversed=j == 4)
            options%each_absolute = options%absolute*other%unit
            options%unit_of_time = other%unit_of_time
            state = continuation_type()
            associate (length => t_end*other%unit_of_time)
               if (j == 5) then
                  call run(error, other, start(j), start(j) + 0.3_wp*length, options, outcome, &
                           continuation=state)
               end if
               call run(error, other, max(start(j), state%time(1)), start(j) + length, options, &
                        outcome, continuation=state)
            end associate
            if (allocated(error)) return
            same = j < 4 .or. j == 4 .and. index(methods(i), "radau") == 0
            call expect_close(error, outcome%y/other%unit, known%y(other%order), &
                              merge(0.0_wp, 2*options%absolute*maxval(abs(known%y)), same), &
                              name//" renamed, "//text(j)//", by "//methods(i))
            call expect(error, .not. same .or. outcome%accepted == known%accepted, "the same steps")
         end do
      end subroutine rename
   end subroutine test_names

   !> Runs that go on from where one ended: in the middle of the first delay, at its end, and on;
   !> and in steps of three. What was written to a file and read back gives the same bits.
   subroutine test_parts(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: pi = acos(-1.0_wp)
      type(continuation_type) :: state
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome, whole
      integer :: i, k, runs, steps

      do i = 1, size(methods)
         options = at_tolerance(1.0e-10_wp, methods(i))
         call go_on(sine(), [0.7_wp, 0.8_wp, 0.5_wp*pi, pi, 4.0_wp, 19.0_wp, 30.0_wp], &
                    [sin(30.0_wp)], 1.0e-8_wp)
         call go_on(infection(), [0.5_wp, 1.0_wp, 3.7_wp, 10.0_wp, 11.0_wp, 25.0_wp, 40.0_wp], &
                    published_infection, 2.0e-8_wp)
         options%most_steps = 3
         state = continuation_type()
         do runs = 1, 1000
            call integrate(sine(), state%time(1), 20.0_wp, options, outcome, failure, &
                           continuation=state)
            if (outcome%reason /= too_many_steps) exit
         end do
         call expect_success(error, failure)
         call expect_between(error, real(runs, wp), 3.0_wp, 200.0_wp, "runs of "//methods(i))
         call expect_close(error, outcome%y, [sin(20.0_wp)], 1.0e-7_wp, methods(i))
      end do
      ! a cut costs a Taylor step, not those of a whole delay
      options = at_tolerance(1.0e-10_wp, "taylor")
      call run(error, mackey_glass(), 0.0_wp, 600.0_wp, options, whole)
      call go_on(mackey_glass(), [(30.0_wp*k, k=1, 20)], whole%y, 1.0e-6_wp)
      call expect(error, steps <= whole%accepted + 20, text(steps)//" steps in pieces")

   contains

      subroutine go_on(problem, ends, known, within)
         class(dde_problem_type), intent(in) :: problem
         real(wp), intent(in) :: ends(:), known(:), within
         type(continuation_type) :: read_back
         type(integration_result) :: there

         state = continuation_type()
         steps = 0
         do k = 1, size(ends)
            if (k > 1) read_back = through_file(state)
            if (k > 1) call run(error, problem, state%time(1), ends(k), options, there, &
                                continuation=read_back)
            call run(error, problem, state%time(1), ends(k), options, outcome, continuation=state)
            if (allocated(error)) return
            steps = steps + int(outcome%accepted)
            if (k > 1) call expect_same(error, there, outcome, options%method//" from a file")
         end do
         call expect_close(error, outcome%y, known, within, options%method)
      end subroutine go_on
   end subroutine test_parts

   !> What comes back from a text file that was written, with all digits, and read.
   function through_file(kept) result(back)
      type(continuation_type), intent(in) :: kept
      type(continuation_type) :: back
      integer :: unit

      back = kept
      open (newunit=unit, status="scratch", action="readwrite", form="formatted")
      write (unit, "(*(es27.17e4))") kept%time, kept%origin, kept%y, kept%slope, kept%rate, &
         kept%next_step, kept%kink, kept%step_start, kept%step_length, kept%valid_for, &
         kept%nodes, kept%coefficients
      write (unit, "(a, *(1x, i0))") kept%method, kept%passages, kept%generation, kept%kept
      rewind (unit)
      read (unit, *) back%time, back%origin, back%y, back%slope, back%rate, &
         back%next_step, back%kink, back%step_start, back%step_length, back%valid_for, &
         back%nodes, back%coefficients
      read (unit, *) back%method, back%passages, back%generation, back%kept
      close (unit)
   end function through_file

   !> Forty integrations in four threads, twice over, are those one after the other.
   subroutine test_threads(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: runs = 40
      type(run_type) :: alone(runs), together(runs)
      integer :: i, round, threads

      do i = 1, runs
         call prepare(i, alone(i))
         call integrate_one(alone(i))
         call expect_success(error, alone(i)%failure)
      end do
      do round = 1, 2
         do i = 1, runs
            call prepare(i, together(i))
         end do
         threads = 0
         !$omp parallel do num_threads(4) schedule(dynamic, 1) reduction(max: threads)
         do i = 1, runs
            !$ threads = omp_get_num_threads()
            call integrate_one(together(i))
         end do
         !$omp end parallel do
         !$ call expect(error, threads > 1, "more than one thread")
         do i = 1, runs
            call expect_success(error, together(i)%failure)
            if (allocated(error)) return
            call expect_same(error, together(i)%outcome, alone(i)%outcome, "run "//text(i))
            call expect_close(error, together(i)%table%values(1, :), alone(i)%table%values(1, :), &
                              0.0_wp, "samples of run "//text(i))
         end do
      end do
   end subroutine test_threads

   !> Integration number i.
   subroutine prepare(i, one)
      integer, intent(in) :: i
      type(run_type), intent(out) :: one
      integer :: k

      one%method = methods(1 + modulo(i, size(methods)))
      select case (modulo(i, 5))
      case (0)
         allocate (one%problem, source=sine())
      case (1)
         allocate (one%problem, source=follower(10.0_wp + 0.1_wp*i, start=2.0_wp))
      case (2)
         allocate (one%problem, source=mackey_glass(past=[1.0_wp + 0.01_wp*i]))
      case (3)
         allocate (one%problem, source=infection())
      case default
         allocate (one%problem, source=swing(1.0_wp + 0.01_wp*i))
      end select
      one%table = table_sampler([1], [(10.0_wp*k, k=1, 5)])
   end subroutine prepare

   subroutine integrate_one(one)
      type(run_type), intent(inout) :: one

      call integrate(one%problem, 0.0_wp, 50.0_wp, at_tolerance(1.0e-7_wp, one%method), &
                     one%outcome, one%failure, one%table)
   end subroutine integrate_one

   !> Two integrations did the same to the last bit.
   subroutine expect_same(error, one, other, what)
      type(error_type), allocatable, intent(inout) :: error
      type(integration_result), intent(in) :: one, other
      character(len=*), intent(in) :: what

      call expect_close(error, one%y, other%y, 0.0_wp, what)
      call expect(error, one%accepted == other%accepted .and. one%rejected == other%rejected &
                  .and. one%evaluations == other%evaluations, what//": same counts")
   end subroutine expect_same

   !> A component that is no part of an equation, of any size, does not change how that is solved.
   !> The first of several copies is solved by as many steps as alone: a limit cycle beside copies
   !> at rest, and a component that the embedded error of implicit methods overlooks.
   subroutine test_copies(error)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: sizes(3) = [1.0e-15_wp, 1.0e9_wp, 1.0e15_wp]
      type(integration_result) :: alone, beside
      real(wp) :: tolerance
      integer :: digits, i, k, n

      do i = 1, size(methods)
         do digits = 4, 8, 2
            tolerance = 10.0_wp**(-digits)
            n = merge(300, 2000, index(methods(i), "radau") > 0)
            call compare(logistic([1.5_wp], 1), logistic([1.5_wp, spread(1.0_wp, 1, n - 1)], n))
            if (index(methods(i), "radau") > 0) then
               call compare(prothero_robinson(-1.0e4_wp), prothero_robinson(-1.0e4_wp, 60))
            end if
            call run(error, logistic([1.2_wp, 1.0_wp], 1), 0.0_wp, 100.0_wp, &
                     at_tolerance(tolerance, methods(i)), alone)
            do k = 1, size(sizes)
               call run(error, logistic([1.2_wp, sizes(k)], 1), 0.0_wp, 100.0_wp, &
                        at_tolerance(tolerance, methods(i)), beside)
               if (allocated(error)) return
               call expect_close(error, beside%y(1), alone%y(1), 0.01_wp*tolerance, &
                                 trim(methods(i))//" beside "//text(sizes(k)))
            end do
         end do
      end do

   contains

      subroutine compare(one, many)
         class(dde_problem_type), intent(in) :: one, many
         type(integration_result) :: first, known

         call run(error, one, 0.0_wp, 20.0_wp, at_tolerance(tolerance, methods(i)), known)
         call run(error, many, 0.0_wp, 20.0_wp, at_tolerance(tolerance, methods(i)), first)
         call expect(error, first%accepted == known%accepted &
                     .and. first%rejected == known%rejected, &
                     text(first%accepted)//" steps by "//trim(methods(i))//" at "//text(tolerance) &
                     //", alone "//text(known%accepted))
         call expect_close(error, first%y(1), known%y(1), 1.0e-3_wp*tolerance, methods(i))
      end subroutine compare
   end subroutine test_copies

   !> A component of which nothing is asked changes nothing of the others.
   subroutine test_loose(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: loose, outcome
      type(integration_options) :: options
      integer :: i

      do i = 1, size(methods)
         if (methods(i) == "taylor") cycle
         options = at_tolerance(1.0e-9_wp, methods(i))
         call run(error, enzyme(), 0.0_wp, 20.0_wp, options, outcome)
         options%each_absolute = [1.0e-9_wp, 1.0e-9_wp, 1.0e-9_wp, 1.0e6_wp]
         call run(error, enzyme(), 0.0_wp, 20.0_wp, options, loose)
         call expect_between(error, loose%accepted/real(outcome%accepted, wp), 0.8_wp, 1.2_wp, &
                             methods(i))
      end do
   end subroutine test_loose

   !> Radau IIA is compiled for one to four equations. A problem with a band as wide as its matrix
   !> takes what is compiled for any number: each bit and each count is the same, with delays inside
   !> and outside of the step.
   subroutine test_few(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: digits, i

      do i = 1, size(methods)
         if (index(methods(i), "radau") == 0) cycle
         do digits = 2, 10, 4
            call compare(prothero_robinson(-1.0e3_wp), 1, 3.0_wp)
            call compare(exponential_decay(0.01_wp), 1, 0.5_wp)
            call compare(swing(), 2, 10.0_wp)
            call compare(follower(1.0e4_wp, 1.0_wp, 0.1_wp), 2, 3.0_wp)
            call compare(infection(), 3, 20.0_wp)
            call compare(enzyme(), 4, 30.0_wp)
         end do
      end do

   contains

      subroutine compare(problem, equations, t_end)
         class(dde_problem_type), intent(in) :: problem
         integer, intent(in) :: equations
         real(wp), intent(in) :: t_end
         type(in_a_band) :: banded
         type(integration_options) :: options
         type(integration_result) :: any, few

         if (allocated(error)) return
         call expect(error, problem%n == equations, "the number of equations")
         banded = in_a_band(problem)
         options = at_tolerance(10.0_wp**(-digits), methods(i))
         call run(error, problem, 0.0_wp, t_end, options, few)
         call run(error, banded, 0.0_wp, t_end, options, any)
         if (allocated(error)) return
         call expect_close(error, few%y, any%y, 0.0_wp, methods(i)//": "//text(equations))
         call expect(error, few%accepted == any%accepted .and. few%rejected == any%rejected &
                     .and. few%evaluations == any%evaluations, "counts")
         call expect_close(error, few%work, any%work, 0.0_wp, "work of "//methods(i))
      end subroutine compare
   end subroutine test_few
end module test_dde_invariance
