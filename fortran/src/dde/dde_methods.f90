!> The methods: how each begins, follows another, and how long its steps may be.
module dde_methods
   use dde_explicit_step, only: explicit_step_type
   use dde_implicit_step, only: implicit_step_type
   use dde_problem, only: dde_problem_type
   use dde_request, only: integration_options
   use dde_step, only: step_type
   use dde_taylor_step, only: taylor_step_type
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: change_method, choose_method, longest_step, matching_method

   !> Tolerances from which on, and below which, `auto` takes another order than 9: fewer stages
   !> cost less where little is asked, more where much is.
   real(wp), parameter :: loose = 3.0e-5_wp, tight = 1.0e-11_wp

contains

   !> A step of the method asked for; `auto` begins with an explicit one.
   subroutine choose_method(problem, method, options, step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Name of the method
      character(len=8), intent(in) :: method
      !> Tolerances
      type(integration_options), intent(in) :: options
      !> Its step
      class(step_type), allocatable, intent(out) :: step

      select case (merge(matching_method(problem, options, implicit=.false.), method, &
                         method == "auto"))
      case ("radau5")
         allocate (step, source=implicit_step_type(problem, 3))
      case ("radau9")
         allocate (step, source=implicit_step_type(problem, 5))
      case ("radau13")
         allocate (step, source=implicit_step_type(problem, 7))
      case ("taylor")
         allocate (step, source=taylor_step_type(problem, max(options%relative, options%absolute)))
      case default
         allocate (step, source=explicit_step_type(problem))
      end select
   end subroutine choose_method

   !> The explicit or the implicit method of `auto`.
   pure function matching_method(problem, options, implicit) result(method)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerances
      type(integration_options), intent(in) :: options
      !> Which of the two
      logical, intent(in) :: implicit
      character(len=8) :: method

      if (.not. implicit) then
         method = merge("taylor  ", "explicit", problem%analytic)
         return
      end if
      associate (tolerance => max(options%relative, options%absolute))
         method = "radau9"
         if (tolerance >= loose) method = "radau5"
         if (tolerance < tight) method = "radau13"
      end associate
   end function matching_method

   !> The other method takes over where the step stands.
   subroutine change_method(problem, options, step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Tolerances
      type(integration_options), intent(in) :: options
      !> The step, advanced; replaced by one of the other method
      class(step_type), allocatable, intent(inout) :: step
      class(step_type), allocatable :: other

      call choose_method(problem, matching_method(problem, options, .not. step%implicit), options, &
                         other)
      other%y = step%y
      other%slope = step%slope_here()
      other%evaluations = step%evaluations
      other%factorised_before = step%factorisations()
      call move_alloc(other, step)
   end subroutine change_method

   !> The longest step allowed: an explicit one ends before its delayed values lie in it.
   pure function longest_step(problem, step, options) result(longest)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step
      class(step_type), intent(in) :: step
      !> Limits
      type(integration_options), intent(in) :: options
      real(wp) :: longest

      longest = options%longest_step
      if (.not. step%implicit) longest = minval([longest, problem%lag])
   end function longest_step
end module dde_methods
