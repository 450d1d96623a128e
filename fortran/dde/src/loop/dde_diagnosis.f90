!> The cause of a run that could not continue.
module dde_diagnosis
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_outcome, only: step_underflow, too_many_steps, value_not_finite
   use dde_run, only: run_type
   use dde_errors, only: text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: find_culprit

contains

   !> Which value is not finite, or which tolerance cannot be met; empty if there is none.
   subroutine find_culprit(run, h, reason, words)
      !> The run at the start of the step
      class(run_type), intent(inout) :: run
      !> Length of the step
      real(wp), intent(in) :: h
      !> Why the run ended
      integer, intent(in) :: reason
      !> What is wrong, with its value
      character(len=:), allocatable, intent(out) :: words

      select case (reason)
      case (value_not_finite)
         call find_not_finite(run, h, words)
      case (step_underflow, too_many_steps)
         call find_below_rounding(run, h, words)
      case default
         words = ""
      end select
   end subroutine find_culprit

   !> Which component has a tolerance below the rounding error of a step of length `h` from here.
   subroutine find_below_rounding(run, h, words)
      class(run_type), intent(in) :: run
      real(wp), intent(in) :: h
      character(len=:), allocatable, intent(out) :: words
      real(wp), allocatable :: slope(:)
      real(wp) :: rounding, tolerance
      integer :: i

      words = ""
      slope = run%step%slope_here()
      do i = 1, size(slope)
         if (.not. ieee_is_finite(slope(i))) cycle
         rounding = epsilon(1.0_wp)*(abs(run%step%y(i)) + h*abs(slope(i)))
         tolerance = run%context%tolerance%of_component(i, run%step%y(i))
         if (tolerance >= rounding) cycle
         words = "the tolerance "//text(tolerance)//" of y("//text(i)//") = " &
                 //text(run%step%y(i))//" is below its rounding error "//text(rounding) &
                 //"; a larger one expected"
         return
      end do
   end subroutine find_below_rounding

   !> Which value is not finite in a step of length `h` from here.
   subroutine find_not_finite(run, h, words)
      class(run_type), intent(inout) :: run
      real(wp), intent(in) :: h
      character(len=:), allocatable, intent(out) :: words
      real(wp), allocatable :: slope(:), y(:), z(:, :)
      integer :: i, place
      real(wp) :: t

      y = run%step%y
      call run%context%go_to(run%now, h)
      associate (problem => run%context%problem, cursor => run%context%cursor)
         allocate (z(size(problem%lag), 2), slope(problem%n))
         call run%context%delayed_values([0.0_wp, h], z)
         do place = 1, 2
            t = run%now%hi + (place - 1)*h
            do i = 1, size(problem%lag)
               if (ieee_is_finite(z(i, place))) cycle
               words = "component "//text(problem%component(i))//" is "//text(z(i, place)) &
                       //" at t = "//text(t - problem%lag(i))
               if (cursor%before_origin(i)) words = "the history of "//words
               return
            end do
            call problem%rhs(cursor%inside(t), y, z(:, place), slope)
            do i = 1, problem%n
               if (ieee_is_finite(slope(i))) cycle
               words = "f("//text(i)//") is "//text(slope(i))//" at t = "//text(t)//", where y(" &
                       //text(i)//") = "//text(y(i))
               return
            end do
            y = y + h*slope
         end do
      end associate
      words = "f at a stage of the step"
   end subroutine find_not_finite
end module dde_diagnosis
