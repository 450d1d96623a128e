! SPDX-License-Identifier: BSD-3-Clause
!> One measured run: a case by one method at one tolerance or step length, its results and its
!> cost.
module measured_run
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: integrate, integration_options, integration_result, out_of_memory, reached_end, &
                  sampler_type
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use fixed_step_rk4, only: integrate_rk4
   use measured_case, only: as_double, case_type
   use model_problem, only: model_type
   use progress_receiver, only: progress_receiver_type
   implicit none (type, external)
   private
   public :: baseline_methods, measure_run, run_type, time_runs

   !> Methods with steps of one length, which they take instead of a tolerance.
   character(len=10), parameter :: baseline_methods(2) = ["rk4_linear", "rk4_cubic "]

   !> Reasons of the solver, from `reached_end` on, in one word each.
   character(len=16), parameter :: status_names(reached_end:out_of_memory) = &
                                   [character(len=16) :: "ok", "refused", "refused", &
                                    "step_underflow", "too_many_steps", "value_not_finite", &
                                    "out_of_memory"]

   !> CPU seconds above which one run is measure enough.
   real(wp), parameter :: long_run = 0.5_wp

   !> A run to measure, and its results.
   type :: run_type
      !> Name of the method
      character(len=10) :: method = ""
      !> Tolerance, or length of the steps
      real(wp) :: setting = 0.0_wp
      !> 'ok' or the reason in one word
      character(len=16) :: status = ""
      !> The reason in the solver's own words; empty where it reached t_end
      character(len=:), allocatable :: reason
      !> What the solver did
      type(integration_result) :: outcome = integration_result()
      !> States, shape (n, times); not a number at times not reached
      real(wp), allocatable :: samples(:, :)
      !> Smallest and largest value of the component of the signal over a grid eight times as fine
      !> as the samples
      real(wp) :: least = 0.0_wp, most = 0.0_wp
      !> CPU seconds; with its samples where the run was not repeated
      real(wp) :: seconds = 0.0_wp
   end type run_type

   !> Looks at the state from one sample to the next.
   integer, parameter :: looks = 8

   !> Sampler that keeps every eighth state and the extremes of all.
   type, extends(sampler_type) :: extremes_sampler_type
      !> Times of samples, ascending from the initial time
      real(wp), allocatable :: time(:)
      !> Samples, shape (n, times); those not reached are what they were filled with
      real(wp), allocatable :: values(:, :)
      !> Number of samples received
      integer :: received = 0
      !> Component of the signal, its smallest and its largest value
      integer :: component = 1
      real(wp) :: least = huge(1.0_wp), most = -huge(1.0_wp)
      !> Receiver of the number of samples received, if any
      class(progress_receiver_type), pointer :: progress => null()
      !> Looks since the last sample
      integer, private :: looked = 0
   contains
      procedure :: take
   end type extremes_sampler_type

contains

   !> Run a case once, with samples.
   subroutine measure_run(case, disturbance, most_steps, run, progress)
      type(case_type), intent(in) :: case
      !> Change of the values before the initial time, relative where they are exponentials of
      !> states
      real(wp), intent(in) :: disturbance
      !> Most steps of the solver
      integer(int64), intent(in) :: most_steps
      !> Method and setting; filled with the rest
      type(run_type), intent(inout) :: run
      !> Receiver of the number of samples
      class(progress_receiver_type), intent(inout), target, optional :: progress
      type(error_type), allocatable :: error
      type(model_type) :: model
      type(extremes_sampler_type) :: sampler
      real(wp) :: no_number, now, start
      integer :: i

      no_number = ieee_value(1.0_wp, ieee_quiet_nan)
      model = case%problem(disturbance)
      sampler%component = model%sizes%observed%component
      sampler%wanted = [(i, i=1, model%n)]
      sampler%time = case%sample_times()
      sampler%next = sampler%time(1)
      allocate (sampler%values(model%n, size(sampler%time)), source=no_number)
      if (present(progress)) sampler%progress => progress
      call cpu_time(start)
      call solve(model, as_double(case%t_end), most_steps, run, error, sampler)
      call cpu_time(now)
      run%status = status_names(run%outcome%reason)
      run%reason = ""
      if (allocated(error)) run%reason = error%message
      run%samples = sampler%values
      run%least = merge(sampler%least, no_number, sampler%received > 0)
      run%most = merge(sampler%most, no_number, sampler%received > 0)
      run%seconds = now - start
   end subroutine measure_run

   !> CPU seconds of the runs of a case without samples, each the median of its repeats. The runs
   !> take turns, so that a machine that is busy for a while hits all alike. A long run, and one
   !> that did not reach the end, keeps the time of its first.
   subroutine time_runs(case, most_steps, repeats, least_seconds, runs, progress)
      type(case_type), intent(in) :: case
      !> Most steps of the solver
      integer(int64), intent(in) :: most_steps
      !> Turns; none if 0
      integer, intent(in) :: repeats
      !> Shortest time to measure: shorter runs are measured several in a row
      real(wp), intent(in) :: least_seconds
      !> The runs, each run once; their seconds are replaced
      type(run_type), intent(inout) :: runs(:)
      !> Receiver of the number of turns
      class(progress_receiver_type), intent(inout), optional :: progress
      logical :: timed(size(runs))
      real(wp) :: measured(repeats, size(runs))
      integer :: i, j

      if (repeats == 0) return
      timed = runs%seconds < long_run .and. runs%status == "ok"
      do i = 1, repeats
         do j = 1, size(runs)
            if (timed(j)) measured(i, j) = time_taken(case, most_steps, least_seconds, runs(j))
         end do
         if (present(progress)) call progress%advance(i, repeats)
      end do
      do j = 1, size(runs)
         if (timed(j)) runs(j)%seconds = median(measured(:, j))
      end do
   end subroutine time_runs

   !> Solve it by the run's method.
   subroutine solve(model, t_end, most_steps, run, error, sampler)
      type(model_type), intent(in) :: model
      real(wp), intent(in) :: t_end
      integer(int64), intent(in) :: most_steps
      !> Method and setting; filled with the outcome
      type(run_type), intent(inout) :: run
      type(error_type), allocatable, intent(out) :: error
      type(extremes_sampler_type), intent(inout), optional :: sampler

      if (any(baseline_methods == run%method)) then
         call integrate_rk4(model, t_end, run%setting, run%method == "rk4_cubic", &
                            run%outcome, error, sampler)
      else
         call integrate(model, 0.0_wp, t_end, &
                        integration_options(method=run%method(:8), relative=run%setting, &
                                            absolute=run%setting, most_steps=most_steps), &
                        run%outcome, error, sampler)
      end if
   end subroutine solve

   !> CPU seconds of one run: the mean of several in a row that fill the shortest time to measure.
   real(wp) function time_taken(case, most_steps, least_seconds, run) result(seconds)
      type(case_type), intent(in) :: case
      integer(int64), intent(in) :: most_steps
      real(wp), intent(in) :: least_seconds
      type(run_type), intent(in) :: run
      type(error_type), allocatable :: error
      type(run_type) :: again
      real(wp) :: start, now
      integer :: runs

      again = run
      call cpu_time(start)
      now = start
      runs = 0
      do while (runs == 0 .or. now - start < least_seconds)
         call solve(case%problem(0.0_wp), as_double(case%t_end), most_steps, again, error)
         runs = runs + 1
         call cpu_time(now)
      end do
      seconds = (now - start)/runs
   end function time_taken

   !> The middle one, or of an even number the mean of the two in the middle.
   pure real(wp) function median(values) result(value)
      real(wp), intent(in) :: values(:)
      real(wp) :: sorted(size(values))
      integer :: i, middle, place

      sorted = values
      do i = 1, size(sorted)
         place = i - 1 + minloc(sorted(i:), dim=1)
         sorted([i, place]) = sorted([place, i])
      end do
      middle = (size(sorted) + 1)/2
      value = 0.5_wp*(sorted(middle) + sorted(size(sorted) + 1 - middle))
   end function median

   !> Look at the state; keep it where a sample is due.
   subroutine take(self, y)
      class(extremes_sampler_type), intent(inout) :: self
      real(wp), intent(in) :: y(:)

      self%least = min(self%least, y(self%component))
      self%most = max(self%most, y(self%component))
      if (self%looked == 0) then
         self%received = self%received + 1
         self%values(:, self%received) = y
         if (associated(self%progress)) then
            call self%progress%advance(self%received, size(self%time))
         end if
      end if
      self%looked = modulo(self%looked + 1, looks)
      associate (last => self%received)
         if (last == size(self%time)) then
            self%next = huge(1.0_wp)
         else if (self%looked == 0) then
            self%next = self%time(last + 1)
         else
            self%next = self%time(last) + (self%time(last + 1) - self%time(last)) &
                        *self%looked/looks
         end if
      end associate
   end subroutine take
end module measured_run
