! SPDX-License-Identifier: BSD-3-Clause
!> The methods: their names, which of them a run takes, and how a step of each is made. Orders are
!> chosen once a run, by the tolerance. The figure `work_precision` shows what each order costs.
module dde_methods
   use dde_bogacki_shampine, only: bogacki_shampine
   use dde_dop853, only: dop853
   use dde_errors, only: error_type, raise, text
   use dde_explicit_step, only: explicit_step_type
   use dde_implicit_step, only: implicit_cost, implicit_step_type
   use dde_memory, only: small
   use dde_problem, only: dde_problem_type, not_given
   use dde_slow_series, only: least_balance
   use dde_step, only: step_type
   use dde_switch, only: least_trial
   use dde_taylor_step, only: taylor_step_type
   use dde_tolerance, only: tolerance_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: choose_method, matching_method, methods, price_of_trial, read_by_methods

   !> All methods, in the order of messages: the name, and what the method reads of a problem beside
   !> f: "jacobian" if it is implicit, "series", or "f" alone. The workflow reads the names here.
   character(len=8), parameter :: table(2, 8) = reshape([character(len=8) :: &
                                                         "auto", "f", &
                                                         "explicit", "f", &
                                                         "bs5", "f", &
                                                         "dop853", "f", &
                                                         "taylor", "series", &
                                                         "radau5", "jacobian", &
                                                         "radau9", "jacobian", &
                                                         "radau13", "jacobian"], [2, 8])
   character(len=8), parameter :: methods(*) = table(1, :), read_by_methods(*) = table(2, :)

   !> Least tolerance of the pair 5(4); below it the pair is 8(5,3).
   real(wp), parameter :: least_of_bs5 = 3.0e-6_wp
   !> Least tolerance at which the pair takes fewer instructions than a Taylor series where there is
   !> a delayed value for every two equations or more: their series cost most of a step.
   real(wp), parameter :: least_of_many = 1.0e-5_wp
   !> Least tolerances of Radau IIA of order 5 and 9; below them the order is 13.
   real(wp), parameter :: least_of_radau5 = 3.0e-5_wp, least_of_radau9 = 1.0e-11_wp
   !> Least number of times in which a component would decay, of those in the shortest delay, with
   !> which `auto` begins by the implicit method. If that is the wrong one, it costs 200 evaluations
   !> or so; an explicit one takes 900 or more then up to the first delay.
   real(wp), parameter :: least_decays = 500.0_wp
   !> Iterations of a usual implicit step.
   integer, parameter :: usual_iterations = 3

contains

   !> A step of the chosen method.
   subroutine choose_method(problem, method, tolerance, origin, step, lacking, error)
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
      !> No method has this name, or it needs series that the problem does not give
      type(error_type), allocatable, intent(out) :: error
      character(len=8) :: name
      character(len=:), allocatable :: names
      type(explicit_step_type), allocatable :: explicit
      type(implicit_step_type), allocatable :: implicit
      type(taylor_step_type), allocatable :: taylor
      integer :: i

      lacking = 0.0_wp
      name = method
      if (name == "auto") name = first_method(problem, tolerance, origin)
      if (name == "explicit") name = explicit_method(tolerance%level)
      if (any(methods == name .and. read_by_methods == "series") .and. .not. problem%analytic) then
         call raise(error, "integrate: method = '"//trim(name)//"' for a problem that gives no " &
                    //"Taylor series (analytic = .false.); another method expected")
         return
      end if
      if (problem%moving > 0 .and. name == "taylor") then
         call raise(error, "integrate: method = '"//trim(name)//"' for a problem with delays " &
                    //"that move (moving = "//text(problem%moving)//"); another method expected")
         return
      end if
      select case (name)
      case ("bs5")
         allocate (explicit)
         call explicit%set_up(problem, bogacki_shampine(), lacking)
      case ("dop853")
         allocate (explicit)
         call explicit%set_up(problem, dop853(), lacking)
      case ("taylor")
         allocate (taylor)
         call taylor%set_up(problem, tolerance%level, lacking)
      case ("radau5", "radau9", "radau13")
         allocate (implicit)
         call implicit%set_up(problem, stages_of(name), tolerance%level, lacking)
      case default
         names = trim(methods(1))
         do i = 2, size(methods)
            names = names//", "//trim(methods(i))
         end do
         call raise(error, "integrate: method = '"//trim(name)//"'; one of "//names//" expected")
         return
      end select
      if (lacking > 0.0_wp) return
      if (allocated(explicit)) call move_alloc(explicit, step)
      if (allocated(implicit)) call move_alloc(implicit, step)
      if (allocated(taylor)) call move_alloc(taylor, step)
      step%constants%name = name
   end subroutine choose_method

   !> The method with which `auto` begins: the implicit one in place of an explicit pair, if the
   !> problem has delays and gives a Jacobian that says so and is not large.
   pure function first_method(problem, tolerance, origin) result(method)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      !> Initial time
      real(wp), intent(in) :: origin
      character(len=8) :: method
      real(wp), allocatable :: by_y(:, :), by_z(:, :), y(:), z(:)
      integer :: height, j, k, main

      method = matching_method(problem, tolerance, origin, implicit=.false.)
      associate (n => problem%n, lag => problem%lag)
         height = n
         if (problem%lower >= 0) height = min(n, 1 + problem%lower + problem%upper)
         if (method == "taylor" .or. size(lag) == 0 .or. problem%moving > 0) return
         if (real(n, wp)*(height + size(lag)) > small) return
         allocate (by_y(height, n), by_z(n, size(lag)), y(n), z(size(lag)))
         call problem%initial(y)
         z = [(problem%history(origin - lag(k), problem%component(k)), k=1, size(lag))]
         call problem%jacobian(origin, y, z, by_y, by_z)
         if (all(by_y <= not_given)) return
         ! elements of the diagonal do not depend on units of the components
         do j = 1, n
            main = merge(j, 1 + problem%upper, height == n)
            if (-by_y(main, j)*problem%shortest_lag() < least_decays) cycle
            method = implicit_method(tolerance%level)
            return
         end do
      end associate
   end function first_method

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
         method = implicit_method(tolerance%level)
      else if (problem%analytic .and. problem%moving == 0) then
         if (2*size(problem%lag) >= problem%n .and. tolerance%level >= least_of_many) then
            allocate (y(problem%n))
            call problem%initial(y)
            if (problem%relaxation_rate(origin, y) < least_balance/problem%shortest_lag()) return
         end if
         method = "taylor"
      end if
   end function matching_method

   !> The explicit pair of a tolerance.
   pure function explicit_method(tolerance) result(name)
      !> Level of the tolerance
      real(wp), intent(in) :: tolerance
      character(len=8) :: name

      name = merge("bs5     ", "dop853  ", tolerance >= least_of_bs5)
   end function explicit_method

   !> The Radau IIA method of a tolerance.
   pure function implicit_method(tolerance) result(name)
      !> Level of the tolerance
      real(wp), intent(in) :: tolerance
      character(len=8) :: name

      name = "radau9"
      if (tolerance >= least_of_radau5) name = "radau5"
      if (tolerance < least_of_radau9) name = "radau13"
   end function implicit_method

   !> Stages of a Radau IIA method.
   pure integer function stages_of(name) result(stages)
      character(len=8), intent(in) :: name

      stages = findloc([character(len=8) :: "radau5", "radau9", "radau13"], name, dim=1)
      stages = 1 + 2*stages
   end function stages_of

   !> Work of a short trial of the implicit method without its linear systems, in evaluations of the
   !> explicit pair: one Jacobian by differences, and the steps.
   pure real(wp) function price_of_trial(problem, tolerance) result(price)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      integer :: columns

      columns = problem%n
      if (problem%lower >= 0) columns = min(problem%n, 1 + problem%lower + problem%upper)
      associate (stages => stages_of(implicit_method(tolerance%level)))
         price = implicit_cost*(columns + least_trial*(usual_iterations*stages + 2))
      end associate
   end function price_of_trial
end module dde_methods
