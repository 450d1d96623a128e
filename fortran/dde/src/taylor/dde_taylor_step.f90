! SPDX-License-Identifier: BSD-3-Clause
!> One step by the Taylor series of the solution, for problems that give it. The last coefficients
!> give the step size before the step, so that hardly a step is rejected. The series is its own
!> dense output. As far as it converges it is also valid beyond the end of the step.
module dde_taylor_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_controller, only: controller_type, method_constants
   use dde_errors, only: error_type
   use dde_interpolant, only: highest_degree
   use dde_memory, only: find_lacking
   use dde_problem, only: dde_problem_type
   use dde_series_check, only: measure_residual, refuse_wrong
   use dde_step, only: step_type
   use dde_step_context, only: step_context
   use dde_taylor_series, only: taylor_series
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: taylor_step_type

   !> Degree of the series = this - log10(tolerance), near the degree of least cost for an accuracy.
   !> Jorba and Zou 2005, "A software package for the numerical integration of ODEs by means of
   !> high-order Taylor methods", sec. 3.2, have 1 - ln(tolerance)/2. The degree here is higher
   !> since a step costs three times its series.
   real(wp), parameter :: degree_at_one = 7.0_wp
   !> Lowest degree.
   integer, parameter :: lowest_degree = 6
   !> The series is valid as the past for this many times the step size that it allows.
   real(wp), parameter :: beyond = 1.2_wp
   !> The unit of a series is the step size that the last series allowed, at most this many times
   !> the length of its step: powers of it must not overflow where a solution is a polynomial.
   real(wp), parameter :: growth = 1000.0_wp
   !> A step of this share of the length to a breaking point ends there.
   real(wp), parameter :: nearly = 1.0_wp - 1.0e-8_wp
   !> A slow series is left if its residual falls by a smaller power of the length of the step: then
   !> it is not that of terms that the series leaves out.
   integer, parameter :: least_power = 4
   !> Cost of a series over that of a right-hand side, divided by its degree (measured in
   !> instructions and time on a spring-block model).
   real(wp), parameter :: cost_of_degree = 0.75_wp
   !> The second term is small below this share of the first, the third below its square.
   real(wp), parameter :: small = 0.04_wp
   !> Second term of exp(x) at the limit of stability, over degree squared, and a little more.
   real(wp), parameter :: stability = 0.1_wp

   !> A step along the series from its start on.
   type, extends(step_type) :: taylor_step_type
      !> The series
      type(taylor_series), private :: series
      !> What was wrong in the last attempt of the first step, see `refuse_wrong`
      integer, private :: suspect = 0
      !> Whether the series is that from the start of the step, which an earlier attempt found
      logical, private :: found = .false.
      !> Residuals of the last two attempts with it over the largest allowed (0: none) and lengths
      real(wp), private :: residual(2) = 0.0_wp, length(2) = 1.0_wp
      !> Time along the series of the present state; negative if its slope was evaluated instead
      real(wp), private :: place = -1.0_wp
   contains
      procedure :: set_up, refuse_series, renew, reset, propose, attempt, interpolant, stiff
      procedure :: next_length, advance, slope_here, state_at
   end type taylor_step_type

contains

   !> Storage, and the state at the initial time.
   subroutine set_up(self, problem, tolerance, lacking)
      class(taylor_step_type), intent(out) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Level of the tolerance
      real(wp), intent(in) :: tolerance
      !> Bytes that could not be allocated, or 0
      real(wp), intent(out) :: lacking
      integer :: degree

      ! at most so many for each component and delayed value
      lacking = find_lacking(4.0_wp*(2 + highest_degree)*(problem%n + size(problem%lag)))
      if (lacking > 0.0_wp) return
      degree = max(lowest_degree, min(highest_degree, nint(degree_at_one - log10(tolerance))))
      self%constants = method_constants(order=degree, error_order=degree, &
                                        evaluation_cost=cost_of_degree*degree)
      call self%allocate_state(problem)
      self%powers = .true.
      allocate (self%nodes(degree), source=0.0_wp)
      self%series = taylor_series(problem, degree)
   end subroutine set_up

   !> Refuse a series that is wrong.
   pure subroutine refuse_series(self, context, error)
      class(taylor_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      type(error_type), allocatable, intent(out) :: error

      call refuse_wrong(context, self%series, self%h, self%scale, self%suspect, error)
   end subroutine refuse_series

   !> The series of the step gives its slope.
   pure subroutine renew(self, context)
      class(taylor_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context

      call self%series%slow%forget()
   end subroutine renew

   !> The slope was evaluated: the last series no longer gives it.
   pure subroutine reset(self)
      class(taylor_step_type), intent(inout) :: self

      self%place = -1.0_wp
      self%found = .false.
      call self%series%slow%forget()
   end subroutine reset

   !> Find the series, and the largest step for which it and the past it is made from are valid.
   pure subroutine propose(self, context, h)
      class(taylor_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(inout) :: h
      real(wp) :: possible, unit
      logical :: held, skipping

      if (self%found .and. self%series%reach > 0.0_wp) then
         ! rejected: the series is not valid as far as its coefficients say
         self%series%reach = min(self%series%reach, h)
         self%valid_for = h
         if (.not. self%series%slow%holds) return
         associate (error => self%residual, length => self%length)
            if (.not. error(1) > 0.0_wp) return
            if (error(2) <= error(1)*(length(2)/length(1))**least_power) return
         end associate
         call self%series%slow%give_up()
      end if
      held = self%series%slow%holds
      associate (series => self%series, cursor => context%cursor)
         unit = merge(min(series%reach, growth*self%h), h, series%reach > 0.0_wp)
         call context%tolerance%scale(self%y, self%scale)
         series%delayed%averaged = .not. series%slow%holds
         skipping = .true.
         do
            series%unit = unit
            call series%delayed%read_past(context, skipping, series%unit)
            call series%expand(context, cursor%inside(cursor%t), self%scale, self%y)
            possible = min(series%reach, cursor%h)
            call series%delayed%confirm(context, series%unit, possible)
            ! a step that ends at a breaking point is short for its sake, not for that of the series
            if (possible >= nearly*cursor%h) possible = series%reach
            if (possible > 0.0_wp .or. .not. skipping) exit
            skipping = .false.
            ! a series that is not finite shows nothing of the slow one
            if (.not. series%reach > 0.0_wp) series%slow%holds = held
         end do
         self%place = 0.0_wp
         self%found = .true.
         self%residual = 0.0_wp
         self%valid_for = beyond*series%reach
         if (series%reach > 0.0_wp) h = possible
      end associate
   end subroutine propose

   !> The next step size that the series would allow is near that of this one.
   pure subroutine next_length(self, control, h, error)
      class(taylor_step_type), intent(in) :: self
      type(controller_type), intent(inout) :: control
      real(wp), intent(inout) :: h
      real(wp), intent(in) :: error

      control = controller_type()
      h = self%series%reach
   end subroutine next_length

   !> Attempt a step. Its length was chosen from the last coefficients, which say nothing of what
   !> they do not hold: `error` is the residual at the end, or not a number if the series is not
   !> finite.
   pure subroutine attempt(self, context, error)
      class(taylor_step_type), intent(inout) :: self
      type(step_context), intent(inout) :: context
      real(wp), intent(out) :: error
      integer :: worst

      self%t = context%cursor%t
      self%h = context%cursor%h
      error = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. self%series%reach > 0.0_wp) return
      ! beyond this, terms that vanish in a very short step would become large
      self%valid_for = min(self%valid_for, growth*self%h)
      call self%series%state(self%h, self%y_new)
      if (.not. all(ieee_is_finite(self%y_new))) return
      call measure_residual(context, self%series, self%h, self%h, self%scale, self%y_new, self%z, &
                            self%slope, worst, error)
      self%residual = [self%residual(2), error]
      self%length = [self%length(2), self%h]
   end subroutine attempt

   !> The series of component `i`.
   pure subroutine interpolant(self, i, a)
      class(taylor_step_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp), contiguous, intent(out) :: a(0:)
      real(wp) :: power
      integer :: k

      associate (series => self%series)
         a(0) = series%coefficients(0, i)
         power = 1.0_wp
         do k = 1, series%degree
            power = power*(self%h/series%unit)
            a(k) = power*series%coefficients(k, i)
         end do
      end associate
   end subroutine interpolant

   !> Whether the step is much shorter than the time on which the solution changes: its second and
   !> third terms are small beside the first. They may exceed that by the truncation error, which is
   !> at the level of the tolerance, in a step at the limit of stability or in a slow series.
   pure logical function stiff(self) result(value)
      class(taylor_step_type), intent(in) :: self
      real(wp) :: first, of_second, of_third, place, second, third, weight
      integer :: i

      place = self%h/self%series%unit
      first = 0.0_wp
      second = 0.0_wp
      third = 0.0_wp
      associate (c => self%series%coefficients)
         do i = 1, size(self%scale)
            weight = place/self%scale(i)
            first = max(first, weight*abs(c(1, i)))
            second = max(second, weight*place*abs(c(2, i)))
            third = max(third, weight*place**2*abs(c(3, i)))
         end do
      end associate
      of_second = 1.0_wp
      of_third = 1.0_wp
      if (.not. self%series%slow%holds) then
         of_second = stability*self%constants%order**2
         of_third = of_second*self%constants%order/6
      end if
      value = second < small*first + of_second .and. third < small**2*first + of_third
   end function stiff

   !> The end becomes the start.
   pure subroutine advance(self)
      class(taylor_step_type), intent(inout) :: self

      self%y = self%y_new
      self%place = self%h
      self%found = .false.
   end subroutine advance

   !> The series at a place.
   pure subroutine state_at(self, place, y)
      class(taylor_step_type), intent(in) :: self
      real(wp), intent(in) :: place
      real(wp), intent(out) :: y(:)

      call self%series%state(place*self%h, y)
   end subroutine state_at

   !> The derivative of the series.
   pure function slope_here(self) result(slope)
      class(taylor_step_type), intent(in) :: self
      real(wp) :: slope(size(self%y))
      integer :: i

      slope = self%slope
      if (self%place < 0.0_wp) return
      slope = [(self%series%slope_of(i, self%place), i=1, size(slope))]
   end function slope_here
end module dde_taylor_step
