! SPDX-License-Identifier: BSD-3-Clause
!> Runs of compiled models, for callers in C: a request in plain arrays, results by their names.
module delaykit_runs
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_int, &
                                          c_int64_t, c_loc, c_ptr
   use results, only: results_type
   use dde, only: continuation_type, event_met, event_table, integrate, integration_options, &
                  integration_result, sampler_type, table_sampler
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use delaykit_handles, only: message_of, model_of, string_of
   use delaykit_outcomes, only: put_events, put_linear_part, put_outcome, put_past, put_samples, &
                               put_switched
   use model_chain, only: blocks_in_order, chain_ends
   use model_problem, only: model_type
   use model_settings, only: check_numbers
   use natural_units, only: in_own_units
   implicit none (type, external)
   private

   !> What is wanted of a run; `delaykit.h` explains its components, which are those of dk_request.
   type, bind(c) :: request_type
      type(c_ptr) :: parameters, past, state
      real(c_double) :: t_start(2), t_end
      type(c_ptr) :: method, rtol, atol
      real(c_double) :: first_step, max_step
      integer(c_int64_t) :: max_steps
      real(c_double) :: max_bytes
      type(c_ptr) :: times, breaks, doses
      type(c_ptr) :: event_level
      type(c_ptr) :: event_component, event_direction, event_terminal, event_of_slope
      real(c_double) :: share
      integer(c_int) :: blocks, ends
      integer(c_int) :: time_count, break_count, dose_count, event_count, keep_all
      type(c_ptr) :: history
   end type request_type

   !> A past in polynomials; `delaykit.h` explains it, as dk_history.
   type, bind(c) :: pieces_type
      type(c_ptr) :: origin, kink, step_start, step_length, valid_for, nodes, coefficients
      type(c_ptr) :: passages, generation, kept
      integer(c_int) :: kinks, steps, degree, components
   end type pieces_type

   !> Samples that follow the steps, of all components.
   type, extends(sampler_type) :: steps_sampler
      !> Number of samples
      integer :: received = 0
      !> When, and the states, shape (n, at least received)
      real(wp), allocatable :: time(:), values(:, :)
      !> Whether memory holds no more
      logical :: is_full = .false.
   contains
      procedure :: take => take_sample
   end type steps_sampler

contains

   !> Keep a sample; the solver brings the time of the next one forward.
   subroutine take_sample(self, y)
      class(steps_sampler), intent(inout) :: self
      real(wp), intent(in) :: y(:)
      real(wp), allocatable :: times(:), values(:, :)
      integer :: status

      if (self%received == size(self%time)) then
         status = 1
         if (self%received <= huge(1)/2) then
            allocate (values(size(y), 2*self%received), stat=status)
         end if
         if (status == 0) allocate (times(2*self%received), stat=status)
         self%is_full = status /= 0
         if (self%is_full) then
            self%next = huge(1.0_wp)
            self%share_of_step = huge(1.0_wp)
            return
         end if
         times(:self%received) = self%time
         values(:, :self%received) = self%values
         call move_alloc(times, self%time)
         call move_alloc(values, self%values)
      end if
      self%received = self%received + 1
      self%time(self%received) = self%next
      self%values(:, self%received) = y
      self%next = huge(1.0_wp)
   end subroutine take_sample

   !> Integrate a model; 0 if it succeeded, else 1 with a message. The results hold what was reached
   !> even then.
   integer(c_int) function dk_integrate(handle, request, result, message, length) result(status) &
      bind(c)
      !> The model, as dk_open gave it
      type(c_ptr), value :: handle
      !> What is wanted
      type(request_type), intent(in) :: request
      !> The results
      type(c_ptr), intent(out) :: result
      !> Room for a message and its size
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int), value :: length
      type(results_type), pointer :: data
      type(error_type), allocatable :: error
      type(model_type) :: model

      call prepare(handle, request, result, data, model, error)
      if (.not. allocated(error)) call run(request, model, data, error)
      status = message_of(error, message, length)
   end function dk_integrate

   !> Delays of a model with these parameters, shape (number), if there is room, and their number.
   subroutine dk_delays(handle, parameters, lag, number) bind(c)
      type(c_ptr), value :: handle
      real(c_double), intent(in) :: parameters(*)
      real(c_double), intent(inout), optional :: lag(*)
      integer(c_int), intent(out) :: number
      type(model_type) :: model

      model = model_of(handle)
      associate (found => model%delays(parameters(:model%sizes%parameters)))
         number = size(found)
         if (present(lag)) lag(:number) = found
      end associate
   end subroutine dk_delays

   !> The unit of time of a model with the parameters and past of a request; 1 if they are wrong.
   real(c_double) function dk_unit_of_time(handle, request) result(unit) bind(c)
      type(c_ptr), value :: handle
      type(request_type), intent(in) :: request
      type(error_type), allocatable :: error
      type(integration_options) :: options
      type(model_type) :: model

      model = model_of(handle)
      call set_model(request, model, error)
      if (.not. allocated(error)) options = in_own_units(model, options, known=abs(model%past))
      unit = options%unit_of_time
   end function dk_unit_of_time

   !> The equations at the constant past of a request, and their derivatives by states (lag 0) and
   !> delayed values that are not 0; 0 if it succeeded, else 1 with a message.
   integer(c_int) function dk_linearise(handle, request, result, message, length) result(status) &
      bind(c)
      !> The model, as dk_open gave it
      type(c_ptr), value :: handle
      !> Parameters and past
      type(request_type), intent(in) :: request
      !> The results
      type(c_ptr), intent(out) :: result
      !> Room for a message and its size
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int), value :: length
      type(results_type), pointer :: data
      type(error_type), allocatable :: error
      type(model_type) :: model

      call prepare(handle, request, result, data, model, error)
      if (.not. allocated(error)) call put_linear_part(data, model, request%t_start(1))
      status = message_of(error, message, length)
   end function dk_linearise

   !> Results without anything in them, and the model of a handle as a request wants it.
   subroutine prepare(handle, request, result, data, model, error)
      type(c_ptr), intent(in) :: handle
      type(request_type), intent(in) :: request
      type(c_ptr), intent(out) :: result
      type(results_type), pointer, intent(out) :: data
      type(model_type), intent(out) :: model
      !> A parameter is out of its range, or a delay negative
      type(error_type), allocatable, intent(out) :: error

      allocate (data)
      result = c_loc(data)
      model = model_of(handle)
      call set_model(request, model, error)
   end subroutine prepare

   !> Give a model its parameters, blocks and constant past.
   subroutine set_model(request, model, error)
      type(request_type), intent(in) :: request
      type(model_type), intent(inout) :: model
      !> A parameter is out of its range, or a delay negative
      type(error_type), allocatable, intent(out) :: error
      real(wp), pointer :: numbers(:), past(:)
      integer :: blocks

      numbers => reals_at(request%parameters, model%sizes%parameters)
      call check_numbers(model, "", numbers, error)
      if (allocated(error)) return
      blocks = request%blocks
      call model%set_blocks(blocks, trim(chain_ends(request%ends)))
      past => reals_at(request%past, model%sizes%states*blocks)
      call model%set(numbers, past(places_of(model, blocks)))
   end subroutine set_model

   !> Where each component of the state vector stands among those of the caller, which are in the
   !> order of the blocks.
   pure function places_of(model, blocks) result(at)
      type(model_type), intent(in) :: model
      integer, intent(in) :: blocks
      integer :: at(model%sizes%states*blocks), i, k, order(blocks)

      order = blocks_in_order(blocks, trim(model%ends))
      associate (n => model%sizes%states)
         at = [((n*(order(k) - 1) + i, i=1, n), k=1, blocks)]
      end associate
   end function places_of

   !> The run, from dose to dose.
   subroutine run(request, model, data, error)
      type(request_type), intent(in) :: request
      type(model_type), intent(in) :: model
      type(results_type), intent(inout) :: data
      type(error_type), allocatable, intent(out) :: error
      type(continuation_type) :: now
      type(event_table) :: watcher
      type(integration_options) :: options
      type(integration_result) :: outcome, total
      class(sampler_type), pointer :: sampler
      type(steps_sampler), target :: followed
      type(table_sampler), target :: table
      real(wp), pointer :: doses(:, :)
      real(wp) :: from, to
      integer :: at(model%n), k
      logical :: follows

      call begin(request, model, now)
      call c_f_pointer(request%doses, doses, [1 + model%n, request%dose_count])
      call set_options(request, model, now, doses, options)
      follows = request%time_count < 0
      if (follows) then
         followed%wanted = [(k, k=1, model%n)]
         followed%share_of_step = request%share
         followed%next = request%t_start(1)
         allocate (followed%time(64), followed%values(model%n, 64))
         sampler => followed
      else
         table = table_sampler([(k, k=1, model%n)], reals_at(request%times, request%time_count))
         sampler => table
      end if
      watcher = event_table(integers_at(request%event_component, request%event_count), &
                            reals_at(request%event_level, request%event_count), &
                            integers_at(request%event_direction, request%event_count), &
                            integers_at(request%event_terminal, request%event_count) /= 0, &
                            integers_at(request%event_of_slope, request%event_count) /= 0)
      watcher%takes_acts = .true.
      from = request%t_start(1)
      do k = 1, request%dose_count + 1
         to = request%t_end
         if (k <= request%dose_count) to = doses(1, k)
         if (request%event_count + model%acting > 0) then
            call integrate(model, from, to, options, outcome, error, sampler, watcher, now)
         else
            call integrate(model, from, to, options, outcome, error, sampler, continuation=now)
         end if
         call add(outcome, total)
         if (allocated(error) .or. outcome%reason == event_met) exit
         from = to
         if (k > request%dose_count) exit
         call now%change_state(outcome%y + doses(2:, k), error)
         if (allocated(error)) exit
      end do
      if (.not. allocated(outcome%y)) return
      at = places_of(model, request%blocks)
      if (follows) then
         if (followed%is_full) then
            if (.not. allocated(error)) then
               call raise(error, "integrate: no memory for more than "//text(followed%received) &
                          //" samples; expected t_eval, or fewer samples_per_step")
            end if
            ! nor for a copy of these
            followed%received = 0
         else if (followed%time(max(1, followed%received)) < outcome%t) then
            followed%next = outcome%t
            call followed%take(outcome%y)
         end if
         followed%values(at, :) = followed%values
         call put_samples(data, followed%time(:followed%received), &
                          followed%values(:, :followed%received))
      else
         table%values(at, :) = table%values
         call put_samples(data, table%time, table%values)
      end if
      if (watcher%received > 0) watcher%y(at, :) = watcher%y
      call put_events(data, watcher)
      call put_outcome(data, total, now, model%switches)
      call put_switched(data, model, total)
      if (request%keep_all /= 0 .and. allocated(now%step_length)) then
         now%y(at) = now%y
         now%coefficients(:, at, :) = now%coefficients
         call put_past(data, now)
      end if
   end subroutine run

   !> Method, tolerances and limits.
   subroutine set_options(request, model, start, doses, options)
      type(request_type), intent(in) :: request
      type(model_type), intent(in) :: model
      type(continuation_type), intent(in) :: start
      real(wp), intent(in) :: doses(:, :)
      type(integration_options), intent(out) :: options
      real(wp) :: sizes(model%n)

      options%method = string_of(request%method)
      options%each_relative = reals_at(request%rtol, model%n)
      sizes = max(0.0_wp, maxval(abs(doses(2:, :)), dim=2))
      if (allocated(start%y)) then
         sizes = max(sizes, abs(start%y), maxval(abs(start%coefficients(1, :, :)), dim=2))
      end if
      options%relative = minval(options%each_relative)
      options = in_own_units(model, options, request%t_start(1), sizes)
      if (c_associated(request%atol)) then
         options%each_absolute = reals_at(request%atol, model%n)
         options%share_of_largest = 0.0_wp
      end if
      options%first_step = request%first_step
      options%longest_step = request%max_step
      options%most_steps = request%max_steps
      options%most_bytes = request%max_bytes
      options%keep_all = request%keep_all /= 0
      if (request%break_count > 0) then
         options%break_at = reals_at(request%breaks, request%break_count)
      end if
   end subroutine set_options

   !> Where the run begins: a state that differs from the past, or a past in polynomials. It is
   !> empty if the past is constant and goes on without a jump.
   subroutine begin(request, model, now)
      type(request_type), intent(in) :: request
      type(model_type), intent(in) :: model
      type(continuation_type), intent(out) :: now
      type(pieces_type), pointer :: given
      real(wp), pointer :: state(:)
      integer :: at(model%n)

      if (.not. c_associated(request%state)) return
      call c_f_pointer(request%history, given)
      now%time = request%t_start
      at = places_of(model, request%blocks)
      state => reals_at(request%state, model%n)
      now%y = state(at)
      allocate (now%slope(0), now%rate(0))
      now%origin = reals_at(given%origin, 2)
      now%kept = integers_at(given%kept, given%components)
      now%kink = reshape(reals_at(given%kink, 2*given%kinks), [2, given%kinks])
      now%passages = integers_at(given%passages, given%kinks)
      now%generation = integers_at(given%generation, given%kinks)
      associate (steps => given%steps, degree => given%degree)
         now%step_start = reshape(reals_at(given%step_start, 2*steps), [2, steps])
         now%step_length = reals_at(given%step_length, steps)
         now%valid_for = reals_at(given%valid_for, steps)
         now%nodes = reshape(reals_at(given%nodes, degree*steps), [degree, steps])
         now%coefficients = reshape( &
                            reals_at(given%coefficients, (1 + degree)*given%components*steps), &
                            [1 + degree, given%components, steps])
         if (model%ends == "ring") now%coefficients = now%coefficients(:, at, :)
      end associate
   end subroutine begin

   !> Add the counts of a part of a run.
   subroutine add(outcome, total)
      type(integration_result), intent(in) :: outcome
      type(integration_result), intent(inout) :: total

      total%reason = outcome%reason
      total%accepted = total%accepted + outcome%accepted
      total%rejected = total%rejected + outcome%rejected
      total%implicit_steps = total%implicit_steps + outcome%implicit_steps
      total%evaluations = total%evaluations + outcome%evaluations
      total%factorisations = total%factorisations + outcome%factorisations
      total%breaking_points = total%breaking_points + outcome%breaking_points
      total%untracked = total%untracked + outcome%untracked
      if (.not. allocated(total%switched)) total%switched = 0*outcome%switched
      total%switched = total%switched + outcome%switched
   end subroutine add

   !> Numbers that a caller owns.
   function reals_at(address, length) result(values)
      type(c_ptr), intent(in) :: address
      integer, intent(in) :: length
      real(wp), pointer :: values(:)

      call c_f_pointer(address, values, [max(0, length)])
   end function reals_at

   !> Integers that a caller owns.
   function integers_at(address, length) result(values)
      type(c_ptr), intent(in) :: address
      integer, intent(in) :: length
      integer(c_int), pointer :: values(:)

      call c_f_pointer(address, values, [max(0, length)])
   end function integers_at
end module delaykit_runs
