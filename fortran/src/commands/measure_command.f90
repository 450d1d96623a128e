! SPDX-License-Identifier: BSD-3-Clause
!> Measured runs: cases solved by several methods at several tolerances, with what each run gave and
!> what it cost, a row a run, with its samples. A run that fails is a row with its reason.
module measure_command
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use cases_request, only: case_settings_type, lines_of_case, most_cases, open_cases
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use measured_case, only: case_type
   use measured_run, only: baseline_methods, measure_run, run_type, time_runs
   use model_attributes, only: put_places
   use model_description, only: description_type, model_length => word_length
   use model_history, only: shown_name
   use request, only: element_length, elements, request_type
   use results, only: joined, results_type
   use value_checks, only: absent, check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: run_measure

   !> Most tolerances or lengths of steps.
   integer, parameter :: most = 100

   !> The runs of each case and how they are measured.
   type :: measure_settings_type
      !> Methods
      character(len=element_length) :: methods(16) = ""
      !> Tolerances of the solver's methods
      real(wp) :: tolerances(most) = absent
      !> Lengths of steps of the other methods
      real(wp) :: steps(most) = absent
      !> Most steps of a run of the solver
      integer(int64) :: most_steps = missing_count
      !> Times measured; 0 for none
      integer :: repeats = missing_count
      !> Shortest time to measure, in CPU seconds
      real(wp) :: least_seconds = missing
   contains
      procedure :: runs => runs_of_methods
   end type measure_settings_type

   !> Longest reason of an end.
   integer, parameter :: reason_length = 200

contains

   !> Run the command.
   subroutine run_measure(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(case_type), allocatable :: cases(:)
      type(measure_settings_type) :: settings
      type(run_type), allocatable :: runs(:)
      integer :: i, j, last, n

      call read_measure(given, cases, settings, error)
      if (allocated(error)) return
      n = size(settings%runs())
      allocate (runs(n*size(cases)))
      call given%progress%begin("measured runs", parts=2*size(cases))
      do i = 1, size(cases)
         call given%progress%begin_part(2*i - 1)
         last = n*i
         runs(last - n + 1:last) = settings%runs()
         do j = 1, n
            call measure_run(cases(i), 0.0_wp, settings%most_steps, runs(last - n + j))
            call given%progress%advance(j, n)
         end do
         call given%progress%begin_part(2*i)
         call time_runs(cases(i), settings%most_steps, settings%repeats, settings%least_seconds, &
                        runs(last - n + 1:last), given%progress)
      end do
      call put_runs(data, cases, runs)
   end subroutine run_measure

   !> Read and check cases and settings.
   subroutine read_measure(given, measured, measure, error)
      class(request_type), intent(inout) :: given
      type(case_type), allocatable, intent(out) :: measured(:)
      type(measure_settings_type), intent(out) :: measure
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(case_settings_type), allocatable :: cases(:)
      namelist /settings/ cases, measure

      allocate (cases(most_cases))
      call given%make_room(lines_of_case*most_cases)
      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      ! gfortran cannot write a namelist with an array of no elements that have derived types
      cases = cases(:max(1, count(cases%name /= "")))
      write (given%copy, nml=settings, delim="quote")
      call given%check(error)
      call open_cases(given, cases, measured, error)
      call check_count(error, given%place, "repeats", measure%repeats, at_least=0)
   end subroutine read_measure

   !> Each method at each of its tolerances or lengths of steps.
   pure function runs_of_methods(self) result(runs)
      class(measure_settings_type), intent(in) :: self
      type(run_type), allocatable :: runs(:)
      real(wp), allocatable :: settings(:)
      integer :: i, j

      allocate (runs(0))
      do i = 1, count(self%methods /= "")
         settings = elements(self%tolerances)
         if (any(baseline_methods == self%methods(i))) settings = elements(self%steps)
         runs = [runs, [(run_type(self%methods(i), settings(j)), j=1, size(settings))]]
      end do
   end function runs_of_methods

   !> All runs of all cases, which have one model; a case with fewer samples than another is
   !> filled up with NaN.
   subroutine put_runs(data, cases, runs)
      class(results_type), intent(inout) :: data
      type(case_type), intent(in) :: cases(:)
      !> Runs of the cases, of each as many
      type(run_type), intent(in) :: runs(:)
      real(wp), allocatable :: table(:, :)
      character(len=reason_length) :: reasons(size(runs))
      integer :: i, j, most_samples, of(size(runs)), run, sample
      character(len=:), allocatable :: name
      type(description_type) :: about

      do i = 1, size(runs)
         of(i) = 1 + (i - 1)/(size(runs)/size(cases))
         reasons(i) = runs(i)%reason
      end do
      most_samples = maxval([(size(runs(i)%samples, 2), i=1, size(runs))])

      call data%attribute("title", "Measured runs of a model")
      run = data%dimension("run", size(runs), coordinates="case method setting")
      sample = data%dimension("sample", most_samples, coordinates="time")
      call data%words(run, "case", cases(of)%name, "name of the case")
      call data%words(run, "method", runs%method, "method")
      call data%words(run, "status", runs%status, "ok, or why the run ended before t_end")
      call data%words(run, "reason", reasons, "the same in the solver's words")
      call data%column(run, "setting", runs%setting, &
                       "tolerance, or length of the steps of rk4 methods")
      call data%words(run, "model", [(model_name(cases(of(i))), i=1, size(runs))], &
                      "name of the model")
      associate (model => cases(1)%model, history => cases(1)%history)
         about = model%describe()
         call data%attribute("model_kind", trim(about%kind))
         call data%attribute("parameters", joined(model%names))
         call put_places(data, run, model, [(cases(of(i))%model%numbers, i=1, size(runs))])
         do j = 1, size(history%names)
            call data%column(run, "history_"//trim(history%names(j)), &
                             [(cases(of(i))%history%values(j, 1, 1), i=1, size(runs))], &
                             trim(history%names(j))//" for t <= 0")
         end do
      end associate
      call data%column(run, "t_end", cases(of)%t_end, "last time asked for")
      call data%column(run, "t_reached", runs%outcome%t, "last time reached")
      call data%column(run, "steps_accepted", real(runs%outcome%accepted, wp), "steps accepted")
      call data%column(run, "steps_rejected", real(runs%outcome%rejected, wp), "steps rejected")
      call data%column(run, "steps_implicit", real(runs%outcome%implicit_steps, wp), &
                       "implicit steps accepted")
      call data%column(run, "evaluations", real(runs%outcome%evaluations, wp), &
                       "right-hand sides evaluated")
      call data%column(run, "factorisations", real(runs%outcome%factorisations, wp), &
                       "matrices factorised")
      call data%column(run, "switches", real(runs%outcome%switches, wp), "changes of method")
      name = shown_name(cases(1)%model, cases(1)%model%sizes%observed%component)
      call data%attribute("signal", name)
      call data%column(run, "least_"//name, runs%least, &
                       "smallest "//name//" on a grid 8 times that of samples")
      call data%column(run, "most_"//name, runs%most, &
                       "largest "//name//" on a grid 8 times that of samples")
      call data%column(run, "seconds", runs%seconds, &
                       "CPU time of the solver alone, median of repeats", "s")

      allocate (table(most_samples, size(runs)))
      table = ieee_value(1.0_wp, ieee_quiet_nan)
      do i = 1, size(runs)
         table(:size(runs(i)%samples, 2), i) = cases(of(i))%sample_times()
      end do
      call data%table([sample, run], "time", table, "time of the sample")
      do j = 1, size(runs(1)%samples, 1)
         do i = 1, size(runs)
            table(:size(runs(i)%samples, 2), i) = runs(i)%samples(j, :)
         end do
         name = shown_name(cases(1)%model, j)
         call data%table([sample, run], name, table, name//" of the sample")
      end do

   contains

      !> Name of the model of a case.
      function model_name(case) result(word)
         type(case_type), intent(in) :: case
         character(len=model_length) :: word
         type(description_type) :: about

         about = case%model%describe()
         word = about%name
      end function model_name
   end subroutine put_runs
end module measure_command
