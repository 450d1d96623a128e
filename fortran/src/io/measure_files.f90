! SPDX-License-Identifier: BSD-3-Clause
!> What the program `measure` reads and writes: cases and what to measure; a row a run, with its
!> samples.
module measure_files
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use cases_input, only: case_settings_type, lines_of_case, most_cases, open_cases
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use measured_case, only: case_type
   use measured_run, only: baseline_methods, run_type
   use model_attributes, only: put_places
   use model_description, only: description_type, model_length => word_length
   use model_history, only: shown_name
   use namelist_input, only: element_length, elements, namelist_file_type
   use output_file, only: output_file_type
   use results, only: joined
   use value_checks, only: absent, check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: measure_settings_type, read_measure, write_measured_runs

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

   !> Read and check cases and settings.
   subroutine read_measure(path, measured, measure, error)
      character(len=*), intent(in) :: path
      type(case_type), allocatable, intent(out) :: measured(:)
      type(measure_settings_type), intent(out) :: measure
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(case_settings_type), allocatable :: cases(:)
      type(namelist_file_type) :: file
      namelist /settings/ cases, measure

      allocate (cases(most_cases))
      call file%open(path, lines_of_case*most_cases)
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      ! gfortran cannot write a namelist with an array of no elements that have derived types
      cases = cases(:max(1, count(cases%name /= "")))
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call open_cases(path, cases, measured, error)
      call check_count(error, path, "repeats", measure%repeats, at_least=0)
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

   !> Write all runs of all cases, which have one model; a case with fewer samples than another is
   !> filled up with NaN.
   subroutine write_measured_runs(path, cases, runs, error)
      character(len=*), intent(in) :: path
      type(case_type), intent(in) :: cases(:)
      !> Runs of the cases, of each as many
      type(run_type), intent(in) :: runs(:)
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      real(wp), allocatable :: table(:, :)
      character(len=reason_length) :: reasons(size(runs))
      integer :: i, j, most_samples, of(size(runs)), run, sample
      character(len=:), allocatable :: name

      do i = 1, size(runs)
         of(i) = 1 + (i - 1)/(size(runs)/size(cases))
         reasons(i) = runs(i)%reason
      end do
      most_samples = maxval([(size(runs(i)%samples, 2), i=1, size(runs))])

      call file%create(path, "Measured runs of a model")
      run = file%dimension("run", size(runs), coordinates="case method setting")
      sample = file%dimension("sample", most_samples, coordinates="time")
      call file%words(run, "case", cases(of)%name, "name of the case")
      call file%words(run, "method", runs%method, "method")
      call file%words(run, "status", runs%status, "ok, or why the run ended before t_end")
      call file%words(run, "reason", reasons, "the same in the solver's words")
      call file%column(run, "setting", runs%setting, &
                       "tolerance, or length of the steps of rk4 methods")
      call file%words(run, "model", [(model_name(cases(of(i))), i=1, size(runs))], &
                      "name of the model")
      associate (model => cases(1)%model, history => cases(1)%history)
         call file%attribute("parameters", joined(model%names))
         call put_places(file, run, model, [(cases(of(i))%model%numbers, i=1, size(runs))])
         do j = 1, size(history%names)
            call file%column(run, "history_"//trim(history%names(j)), &
                             [(cases(of(i))%history%values(j, 1, 1), i=1, size(runs))], &
                             trim(history%names(j))//" for t <= 0")
         end do
      end associate
      call file%column(run, "t_end", cases(of)%t_end, "last time asked for")
      call file%column(run, "t_reached", runs%outcome%t, "last time reached")
      call file%column(run, "steps_accepted", real(runs%outcome%accepted, wp), "steps accepted")
      call file%column(run, "steps_rejected", real(runs%outcome%rejected, wp), "steps rejected")
      call file%column(run, "steps_implicit", real(runs%outcome%implicit_steps, wp), &
                       "implicit steps accepted")
      call file%column(run, "evaluations", real(runs%outcome%evaluations, wp), &
                       "right-hand sides evaluated")
      call file%column(run, "factorisations", real(runs%outcome%factorisations, wp), &
                       "matrices factorised")
      call file%column(run, "switches", real(runs%outcome%switches, wp), "changes of method")
      name = shown_name(cases(1)%model, cases(1)%model%sizes%observed%component)
      call file%attribute("signal", name)
      call file%column(run, "least_"//name, runs%least, &
                       "smallest "//name//" on a grid 8 times that of samples")
      call file%column(run, "most_"//name, runs%most, &
                       "largest "//name//" on a grid 8 times that of samples")
      call file%column(run, "seconds", runs%seconds, &
                       "CPU time of the solver alone, median of repeats", "s")

      allocate (table(most_samples, size(runs)))
      table = ieee_value(1.0_wp, ieee_quiet_nan)
      do i = 1, size(runs)
         table(:size(runs(i)%samples, 2), i) = cases(of(i))%sample_times()
      end do
      call file%table([sample, run], "time", table, "time of the sample")
      do j = 1, size(runs(1)%samples, 1)
         do i = 1, size(runs)
            table(:size(runs(i)%samples, 2), i) = runs(i)%samples(j, :)
         end do
         name = shown_name(cases(1)%model, j)
         call file%table([sample, run], name, table, name//" of the sample")
      end do
      call file%finish(error)

   contains

      !> Name of the model of a case.
      function model_name(case) result(word)
         type(case_type), intent(in) :: case
         character(len=model_length) :: word
         type(description_type) :: about

         about = case%model%describe()
         word = about%name
      end function model_name
   end subroutine write_measured_runs
end module measure_files
