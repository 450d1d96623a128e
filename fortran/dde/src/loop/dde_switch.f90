! SPDX-License-Identifier: BSD-3-Clause
!> The choice of `auto` between the explicit and the implicit method while a run goes on.
!>
!> A step is limited where something else than the change of the solution keeps it short. Work in
!> limited steps earns a trial of the other method. A trial takes a few steps; then the method that
!> made less time for its work is left, and the other one is settled. Its step is kept here.
module dde_switch
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_problem, only: dde_problem_type
   use dde_slow_series, only: least_balance
   use dde_step, only: step_type
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: least_trial, switch_type

   !> Share of the work in limited steps that visits to the other method may cost, where they were
   !> not worth it.
   real(wp), parameter :: share = 0.5_wp
   !> A visit was worth it if its pace was this times the pace of the method before.
   real(wp), parameter :: worth = 2.0_wp
   !> Steps of a trial, at least and at most; in between it ends where steps no longer grow. The
   !> pace of a settled implicit method is taken over the latter number of steps.
   integer, parameter :: least_trial = 3, longest_trial = 6
   !> Proposed length, in units of the shortest delay, from which on the delay limits an explicit
   !> step.
   real(wp), parameter :: beyond_the_delay = 4.0_wp

   !> Rejections in a row after which Taylor series are left.
   integer, parameter :: most_rejections = 20

   !> The solution hardly moves on in a few steps that are shorter by this factor than those before.
   !> It is below 6**6, by which implicit steps may grow in a trial: otherwise steps could stay
   !> short for ever.
   real(wp), parameter :: hardly = 3.0e4_wp

   !> States of the choice.
   integer, parameter :: settled = 1, on_trial = 2

   !> Steps in a row.
   type :: stretch_type
      !> Number of steps
      integer :: steps = 0
      !> Time and work of these steps, work in evaluations of the explicit pair
      real(wp) :: time = 0.0_wp, work = 0.0_wp
   contains
      procedure :: add, pace
   end type stretch_type

   !> The choice, and what it rests on.
   type :: switch_type
      !> The step of the method that is not in use, kept once it has been used
      class(step_type), allocatable :: other
      !> Length that it proposed when it was left
      real(wp), private :: h_of_other = 0.0_wp
      !> Work of a short trial of the implicit method without its linear systems, and with those
      !> of the last trial
      real(wp) :: least_price = 0.0_wp, price = 0.0_wp
      !> `settled` or `on_trial`
      integer, private :: state = settled
      !> Work in limited steps, and in visits that were not worth it
      real(wp), private :: limited_work = 0.0_wp, lost_work = 0.0_wp
      !> All work up to the last step
      real(wp), private :: work_done = 0.0_wp
      !> Work in linear systems before this visit
      real(wp), private :: work_in_systems = 0.0_wp
      !> The steps that the present pace is taken over, and all since the last change of method
      type(stretch_type), private :: recent, visit
      !> Pace of the other method when it was left
      real(wp), private :: pace_of_other = 0.0_wp
      !> Whether the last change ended a trial: it was one back
      logical, private :: returned = .false.
      !> Whether the explicit method is that of Taylor series
      logical :: series = .false.
      !> Rejections since the last accepted step
      integer, private :: rejections = 0
      !> The shortest delay
      real(wp) :: shortest = 0.0_wp
   contains
      procedure :: exchange, judge, judge_rejection
   end type switch_type

contains

   !> One more step.
   pure subroutine add(self, time, work)
      class(stretch_type), intent(inout) :: self
      real(wp), intent(in) :: time, work

      self%steps = self%steps + 1
      self%time = self%time + time
      self%work = self%work + work
   end subroutine add

   !> Time per work.
   pure real(wp) function pace(self) result(value)
      class(stretch_type), intent(in) :: self

      value = self%time/max(1.0_wp, self%work)
   end function pace

   !> Take in an accepted step, and see whether the other method takes over.
   pure subroutine judge(self, problem, step, work_done, h_next, left, other)
      class(switch_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      class(step_type), intent(in) :: step
      !> Work of the run so far
      type(work_type), intent(in) :: work_done
      !> Length proposed for the next step
      real(wp), intent(in) :: h_next
      !> Time left to the end of the run, as far as there is one
      real(wp), intent(in) :: left
      logical, intent(out) :: other
      logical :: limited, pace_is_known
      real(wp) :: pace, total, work

      self%rejections = 0
      total = work_done%total()
      work = total - self%work_done
      self%work_done = total
      call self%recent%add(step%h, work)
      call self%visit%add(step%h, work)
      pace = self%recent%pace()
      select case (self%state)
      case (on_trial)
         associate (steps => self%recent%steps, kept => step%constants%largest_kept_ratio)
            pace_is_known = steps == longest_trial .or. &
                            steps >= least_trial .and. h_next <= kept*step%h
         end associate
         ! steps of the present length may be faster than the first ones
         if (pace_is_known) pace = max(pace, step%h*self%recent%steps/self%recent%work)
         other = pace_is_known .and. pace < self%pace_of_other
         if (pace_is_known) then
            self%state = settled
            if (step%constants%implicit) then
               ! which zeros a Jacobian has is known only now
               self%price = self%least_price + (work_done%in_systems() - self%work_in_systems) &
                            *least_trial/self%recent%steps
            end if
         end if
      case default
         limited = is_limited(self, problem, step, h_next)
         pace_is_known = .not. limited
         if (step%constants%implicit) then
            pace_is_known = self%recent%steps == longest_trial
            limited = limited .or. pace_is_known .and. pace < self%pace_of_other
         end if
         if (limited) self%limited_work = self%limited_work + work
         other = limited .and. self%lost_work + self%price <= share*self%limited_work &
                 .and. self%price*pace <= share*left
         if (other) self%state = on_trial
      end select
      if (other) then
         self%returned = self%state == settled
         self%work_in_systems = work_done%in_systems()
         call end_visit(self, pace)
      end if
      if (other .or. pace_is_known) self%recent = stretch_type()
   end subroutine judge

   !> Take in a rejected step. Series that fail again and again are left.
   pure subroutine judge_rejection(self, step, error, other)
      class(switch_type), intent(inout) :: self
      class(step_type), intent(in) :: step
      !> Error of the step; no method helps where it is not finite
      real(wp), intent(in) :: error
      logical, intent(out) :: other

      if (ieee_is_finite(error)) self%rejections = self%rejections + 1
      other = self%rejections == most_rejections .and. self%series &
              .and. .not. step%constants%implicit
      if (.not. other) return
      self%state = settled
      self%returned = .false.
      self%recent = stretch_type()
      call end_visit(self, 0.0_wp)
   end subroutine judge_rejection

   !> Let the other method go on from where the one in use stands.
   subroutine exchange(self, step, h)
      class(switch_type), intent(inout) :: self
      !> The step of the method in use
      class(step_type), allocatable, intent(inout) :: step
      !> Length proposed for the next step; that which the other method proposed, if it was left a
      !> few steps ago and the solution hardly moved on in these
      real(wp), intent(inout) :: h
      class(step_type), allocatable :: last
      real(wp) :: proposed

      self%other%y = step%y
      self%other%slope = step%slope_here()
      call self%other%reset()
      call move_alloc(step, last)
      call move_alloc(self%other, step)
      call move_alloc(last, self%other)
      proposed = h
      if (self%returned .and. self%h_of_other > hardly*h) h = self%h_of_other
      self%h_of_other = proposed
   end subroutine exchange

   !> The other method takes over.
   pure subroutine end_visit(self, pace)
      class(switch_type), intent(inout) :: self
      real(wp), intent(in) :: pace

      if (self%visit%pace() < worth*self%pace_of_other) then
         self%lost_work = self%lost_work + min(self%visit%work, self%price)
      end if
      self%visit = stretch_type()
      self%pace_of_other = pace
   end subroutine end_visit

   !> Whether something else than the change of the solution limits a step: of the explicit method
   !> stability or a delay; of the implicit one nothing, where an explicit step could be as long.
   pure logical function is_limited(self, problem, step, h_next) result(limited)
      class(switch_type), intent(in) :: self
      class(dde_problem_type), intent(in) :: problem
      class(step_type), intent(in) :: step
      real(wp), intent(in) :: h_next
      logical :: delay_limits

      delay_limits = h_next/beyond_the_delay > self%shortest
      if (step%constants%implicit) then
         limited = .not. step%stiff()
         if (self%series) then
            ! fast components are in balance all along the step
            limited = limited .or. step%h*problem%relaxation_rate(step%t + step%h, step%y_new) &
                      > least_balance
         end if
         limited = limited .and. .not. delay_limits
      else
         limited = step%stiff() .or. delay_limits
      end if
   end function is_limited
end module dde_switch
