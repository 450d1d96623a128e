! SPDX-License-Identifier: BSD-3-Clause
!> The attractor that a model reaches from one history, and its class.
!>
!> The approach ends when the motion is at rest or on a cycle, at the latest after a stated time.
!> Then the motion is observed and its exponents are measured, for longer and longer times, until
!> the class is certain or a limit is reached.
module attractors
   use attractor_verdict, only: attractor_settings_type, attractor_type, is_at_rest, judge, &
                                on_cycle, settle
   use dde, only: continuation_type, integrate, integration_options, integration_result
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use exponent_averages, only: exponent_type, without_sign
   use lyapunov_spectrum, only: expect_smooth, extend_growth, growth_settings_type, growth_type, &
                                measure_growth
   use model_levels, only: rest_level
   use model_problem, only: model_type
   use motion_classes, only: chaos, contradicted, cycle_motion, fixed_point, leaves_cycle, &
                             not_stationary, three_torus, torus, undecided, unstable_rest
   use motion_path, only: follow_path
   use observed_motion, only: observed_motion_type
   use natural_units, only: in_own_units
   use rest, only: exponents_at_rest, faster, settles, trend_of
   use section_motion, only: drifts
   use tangent_vectors, only: undisturbed_part
   implicit none (type, external)
   private
   public :: attractor_settings_type, attractor_type, find_attractor, most_with_zeros

   !> Parts of the approach, after each of which rest and cycles are looked for.
   integer, parameter :: approach_parts = 10
   !> Exponents that are measured if fewer are set and all of them are zero: three zero ones
   !> and a negative one are a 3-torus.
   integer, parameter :: most_with_zeros = 4
   !> How close the line that is kept of a path is to it, as a share of its extent: one pixel in a
   !> plot of 250 pixels, and of 500 for a cycle.
   real(wp), parameter :: closeness_of_path = 1.0_wp/250.0_wp, closeness_of_cycle = 1.0_wp/500.0_wp

   !> A motion that grows to so many times its size in one observation is without bound.
   real(wp), parameter :: without_bound = 1.0e6_wp

   !> A model whose attractor is looked for.
   type :: search_type
      !> The model and its past
      class(model_type), allocatable :: model
      !> How the attractor is found and judged
      type(attractor_settings_type) :: settings
      !> Method and tolerances
      type(integration_options) :: options
   contains
      procedure :: longest_time, most_exponents
   end type search_type

contains

   !> Find the attractor of the model's own past, or the one that an earlier motion reaches.
   subroutine find_attractor(model, settings, options, attractor, error, start, arrived)
      !> The model and its past
      class(model_type), intent(in) :: model
      !> How the attractor is found and judged
      type(attractor_settings_type), intent(in) :: settings
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      type(attractor_type), intent(out) :: attractor
      !> The run ended before its time, or exponents cannot be measured
      type(error_type), allocatable, intent(out) :: error
      !> Where an earlier motion ended; empty: the model's own past
      type(continuation_type), intent(in), optional :: start
      !> Where the motion was left; empty on an error
      type(continuation_type), intent(out), optional :: arrived
      type(integration_result) :: outcome
      type(search_type) :: search

      call expect_smooth(model, error)
      if (allocated(error)) return
      if (model%sizes%driven) then
         call raise(error, "attractors: the model has t in its equations; expected one without")
         return
      end if
      allocate (search%model, source=model)
      search%settings = settings
      search%options = in_own_units(model, options)
      if (present(start)) attractor%motion%continuation = start
      if (.not. allocated(attractor%motion%continuation%y)) then
         call integrate(model, 0.0_wp, 0.0_wp, search%options, outcome, error, &
                        continuation=attractor%motion%continuation)
         if (allocated(error)) return
      end if
      call attractor%motion%begin(model, settings%sample_interval)
      associate (now => attractor%motion%continuation%time)
         attractor%time = now(1)
         call approach(search, attractor, error)
         if (allocated(error)) return
         if (attractor%class == undecided .and. attractor%reason /= unstable_rest) then
            call judge_motion(search, attractor, error)
            if (allocated(error)) return
         end if
         attractor%time = now(1) - attractor%time
      end associate
      if (settings%t_path > 0.0_wp .and. attractor%class /= fixed_point) then
         call keep_path(search, attractor)
      end if
      if (present(arrived)) arrived = attractor%motion%continuation
      call attractor%motion%forget_path()
   end subroutine find_attractor

   !> Keep the path to be drawn, of a cycle no more than one period, but with more points.
   subroutine keep_path(search, attractor)
      type(search_type), intent(in) :: search
      type(attractor_type), intent(inout) :: attractor
      real(wp) :: closeness, time

      closeness = closeness_of_path
      time = search%settings%t_path
      associate (passage => attractor%motion%section_time, &
                 n => size(attractor%motion%section_time), turns => attractor%period)
         if (attractor%class == cycle_motion .and. turns > 0 .and. n > turns) then
            closeness = closeness_of_cycle
            time = min(time, passage(n) - passage(n - turns))
         end if
      end associate
      call follow_path(search%model, attractor%motion%continuation, time, closeness, &
                       search%options, attractor%path)
   end subroutine keep_path

   !> Wait until the motion is at rest or on a cycle, but not longer than the approach may take.
   !> Near unstable rest wait as long as a motion may be observed.
   subroutine approach(search, attractor, error)
      type(search_type), intent(in) :: search
      type(attractor_type), intent(inout) :: attractor
      type(error_type), allocatable, intent(out) :: error
      integer :: most_parts, part

      most_parts = max(approach_parts, ceiling(approach_parts*search%longest_time() &
                                               /search%settings%t_transient))
      do part = 1, most_parts
         call attractor%motion%clear()
         call attractor%motion%observe(search%model, &
                                       search%settings%t_transient/approach_parts, &
                                       search%options, error)
         if (allocated(error)) return
         call attractor%motion%place_section()
         call judge_rest(search, attractor, error)
         if (allocated(error) .or. attractor%class == fixed_point) return
         if (on_cycle(attractor%motion)) return
         if (part < approach_parts) cycle
         if (.not. settles(attractor%motion%signal() - rest_level(search%model), &
                            search%model)) return
      end do
      attractor%reason = unstable_rest
   end subroutine approach

   !> Longest time of an observation.
   pure real(wp) function longest_time(self) result(time)
      class(search_type), intent(in) :: self

      time = self%settings%t_observed*2**self%settings%doublings
   end function longest_time

   !> Number of exponents: without delay there are no more than equations.
   pure integer function most_exponents(self, wanted) result(exponents)
      class(search_type), intent(in) :: self
      integer, intent(in) :: wanted

      exponents = wanted
      if (size(self%model%lag) == 0) exponents = min(exponents, self%model%n)
   end function most_exponents

   !> Whether the motion is at rest: it stays close to rest or approaches it, and rest is stable.
   subroutine judge_rest(search, attractor, error)
      type(search_type), intent(in) :: search
      type(attractor_type), intent(inout) :: attractor
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)

      if (.not. settles(attractor%motion%signal() - rest_level(search%model), search%model)) return
      call exponents_at_rest(search%model, &
                             search%most_exponents(search%settings%exponents), exponents, error)
      if (allocated(error)) return
      if (.not. all(exponents%value < 0.0_wp)) return
      attractor%exponents = exponents
      call settle(attractor)
   end subroutine judge_rest

   !> A motion: observe it until its class is certain.
   subroutine judge_motion(search, attractor, error)
      type(search_type), intent(in) :: search
      type(attractor_type), intent(inout) :: attractor
      type(error_type), allocatable, intent(out) :: error
      type(attractor_type) :: later
      type(growth_type) :: measured
      logical :: flow, last, reached, surviving, turned
      real(wp) :: spent, time
      integer :: exponents

      reached = on_cycle(attractor%motion)
      surviving = .false.
      turned = .false.
      exponents = search%most_exponents(search%settings%exponents)
      spent = 0.0_wp
      time = search%settings%t_observed
      ! at rest the flow has no direction, and so no exponent
      flow = .not. is_at_rest(attractor%motion)
      if (.not. reached) call attractor%motion%clear()
      do
         call go_on(search, exponents, flow, time, attractor%motion, measured, error)
         if (allocated(error)) return
         spent = spent + time
         last = spent >= search%longest_time()
         call judge_rest(search, attractor, error)
         if (allocated(error) .or. attractor%class == fixed_point) return
         if ((flow .eqv. is_at_rest(attractor%motion)) .and. .not. last) then
            flow = .not. flow
            call attractor%motion%clear()
            deallocate (measured%growth)
            cycle
         end if
         if (reached .neqv. on_cycle(attractor%motion)) then
            ! the motion before was the approach to a cycle, or the stay near an unstable one
            if (last .and. turned) then
               attractor%reason = not_stationary
               return
            end if
            if (reached) call attractor%motion%clear()
            if (.not. turned) spent = 0.0_wp
            turned = .true.
            reached = .not. reached
            time = search%settings%t_observed
            deallocate (measured%growth)
            cycle
         end if
         call judge(search%settings, measured, flow, last, attractor, error)
         if (allocated(error)) return
         if (attractor%class == cycle_motion) then
            associate (signal => attractor%motion%signal())
               if (trend_of(reshape(signal, [1, size(signal)]), search%options) == faster) then
                  attractor%class = undecided
                  attractor%reason = not_stationary
                  if (abs(signal(size(signal))) > without_bound*abs(signal(1))) return
               end if
            end associate
         end if
         if (last .and. exponents < search%most_exponents(most_with_zeros) &
             .and. all(without_sign(attractor%exponents, search%settings%zero_level))) then
            exponents = search%most_exponents(most_with_zeros)
            call attractor%motion%clear()
            time = search%longest_time()
            deallocate (measured%growth)
            cycle
         end if
         if (any(attractor%by_exponents == [torus, three_torus, chaos]) &
             .and. (drifts(attractor%motion%maxima) .or. leaves_cycle(attractor%exponents))) then
            attractor%class = undecided
            attractor%reason = not_stationary
            if (last) return
            call attractor%motion%clear()
            time = spent
            deallocate (measured%growth)
            cycle
         end if
         if (attractor%class == chaos .and. .not. surviving) then
            surviving = .true.
            call outlive(search, attractor, error)
            if (allocated(error)) then
               attractor%class = undecided
               return
            end if
            call judge_rest(search, attractor, error)
            if (allocated(error) .or. attractor%class == fixed_point) return
            later = attractor
            call judge(search%settings, measured, flow, last, later, error)
            if (allocated(error)) return
            if (later%reason == contradicted) then
               ! it was the approach to another motion
               attractor%class = undecided
               reached = on_cycle(attractor%motion)
               spent = 0.0_wp
               time = search%settings%t_observed
               deallocate (measured%growth)
               cycle
            end if
         end if
         if (attractor%class /= undecided .or. last) return
         time = sum(measured%length)
      end do
   end subroutine judge_motion

   !> Observe the motion for a time, and measure exponents: go on, or begin if nothing was measured.
   subroutine go_on(search, exponents, flow, time, motion, measured, error)
      type(search_type), intent(in) :: search
      integer, intent(in) :: exponents
      logical, intent(in) :: flow
      real(wp), intent(in) :: time
      type(observed_motion_type), intent(inout) :: motion
      type(growth_type), intent(inout) :: measured
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: now
      type(growth_settings_type) :: wanted

      associate (model => search%model, settings => search%settings)
         now = motion%continuation
         wanted = growth_settings_type(exponents=exponents, t_turning=settings%t_turning, &
                                       t_end=now%time(1) + settings%t_turning + time, &
                                       interval=settings%interval, bounds=.true., &
                                       across_flow=flow)
         if (allocated(measured%growth)) then
            call extend_growth(model, wanted, search%options, measured, error, motion)
         else
            call measure_growth(model, wanted, search%options, measured, error, now, &
                                observer=motion)
         end if
         if (allocated(error)) return
         call motion%arrive(undisturbed_part(measured%continuation, model%n))
      end associate
   end subroutine go_on

   !> Chaos may be transient: see what the model does after some more time.
   subroutine outlive(search, attractor, error)
      type(search_type), intent(in) :: search
      type(attractor_type), intent(inout) :: attractor
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome

      associate (now => attractor%motion%continuation)
         call integrate(search%model, now%time(1), now%time(1) + search%settings%t_lasting, &
                        search%options, outcome, error, continuation=now)
      end associate
      if (allocated(error)) return
      call attractor%motion%clear()
      call attractor%motion%observe(search%model, search%settings%t_observed, &
                                    search%options, error)
   end subroutine outlive
end module attractors
