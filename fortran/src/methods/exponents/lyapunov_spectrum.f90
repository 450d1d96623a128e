! SPDX-License-Identifier: BSD-3-Clause
!> The leading Lyapunov exponents of a delayed problem: tangent vectors are integrated beside the
!> solution by the same solver, interval by interval, and made orthonormal in the space of histories
!> in between (Benettin et al. 1980, Meccanica 15, 9; Farmer 1982, Physica D 4, 366).
module lyapunov_spectrum
   use dde, only: continuation_type, dde_problem_type, integrate, integration_options, &
                  integration_result
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: int64, wp
   use progress_receiver, only: progress_receiver_type
   use tangent_problem, only: tangent_problem_type
   use tangent_vectors, only: orthonormalise, start_vectors
   implicit none (type, external)
   private
   public :: expect_smooth, extend_growth, growth_settings_type, growth_type, &
             interval_observer_type, measure_growth

   !> Norm of the vectors after orthonormalisation. They need fewer digits than the solution: the
   !> absolute tolerance over this is their relative one.
   real(wp), parameter :: vector_size = 0.01_wp
   !> A part smaller than this number of tolerances of the vector it is taken from is noise.
   real(wp), parameter :: noise = 10.0_wp
   !> How often an interval in which a vector is lost to noise is halved before what is left of the
   !> vector gives a bound. Without bounds it is halved until it takes one step, or so often.
   integer, parameter :: most_halvings = 10, most_without_bounds = 40

   !> What growth is measured over.
   type :: growth_settings_type
      !> Number of exponents
      integer :: exponents = 0
      !> Time at which measuring begins
      real(wp) :: t_begin = 0.0_wp
      !> Time at which it ends
      real(wp) :: t_end = 0.0_wp
      !> Time before the beginning in which the vectors turn to the directions of growth
      real(wp) :: t_turning = 0.0_wp
      !> Longest mean time between two orthonormalisations
      real(wp) :: interval = 0.0_wp
      !> The number of intervals is a multiple of this
      integer :: batches = 2
      !> Whether a vector lost to noise gives a bound: what is left of it, noise and all, is its
      !> growth, and it goes on from there. Otherwise that is an error.
      logical :: bounds = .false.
      !> Whether one of the exponents is that of the flow, which is 0 where the problem does not
      !> depend on time and the motion comes to no rest. It needs no vector: the others are then
      !> orthogonal to the flow.
      logical :: across_flow = .false.
   contains
      !> Number of vectors
      procedure :: vectors => number_of_vectors
   end type growth_settings_type

   !> What was measured.
   type :: growth_type
      !> Time at which measuring began: t_begin, or later where the delays reach further back
      real(wp) :: t_begin = 0.0_wp
      !> Mean time between two orthonormalisations
      real(wp) :: interval = 0.0_wp
      !> Logarithm of the growth of each vector in each interval, shape (vectors, intervals)
      real(wp), allocatable :: growth(:, :)
      !> Length of each interval, shape (intervals)
      real(wp), allocatable :: length(:)
      !> Least share of a vector that was orthogonal to those before it
      real(wp) :: least_share = 1.0_wp
      !> Right-hand sides evaluated, with their variational equations
      integer(int64) :: evaluations = 0
      !> Time passed with the vectors
      real(wp) :: time = 0.0_wp
      !> Steps accepted on the way, and how many of them were implicit
      integer(int64) :: steps = 0, implicit_steps = 0
      !> Where solution and vectors are
      type(continuation_type) :: continuation
   end type growth_type

   !> Receiver of a solution beside which vectors are integrated, interval by interval. An interval
   !> counts once it is kept; one that is not is repeated in shorter ones.
   type, abstract :: interval_observer_type
   contains
      !> Integrate an interval and observe it
      procedure(observe_interval), deferred :: observe_interval
      !> Keep the observations of the last interval
      procedure(keep_interval), deferred :: keep_interval
   end type interval_observer_type

   abstract interface
      !> Integrate on up to `time` and observe. Intervals before that are not kept are forgotten.
      subroutine observe_interval(self, problem, time, options, outcome, error, continuation)
         import :: continuation_type, dde_problem_type, error_type, integration_options, &
                   integration_result, interval_observer_type, wp
         implicit none (type, external)
         class(interval_observer_type), intent(inout) :: self
         !> The problem, which may have further components after those observed
         class(dde_problem_type), intent(in) :: problem
         !> Time at which the interval ends
         real(wp), intent(in) :: time
         type(integration_options), intent(in) :: options
         type(integration_result), intent(out) :: outcome
         type(error_type), allocatable, intent(out) :: error
         type(continuation_type), intent(inout) :: continuation
      end subroutine observe_interval

      !> Keep the observations of the last interval.
      subroutine keep_interval(self)
         import :: interval_observer_type
         implicit none (type, external)
         class(interval_observer_type), intent(inout) :: self
      end subroutine keep_interval
   end interface

contains

   !> Number of vectors: that of exponents, less that of the flow.
   pure integer function number_of_vectors(self) result(vectors)
      class(growth_settings_type), intent(in) :: self

      vectors = self%exponents - merge(1, 0, self%across_flow)
   end function number_of_vectors

   !> Growth of tangent vectors along a solution that begins at t = 0, or goes on from where an
   !> earlier run ended: then the vectors begin there, or where the delays are over, and turn before
   !> measuring begins.
   subroutine measure_growth(problem, settings, options, measured, error, undisturbed, progress, &
                             observer)
      !> The problem, which must give its derivatives
      class(dde_problem_type), intent(in) :: problem
      !> How many exponents, and when
      type(growth_settings_type), intent(in) :: settings
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> The growth
      type(growth_type), intent(out) :: measured
      !> Error if the growth cannot be measured
      type(error_type), allocatable, intent(out) :: error
      !> Where an earlier run of the problem ended
      type(continuation_type), intent(in), optional :: undisturbed
      !> Receiver of the number of intervals done
      class(progress_receiver_type), intent(inout), optional :: progress
      !> Receiver of the solution, from the beginning of the vectors on
      class(interval_observer_type), intent(inout), optional :: observer
      type(continuation_type) :: approach
      type(integration_result) :: outcome
      type(tangent_problem_type) :: tangent
      real(wp) :: begun, growth(settings%vectors()), norm(settings%vectors()), share, start
      integer :: i, intervals, turning

      call expect_smooth(problem, error)
      if (.not. allocated(error)) call check(problem, settings, error)
      if (allocated(error)) return
      begun = 0.0_wp
      start = max(settings%interval, settings%t_begin - settings%t_turning)
      if (present(undisturbed)) then
         approach = undisturbed
         begun = approach%time(1)
         start = begun
      end if
      ! before that the vectors would have no whole past
      if (size(problem%lag) > 0) start = max(start, maxval(problem%lag))
      measured%t_begin = max(start, settings%t_begin)
      if (present(undisturbed)) measured%t_begin = start + settings%t_turning
      if (.not. measured%t_begin < settings%t_end) then
         call raise(error, "exponents: t_end = "//text(settings%t_end)//"; expected > " &
                    //text(measured%t_begin)//", where the vectors begin")
         return
      end if

      ! at the least this gives the slope, which a run with other vectors leaves out
      call integrate(problem, begun, start, options, outcome, error, continuation=approach)
      if (allocated(error)) return
      tangent = tangent_problem_type(problem, settings%vectors())
      call start_vectors(tangent, approach, measured%continuation)
      call orthonormalise(tangent, vector_size, settings%across_flow, &
                          measured%continuation, norm, share, options)
      ! no solution of the variational equations yet: a kink
      measured%continuation%rate = [approach%rate, (0.0_wp, i=1, tangent%n - problem%n)]
      ! as many in each batch
      associate (batches => settings%batches, time => settings%t_end - measured%t_begin)
         intervals = batches*max(1, ceiling(time/(batches*settings%interval)*(1.0_wp - 1.0e-12_wp)))
      end associate
      turning = ceiling((measured%t_begin - start)/settings%interval)
      do i = 1, turning
         call pass(tangent, settings, options, start + (measured%t_begin - start)*i/turning, &
                   most_halvings, measured, growth, error, observer)
         if (allocated(error)) return
         if (present(progress)) call progress%advance(i, turning + intervals)
      end do
      allocate (measured%growth(settings%vectors(), 0), measured%length(0))
      call go_on(tangent, settings, options, settings%t_end, intervals, turning, measured, &
                 error, progress, observer)
   end subroutine measure_growth

   !> Go on measuring from where it ended, for as long again and in intervals as long, so that all
   !> of them count alike.
   subroutine extend_growth(problem, settings, options, measured, error, observer)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> How many exponents
      type(growth_settings_type), intent(in) :: settings
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> The growth
      type(growth_type), intent(inout) :: measured
      !> Error if the growth cannot be measured
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of the solution
      class(interval_observer_type), intent(inout), optional :: observer

      associate (intervals => size(measured%growth, 2), start => measured%continuation%time(1))
         call go_on(tangent_problem_type(problem, settings%vectors()), settings, options, &
                    start + intervals*measured%interval, intervals, 0, measured, error, &
                    observer=observer)
      end associate
   end subroutine extend_growth

   !> Measure interval by interval. Intervals are of uneven length, so that a period of the motion
   !> that is nearly a multiple of them does not look like a slow drift.
   subroutine go_on(tangent, settings, options, t_end, intervals, done, measured, error, &
                    progress, observer)
      type(tangent_problem_type), intent(in) :: tangent
      type(growth_settings_type), intent(in) :: settings
      type(integration_options), intent(in) :: options
      real(wp), intent(in) :: t_end
      integer, intent(in) :: intervals, done
      type(growth_type), intent(inout) :: measured
      type(error_type), allocatable, intent(out) :: error
      class(progress_receiver_type), intent(inout), optional :: progress
      class(interval_observer_type), intent(inout), optional :: observer
      real(wp), allocatable :: growth(:, :), time(:)
      integer :: i

      measured%interval = (t_end - measured%continuation%time(1))/intervals
      allocate (time(0:intervals), growth(settings%vectors(), intervals))
      time(:) = [(t_end - (intervals - i - uneven(i))*measured%interval, i=0, intervals)]
      time(0) = measured%continuation%time(1)
      time(intervals) = t_end
      do i = 1, intervals
         call pass(tangent, settings, options, time(i), most_halvings, measured, growth(:, i), &
                   error, observer)
         if (allocated(error)) return
         if (present(progress)) call progress%advance(done + i, done + intervals)
      end do
      measured%growth = reshape([measured%growth, growth], &
                                [settings%vectors(), size(measured%growth, 2) + intervals])
      measured%length = [measured%length, time(1:) - time(:intervals - 1)]
   end subroutine go_on

   !> An irregular number between -0.35 and 0.35: a fraction of the golden ratio times a square.
   elemental real(wp) function uneven(i) result(value)
      integer, intent(in) :: i
      real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp)

      value = 0.7_wp*(modulo(golden*real(i, wp)**2, 1.0_wp) - 0.5_wp)
   end function uneven

   !> Go on up to `time`: in one interval, or in two halves where a vector becomes a combination of
   !> the others on the way.
   recursive subroutine pass(tangent, settings, options, time, halvings, measured, growth, error, &
                             observer)
      type(tangent_problem_type), intent(in) :: tangent
      type(growth_settings_type), intent(in) :: settings
      type(integration_options), intent(in) :: options
      real(wp), intent(in) :: time
      integer, intent(in) :: halvings
      type(growth_type), intent(inout) :: measured
      real(wp), intent(out) :: growth(:)
      type(error_type), allocatable, intent(out) :: error
      class(interval_observer_type), intent(inout), optional :: observer
      type(continuation_type) :: before
      type(integration_options) :: all
      type(integration_result) :: outcome
      real(wp) :: first_half(size(growth)), lost, norm(size(growth)), share
      real(wp), allocatable :: slope(:)
      integer :: j

      growth = 0.0_wp
      all = options
      if (allocated(options%each_absolute)) then
         ! components of vectors are of sizes in the ratio of those of the state
         associate (a => options%each_absolute)
            all%each_absolute = [a, (options%relative*a/maxval(a), j=1, tangent%vectors)]
         end associate
      end if
      lost = noise*max(options%relative, epsilon(1.0_wp))/vector_size
      before = measured%continuation
      if (present(observer)) then
         call observer%observe_interval(tangent, time, all, outcome, error, measured%continuation)
      else
         call integrate(tangent, before%time(1), time, all, outcome, error, &
                        continuation=measured%continuation)
      end if
      if (allocated(error)) return
      measured%evaluations = measured%evaluations + outcome%evaluations
      measured%time = measured%time + (time - before%time(1))
      measured%steps = measured%steps + outcome%accepted
      measured%implicit_steps = measured%implicit_steps + outcome%implicit_steps
      slope = measured%continuation%slope
      call orthonormalise(tangent, vector_size, settings%across_flow, &
                          measured%continuation, norm, share, options)
      if (share > lost) then
         measured%least_share = min(measured%least_share, share)
         growth = log(norm/vector_size)
         if (present(observer)) call observer%keep_interval()
      else if (halvings == 0 .and. settings%bounds) then
         growth = log(max(norm, tiny(1.0_wp))/vector_size)
         ! noise need not be orthogonal to the others, nor of this size
         measured%continuation%slope = slope
         call orthonormalise(tangent, vector_size, settings%across_flow, &
                             measured%continuation, norm, share, options)
         if (present(observer)) call observer%keep_interval()
      else if (.not. settings%bounds .and. (outcome%accepted <= 1 .or. &
                                            halvings <= most_halvings - most_without_bounds)) then
         ! lost within a step, or a jump
         call raise(error, "exponents: at t = "//text(time)//" a share of "//text(share) &
                    //" is left of a tangent vector without those before it; expected > " &
                    //text(lost)//" (ask for fewer exponents or a smaller " &
                    //"tolerance)")
      else
         measured%continuation = before
         call pass(tangent, settings, options, 0.5_wp*(before%time(1) + time), halvings - 1, &
                   measured, first_half, error, observer)
         if (allocated(error)) return
         call pass(tangent, settings, options, time, halvings - 1, measured, growth, error, &
                   observer)
         growth = first_half + growth
      end if
   end subroutine pass

   !> Refuse a problem that is not smooth, or whose delays move.
   subroutine expect_smooth(problem, error)
      class(dde_problem_type), intent(in) :: problem
      type(error_type), allocatable, intent(out) :: error

      if (problem%moving > 0) then
         call raise(error, "exponents: delays depend on t or the states; expected constant ones")
         return
      end if
      if (problem%switches == 0) return
      call raise(error, "exponents: the model is not smooth at "//problem%name_of("switching", 1) &
                 //"; expected a smooth one, since disturbances jump there")
   end subroutine expect_smooth

   !> Refuse what cannot be measured.
   pure subroutine check(problem, settings, error)
      class(dde_problem_type), intent(in) :: problem
      type(growth_settings_type), intent(in) :: settings
      type(error_type), allocatable, intent(out) :: error

      if (settings%vectors() < 1) then
         call raise(error, "exponents: "//text(settings%exponents)//" asked for; at least " &
                    //text(settings%exponents - settings%vectors() + 1)//" expected")
      else if (size(problem%lag) == 0 .and. settings%exponents > problem%n) then
         call raise(error, "exponents: "//text(settings%exponents)//" asked for of " &
                    //text(problem%n)//" equations without delay; at most "//text(problem%n) &
                    //" expected")
      else if (settings%batches < 2) then
         call raise(error, "exponents: "//text(settings%batches)//" batches; at least 2 expected")
      else if (.not. settings%interval > 0.0_wp) then
         call raise(error, "exponents: interval = "//text(settings%interval)//"; > 0 expected")
      end if
   end subroutine check
end module lyapunov_spectrum
