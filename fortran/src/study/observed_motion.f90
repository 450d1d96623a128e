!> What is kept of a block in motion: samples, maxima of v that stand out, and the section v = 1, v
!> rising (where u is least), with points (theta, u).
module observed_motion
   use dde, only: continuation_type, dde_problem_type, event_table, integrate, &
                  integration_options, integration_result, sampler_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use lyapunov_spectrum, only: interval_observer_type
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u, spring_block_type
   implicit none (type, external)
   private
   public :: observed_motion_type

   !> Numbers of the event functions.
   enum, bind(c)
      enumerator :: section = 1, maximum, minimum
   end enum

   !> ln v rises by this much at least from a minimum to a maximum. Where v of a stuck block hardly
   !> changes, errors within the tolerance make smaller ones.
   real(wp), parameter :: least_rise = 1.0e-3_wp

   !> Samples that there is room for at first.
   integer, parameter :: first_rows = 1024

   !> Samples at even times.
   type, extends(sampler_type) :: even_sampler_type
      !> When sampling began, and the time between samples
      real(wp) :: begun = 0.0_wp, interval = 0.0_wp
      !> Samples, shape (wanted, >= received)
      real(wp), allocatable :: rows(:, :)
      !> Number of samples received, and how many of them are kept
      integer :: received = 0, kept = 0
   contains
      procedure :: take
   end type even_sampler_type

   !> A motion as far as it was observed.
   type, extends(interval_observer_type) :: observed_motion_type
      !> Time between samples
      real(wp) :: sample_interval = 0.0_wp
      !> Maxima of v
      real(wp), allocatable :: maxima(:)
      !> Points (theta, u) of the section, shape (2, points)
      real(wp), allocatable :: section(:, :)
      !> Times of these points, shape (points)
      real(wp), allocatable :: section_time(:)
      !> Least ln v since the last maximum
      real(wp), private :: lowest = huge(1.0_wp)
      !> Samples of theta, u and ln v
      type(even_sampler_type), private :: sampler
      !> Events since the motion arrived somewhere, and how many of them are kept
      type(event_table), private :: events
      integer, private :: events_kept = 0
      !> Where the motion is; empty at its beginning
      type(continuation_type) :: continuation
   contains
      procedure :: clear, forget_path, observe, observe_interval, keep_interval, arrive, samples, &
         scale
   end type observed_motion_type

contains

   !> Forget the observations, not where the motion is.
   pure subroutine clear(self)
      class(observed_motion_type), intent(inout) :: self
      type(even_sampler_type) :: empty
      real(wp) :: nothing(0)

      self%sampler = empty
      self%sampler%wanted = [index_of_theta, index_of_u, index_of_ln_v]
      self%sampler%interval = self%sample_interval
      allocate (self%sampler%rows(size(self%sampler%wanted), first_rows))
      self%section = reshape(nothing, [2, 0])
      self%section_time = nothing
      self%maxima = nothing
      call await_events(self)
   end subroutine clear

   !> Forget the samples and where the motion is: of many motions they would fill the memory.
   pure subroutine forget_path(self)
      class(observed_motion_type), intent(inout) :: self
      type(even_sampler_type) :: empty
      type(event_table) :: unused

      self%sampler = empty
      self%events = unused
      self%continuation = continuation_type()
   end subroutine forget_path

   !> Observe on for a time.
   subroutine observe(self, block_model, time, options, error)
      class(observed_motion_type), intent(inout) :: self
      type(spring_block_type), intent(in) :: block_model
      real(wp), intent(in) :: time
      type(integration_options), intent(in) :: options
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: now
      type(integration_result) :: outcome

      now = self%continuation
      call self%observe_interval(block_model, now%time(1) + time, options, outcome, error, now)
      if (allocated(error)) return
      call self%keep_interval()
      call self%arrive(now)
   end subroutine observe

   !> Observe a run of the block up to `time`, with or without tangent vectors.
   subroutine observe_interval(self, problem, time, options, outcome, error, continuation)
      class(observed_motion_type), intent(inout) :: self
      !> The block, maybe with tangent vectors
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: time
      type(integration_options), intent(in) :: options
      type(integration_result), intent(out) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type), intent(inout) :: continuation

      self%events%received = self%events_kept
      associate (sampler => self%sampler)
         if (sampler%kept == 0) sampler%begun = continuation%time(1)
         sampler%received = sampler%kept
         sampler%next = sampler%begun + (sampler%kept + 1)*sampler%interval
      end associate
      call integrate(problem, continuation%time(1), time, options, outcome, error, &
                     sampler=self%sampler, watcher=self%events, continuation=continuation)
   end subroutine observe_interval

   !> Keep the observations of the last interval.
   subroutine keep_interval(self)
      class(observed_motion_type), intent(inout) :: self

      self%sampler%kept = self%sampler%received
      self%events_kept = self%events%received
   end subroutine keep_interval

   !> The motion is here: take over the maxima and the section of what was kept.
   subroutine arrive(self, continuation)
      class(observed_motion_type), intent(inout) :: self
      type(continuation_type), intent(in) :: continuation

      self%continuation = continuation
      if (self%events%received > 0) call take_over(self)
      call await_events(self)
   end subroutine arrive

   !> Wait for new events.
   pure subroutine await_events(self)
      class(observed_motion_type), intent(inout) :: self
      integer :: i

      self%events = event_table([(index_of_ln_v, i=section, minimum)], &
                                level=[(0.0_wp, i=section, minimum)], direction=[1, -1, 1], &
                                of_slope=[.false., .true., .true.])
      self%events_kept = 0
   end subroutine await_events

   !> One of theta, u and ln v at even times.
   pure function samples(self, component) result(values)
      class(observed_motion_type), intent(in) :: self
      !> `index_of_theta`, `index_of_u` or `index_of_ln_v`
      integer, intent(in) :: component
      real(wp) :: values(self%sampler%kept)

      values = self%sampler%rows(component, :self%sampler%kept)
   end function samples

   !> Keep a sample, and wait for the next one.
   subroutine take(self, y)
      class(even_sampler_type), intent(inout) :: self
      !> Values of the wanted components
      real(wp), intent(in) :: y(:)

      if (self%received == size(self%rows, 2)) then
         self%rows = reshape(self%rows, [size(y), 2*self%received], pad=[0.0_wp])
      end if
      self%received = self%received + 1
      self%rows(:, self%received) = y
      self%next = self%begun + (self%received + 1)*self%interval
   end subroutine take

   !> Take over maxima of v and points of the section.
   pure subroutine take_over(self)
      class(observed_motion_type), intent(inout) :: self
      logical :: kept(self%events%received)
      integer :: i

      associate (events => self%events)
         do i = 1, events%received
            associate (ln_v => events%y(index_of_ln_v, i))
               kept(i) = events%which(i) == maximum .and. ln_v - self%lowest >= least_rise
               if (kept(i)) self%lowest = huge(1.0_wp)
               if (events%which(i) == minimum) self%lowest = min(self%lowest, ln_v)
            end associate
         end do
         associate (rows => [(i, i=1, events%received)])
            self%maxima = [self%maxima, exp(events%y(index_of_ln_v, pack(rows, kept)))]
            associate (passages => pack(rows, events%which(:events%received) == section))
               self%section = reshape([self%section, &
                                       events%y([index_of_theta, index_of_u], passages)], &
                                      [2, size(self%section, 2) + size(passages)])
               self%section_time = [self%section_time, events%time(passages)%hi]
            end associate
         end associate
      end associate
   end subroutine take_over

   !> Standard deviations of theta and u, over all samples.
   pure function scale(self) result(deviations)
      class(observed_motion_type), intent(in) :: self
      real(wp) :: deviations(2)
      integer, parameter :: component(2) = [index_of_theta, index_of_u]
      integer :: i

      do i = 1, 2
         associate (values => self%samples(component(i)))
            associate (n => max(1, size(values)))
               deviations(i) = max(norm2(values - sum(values)/n)/sqrt(real(n, wp)), &
                                   tiny(1.0_wp))
            end associate
         end associate
      end do
   end function scale
end module observed_motion
