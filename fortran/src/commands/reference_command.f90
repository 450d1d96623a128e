! SPDX-License-Identifier: BSD-3-Clause
!> Reference solutions of cases in quadruple precision, each with the evidence of its own
!> uncertainty and of how much the case magnifies a disturbance of its history.
module reference_command
   use cases_request, only: case_settings_type, lines_of_case, most_cases, open_cases
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use measured_case, only: case_type
   use measured_run, only: measure_run, run_type
   use model_history, only: shown_name
   use request, only: request_type, word_length
   use results, only: results_type
   use value_checks, only: check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: run_reference

   !> How each case is computed.
   type :: reference_settings_type
      !> Method and tolerance of the reference
      character(len=word_length) :: method = ""
      real(wp) :: tolerance = missing
      !> Method and larger tolerance of the run that it is checked by
      character(len=word_length) :: check_method = ""
      real(wp) :: check_tolerance = missing
      !> Change of the values before the initial time that measures the conditioning
      real(wp) :: disturbance = missing
      !> Most steps of a run
      integer(int64) :: most_steps = missing_count
   end type reference_settings_type

   !> How far other runs are from a sample of a reference.
   type :: deviation_type
      !> At a larger tolerance, and from a disturbed history in units of the disturbance
      real(wp) :: uncertainty, amplification
   end type deviation_type

contains

   !> Run the command.
   subroutine run_reference(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(case_type), allocatable :: cases(:)
      type(reference_settings_type) :: settings
      type(run_type) :: checking, disturbed
      type(run_type), allocatable :: best(:)
      type(deviation_type), allocatable :: deviations(:)
      integer :: i, j

      call read_reference(given, cases, settings, error)
      if (allocated(error)) return
      allocate (best(size(cases)), source=run_type(trim(settings%method), settings%tolerance))
      allocate (deviations(0))
      call given%progress%begin("references", parts=3*size(cases))
      do i = 1, size(cases)
         call given%progress%begin_part(3*i - 2)
         call measure_run(cases(i), 0.0_wp, settings%most_steps, best(i), given%progress)
         call given%progress%begin_part(3*i - 1)
         checking = run_type(trim(settings%check_method), settings%check_tolerance)
         call measure_run(cases(i), 0.0_wp, settings%most_steps, checking, given%progress)
         call given%progress%begin_part(3*i)
         disturbed = run_type(trim(settings%method), settings%tolerance)
         call measure_run(cases(i), settings%disturbance, settings%most_steps, disturbed, &
                          given%progress)
         associate (best => best(i)%samples)
            deviations = [deviations, &
                          [(deviation_type(distance(checking%samples(:, j), best(:, j)), &
                                           distance(disturbed%samples(:, j), best(:, j)) &
                                           /settings%disturbance), j=1, size(best, 2))]]
         end associate
      end do
      call put_references(data, cases, best, deviations)
   end subroutine run_reference

   !> Read and check cases and settings.
   subroutine read_reference(given, measured, reference, error)
      class(request_type), intent(inout) :: given
      type(case_type), allocatable, intent(out) :: measured(:)
      type(reference_settings_type), intent(out) :: reference
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(case_settings_type), allocatable :: cases(:)
      namelist /settings/ cases, reference

      allocate (cases(most_cases))
      call given%make_room(lines_of_case*most_cases)
      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      ! gfortran cannot write a namelist with an array of no elements that have derived types
      cases = cases(:max(1, count(cases%name /= "")))
      write (given%copy, nml=settings, delim="quote")
      call given%check(error)
      call open_cases(given, cases, measured, error)
      call check_number(error, given%place, "most_steps", real(reference%most_steps, wp), &
                        at_least=1.0_wp)
   end subroutine read_reference

   !> All cases at their sample times: the states, and how far other runs are from them.
   subroutine put_references(data, cases, best, deviations)
      class(results_type), intent(inout) :: data
      type(case_type), intent(in) :: cases(:)
      !> References of the cases
      type(run_type), intent(in) :: best(:)
      !> Of all samples of all cases
      type(deviation_type), intent(in) :: deviations(:)
      real(wp) :: samples(size(best(1)%samples, 1), size(deviations))
      integer :: i, j, of(size(deviations)), rows

      of = [((i, j=1, size(best(i)%samples, 2)), i=1, size(cases))]
      do i = 1, size(cases)
         samples(:, findloc(of, i, dim=1):findloc(of, i, dim=1, back=.true.)) = best(i)%samples
      end do
      rows = data%dimension("sample", size(of))
      call data%words(rows, "case", cases(of)%name, "name of the case")
      call data%words(rows, "status", best(of)%status, "ok, or why the run ended before t_end")
      call data%column(rows, "time", [(cases(i)%sample_times(), i=1, size(cases))], &
                       "time of the sample")
      do i = 1, size(samples, 1)
         call data%column(rows, shown_name(cases(1)%model, i), samples(i, :), "state")
      end do
      call data%column(rows, "uncertainty", deviations%uncertainty, &
                       "distance of the state at a larger tolerance", digits=3)
      call data%column(rows, "amplification", deviations%amplification, &
                       "distance of the state from a disturbed history over the disturbance", &
                       digits=3)
   end subroutine put_references

   !> Largest difference of a component, relative to the component where that is above 1.
   pure real(wp) function distance(state, from) result(value)
      real(wp), intent(in) :: state(:)
      real(wp), intent(in) :: from(:)

      value = maxval(abs(state - from)/max(1.0_wp, abs(from)))
   end function distance
end module reference_command
