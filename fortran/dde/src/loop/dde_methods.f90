! SPDX-License-Identifier: BSD-3-Clause
!> The methods: how a step of each is made, how one follows another, and how long steps may be.
module dde_methods
   use dde_explicit_step, only: explicit_step_type
   use dde_implicit_step, only: implicit_cost, implicit_step_type, stages_of
   use dde_interpolant, only: highest_degree
   use dde_memory, only: find_lacking
   use dde_orders, only: explicit_method, radau_method, series_pays
   use dde_problem, only: dde_problem_type
   use dde_slow_series, only: least_balance
   use dde_step, only: step_type
   use dde_switch, only: least_trial
   use dde_taylor_step, only: taylor_step_type
   use dde_tolerance, only: tolerance_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: choose_method, longest_step, matching_method, price_of_trial

   !> Iterations of a usual implicit step.
   integer, parameter :: usual_iterations = 3

contains

   !> Work of a short trial of the implicit method without its linear systems, in evaluations of the
   !> explicit pair: one Jacobian by differences, and the steps.
   pure real(wp) function price_of_trial(problem, tolerance) result(price)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      integer :: columns, stages

      stages = stages_of(radau_method(tolerance%level))
      columns = problem%n
      if (problem%lower >= 0) columns = min(problem%n, 1 + problem%lower + problem%upper)
      price = implicit_cost*(columns + least_trial*(usual_iterations*stages + 2))
   end function price_of_trial

   !> Real numbers of a step of a method, at most, counted from its components. It is made as a copy
   !> of another one.
   pure real(wp) function size_of_step(problem, method) result(reals)
      class(dde_problem_type), intent(in) :: problem
      character(len=8), intent(in) :: method
      integer :: stages
      real(wp) :: above, below, delays, height, n

      n = problem%n
      delays = size(problem%lag)
      select case (method)
      case ("radau5", "radau9", "radau13")
         stages = stages_of(method)
         height = n
         below = n - 1
         above = n - 1
         if (problem%lower >= 0) then
            below = problem%lower
            above = problem%upper
         end if
         if (allocated(problem%rows) .and. delays > 0) then
            height = maxval(problem%rows(2, :) - problem%rows(1, :)) + 1
            ! delayed values in the step widen the band
            below = max(below, real(maxval(problem%rows(2, :) - problem%component), wp))
            above = max(above, real(maxval(problem%component - problem%rows(1, :)), wp))
         end if
         ! two Jacobians, a real system for each, and a complex one for each pair of stages
         reals = 2*(n*min(n, 1 + below + above) + height*delays) &
                 + n*min(n, 1 + 2*below + above)*(2 + (stages - 1)) + n*2*(8*stages + 16) &
                 + delays*2*stages**2
         ! and one of all stages
         if (delays > 0) reals = reals + n*stages*min(n*stages, stages*(2*below + above + 3))
      case ("taylor")
         reals = (n + delays)*4*(2 + highest_degree)
      case default
         reals = (n + delays)*2*26
      end select
   end function size_of_step

   !> A step of the chosen method; `auto` begins with an explicit one.
   subroutine choose_method(problem, method, tolerance, origin, step, lacking)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Name of the method
      character(len=8), intent(in) :: method
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      !> Initial time of the first run
      real(wp), intent(in) :: origin
      !> Step of the method
      class(step_type), allocatable, intent(out) :: step
      !> Bytes that could not be allocated, or 0
      real(wp), intent(out) :: lacking
      character(len=8) :: name
      type(explicit_step_type), allocatable :: explicit
      type(implicit_step_type), allocatable :: implicit
      type(taylor_step_type), allocatable :: taylor

      name = method
      if (name == "auto") name = matching_method(problem, tolerance, origin, implicit=.false.)
      if (name == "explicit") name = explicit_method(tolerance%level)
      lacking = find_lacking(size_of_step(problem, name))
      if (lacking > 0.0_wp) return
      select case (name)
      case ("radau5", "radau9", "radau13")
         allocate (implicit)
         call implicit%set_up(problem, name, tolerance%level)
         call move_alloc(implicit, step)
      case ("taylor")
         allocate (taylor)
         call taylor%set_up(problem, tolerance%level)
         call move_alloc(taylor, step)
      case default
         allocate (explicit)
         call explicit%set_up(problem, name)
         call move_alloc(explicit, step)
      end select
   end subroutine choose_method

   !> The explicit or the implicit method of `auto`. Where the series of many delays do not pay,
   !> that of a slow solution may, if it may hold in steps up to the shortest delay.
   pure function matching_method(problem, tolerance, origin, implicit) result(method)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      !> Initial time of the first run
      real(wp), intent(in) :: origin
      !> Which of the two
      logical, intent(in) :: implicit
      character(len=8) :: method
      real(wp), allocatable :: y(:)

      method = explicit_method(tolerance%level)
      if (implicit) then
         method = radau_method(tolerance%level)
      else if (problem%analytic) then
         if (.not. series_pays(tolerance%level, problem%n, size(problem%lag))) then
            allocate (y(problem%n))
            call problem%initial(y)
            if (problem%relaxation_rate(origin, y) < least_balance/minval(problem%lag)) return
         end if
         method = "taylor"
      end if
   end function matching_method

   !> The longest step allowed: an explicit one ends before its delayed values lie in it.
   pure function longest_step(problem, step, of_all) result(longest)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step
      class(step_type), intent(in) :: step
      !> Longest step that is allowed for other reasons
      real(wp), intent(in) :: of_all
      real(wp) :: longest

      longest = of_all
      if (.not. step%constants%implicit) longest = min(longest, minval(problem%lag))
   end function longest_step
end module dde_methods
