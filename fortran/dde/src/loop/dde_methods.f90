!> The methods: how a step of each is made, how one follows another, and how long steps may be.
module dde_methods
   use dde_explicit_step, only: explicit_step_type
   use dde_implicit_step, only: implicit_cost, implicit_step_type
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use dde_systems, only: complex_over_real, factor_operations
   use dde_taylor_step, only: taylor_step_type
   use dde_tolerance, only: tolerance_type
   use dde_work, only: operations_of_evaluation
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: change_method, choose_method, limiting_delay, longest_step, matching_method
   public :: price_of_try

   !> Tolerances from which on, and below which, `auto` takes another order than 9: fewer stages
   !> cost less where little is asked, more where much is.
   real(wp), parameter :: loose = 3.0e-5_wp, tight = 1.0e-11_wp
   !> Delayed values up to which an implicit step may be longer than the shortest delay: those that
   !> lie in the step itself are unknowns beside the stages.
   integer, parameter :: most_coupled = 64

   !> Iterations of a usual implicit step.
   integer, parameter :: usual_iterations = 3
   !> Steps of the implicit method after which a try of it may fail, in its usual length.
   real(wp), parameter :: steps_of_try = 4.0_wp

contains

   !> Work of a try of the implicit method that fails, in evaluations of the explicit pair.
   pure real(wp) function price_of_try(problem, tolerance) result(price)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      integer :: stages

      select case (matching_method(problem, tolerance, implicit=.true.))
      case ("radau5")
         stages = 3
      case ("radau9")
         stages = 5
      case default
         stages = 7
      end select
      price = steps_of_try*work_of_step(problem, stages)
   end function price_of_try

   !> Work of a step with a new Jacobian by differences, in evaluations of the explicit pair.
   pure real(wp) function work_of_step(problem, stages) result(work)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Number of stages
      integer, intent(in) :: stages
      integer :: columns
      real(wp) :: operations

      columns = problem%n
      if (problem%lower >= 0) columns = min(problem%n, 1 + problem%lower + problem%upper)
      ! one real system, and one complex one for each pair of stages
      operations = (1 + complex_over_real*(stages/2)) &
                   *(factor_operations(problem%n, problem%lower >= 0, problem%lower, &
                                       problem%upper) + usual_iterations*2.0_wp*problem%n*columns)
      work = implicit_cost*(usual_iterations*stages + 2 + columns) &
             + operations/(operations_of_evaluation*problem%n)
   end function work_of_step

   !> A step of the chosen method; `auto` begins with an explicit one.
   subroutine choose_method(problem, method, tolerance, step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Name of the method
      character(len=8), intent(in) :: method
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      !> Its step
      class(step_type), allocatable, intent(out) :: step

      select case (merge(matching_method(problem, tolerance, implicit=.false.), method, &
                         method == "auto"))
      case ("radau5")
         allocate (step, source=implicit_step_type(problem, 3))
      case ("radau9")
         allocate (step, source=implicit_step_type(problem, 5))
      case ("radau13")
         allocate (step, source=implicit_step_type(problem, 7))
      case ("taylor")
         allocate (step, source=taylor_step_type(problem, tolerance%level))
      case default
         allocate (step, source=explicit_step_type(problem))
      end select
   end subroutine choose_method

   !> The explicit or the implicit method of `auto`.
   pure function matching_method(problem, tolerance, implicit) result(method)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      !> Which of the two
      logical, intent(in) :: implicit
      character(len=8) :: method

      if (.not. implicit) then
         method = merge("taylor  ", "explicit", problem%analytic)
         return
      end if
      method = "radau9"
      if (tolerance%level >= loose) method = "radau5"
      if (tolerance%level < tight) method = "radau13"
   end function matching_method

   !> The other method takes over where the step stands.
   subroutine change_method(problem, tolerance, step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      !> The step, advanced; replaced by one of the other method
      class(step_type), allocatable, intent(inout) :: step
      class(step_type), allocatable :: other

      associate (implicit => .not. step%constants%implicit)
         call choose_method(problem, matching_method(problem, tolerance, implicit), tolerance, &
                            other)
      end associate
      other%y = step%y
      other%slope = step%slope_here()
      call move_alloc(other, step)
   end subroutine change_method

   !> The longest step allowed: an explicit one ends before its delayed values lie in it, and an
   !> implicit one where they are many.
   pure function longest_step(problem, step, of_all) result(longest)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step
      class(step_type), intent(in) :: step
      !> Longest step that is allowed for other reasons
      real(wp), intent(in) :: of_all
      real(wp) :: longest

      longest = of_all
      if (.not. step%constants%implicit .or. size(problem%lag) > most_coupled) then
         longest = min(longest, minval(problem%lag))
      end if
   end function longest_step

   !> The shortest delay, where implicit steps may be longer than it; else no delay is that long.
   pure real(wp) function limiting_delay(problem) result(delay)
      !> The problem
      class(dde_problem_type), intent(in) :: problem

      delay = huge(1.0_wp)
      if (size(problem%lag) <= most_coupled) delay = minval(problem%lag)
   end function limiting_delay
end module dde_methods
