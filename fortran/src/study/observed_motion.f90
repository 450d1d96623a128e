!> What is kept of a block in motion: samples, maxima of v that stand out, and the section v = 1, v
!> rising (where u is least), with points (theta, u).
module observed_motion
   use dde, only: continuation_type, event_table, integrate, integration_options, &
                  integration_result, table_sampler
   use dde_errors, only: error_type
   use dde_kinds, only: wp
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

   !> A motion as far as it was observed.
   type :: observed_motion_type
      !> theta, u and ln v at even times, shape (3, samples)
      real(wp), allocatable :: samples(:, :)
      !> Maxima of v
      real(wp), allocatable :: maxima(:)
      !> Points (theta, u) of the section, shape (2, points)
      real(wp), allocatable :: section(:, :)
      !> When it was at each, shape (points)
      real(wp), allocatable :: section_time(:)
      !> Least ln v since the last maximum
      real(wp), private :: lowest = huge(1.0_wp)
      !> Where the motion is; empty at its beginning
      type(continuation_type) :: continuation
   contains
      !> Forget what was seen
      procedure :: clear
      !> Forget the samples and where the motion is
      procedure :: forget_path
      !> Observe on
      procedure :: observe
      !> Standard deviations of theta and u
      procedure :: scale
   end type observed_motion_type

contains

   !> Forget what was seen, not where the motion is.
   pure subroutine clear(self)
      !> The motion
      class(observed_motion_type), intent(inout) :: self
      real(wp) :: nothing(0)

      self%samples = reshape(nothing, [3, 0])
      self%section = reshape(nothing, [2, 0])
      self%section_time = nothing
      self%maxima = nothing
   end subroutine clear

   !> Forget the samples and where the motion is: of many motions they would fill the memory.
   pure subroutine forget_path(self)
      !> The motion
      class(observed_motion_type), intent(inout) :: self

      deallocate (self%samples)
      self%continuation = continuation_type()
   end subroutine forget_path

   !> Observe on for a time.
   subroutine observe(self, block_model, time, interval, options, error)
      !> The motion
      class(observed_motion_type), intent(inout) :: self
      !> The block
      type(spring_block_type), intent(in) :: block_model
      !> How long
      real(wp), intent(in) :: time
      !> Time between samples
      real(wp), intent(in) :: interval
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> The run ended before its time
      type(error_type), allocatable, intent(out) :: error
      type(event_table) :: events
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      real(wp) :: start
      integer :: i

      start = self%continuation%time(1)
      events = event_table([(index_of_ln_v, i=section, minimum)], &
                           level=[(0.0_wp, i=section, minimum)], direction=[1, -1, 1], &
                           of_slope=[.false., .true., .true.])
      ! rounding may put the last one beyond the end, where there is none
      samples = table_sampler([index_of_theta, index_of_u, index_of_ln_v], &
                              [(min(start + i*interval, start + time), &
                                i=1, max(1, int(time/interval)))])
      call integrate(block_model, start, start + time, options, outcome, error, sampler=samples, &
                     watcher=events, continuation=self%continuation)
      if (allocated(error)) return
      self%samples = reshape([self%samples, samples%values], &
                             [3, size(self%samples, 2) + size(samples%values, 2)])
      if (events%received > 0) call keep_events(events, self)
   end subroutine observe

   !> Maxima of v and points of the section.
   pure subroutine keep_events(events, motion)
      !> Events met, one at least
      type(event_table), intent(in) :: events
      !> The motion
      type(observed_motion_type), intent(inout) :: motion
      logical :: kept(events%received)
      integer :: i

      do i = 1, events%received
         associate (ln_v => events%y(index_of_ln_v, i))
            kept(i) = events%which(i) == maximum .and. ln_v - motion%lowest >= least_rise
            if (kept(i)) motion%lowest = huge(1.0_wp)
            if (events%which(i) == minimum) motion%lowest = min(motion%lowest, ln_v)
         end associate
      end do
      associate (rows => [(i, i=1, events%received)])
         motion%maxima = [motion%maxima, exp(events%y(index_of_ln_v, pack(rows, kept)))]
         associate (passages => pack(rows, events%which(:events%received) == section))
            motion%section = reshape([motion%section, &
                                      events%y([index_of_theta, index_of_u], passages)], &
                                     [2, size(motion%section, 2) + size(passages)])
            motion%section_time = [motion%section_time, events%time(passages)%hi]
         end associate
      end associate
   end subroutine keep_events

   !> Standard deviations of theta and u, over all samples.
   pure function scale(self) result(deviations)
      !> The motion, observed
      class(observed_motion_type), intent(in) :: self
      real(wp) :: deviations(2)
      integer :: i

      associate (n => size(self%samples, 2))
         do i = 1, 2
            associate (values => self%samples(i, :))
               deviations(i) = max(norm2(values - sum(values)/n)/sqrt(real(n, wp)), &
                                   tiny(1.0_wp))
            end associate
         end do
      end associate
   end function scale
end module observed_motion
