!> The cause of a run that could not continue.
module dde_diagnosis
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_cursor, only: cursor_type
   use dde_history, only: history_type
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use dde_time, only: instant
   use dde_errors, only: text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: not_finite

contains

   !> Which value is not finite in a step of length `h` from here.
   function not_finite(problem, step, past, cursor, now, h) result(words)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The step
      class(step_type), intent(in) :: step
      !> The past
      type(history_type), intent(in) :: past
      !> A cursor in it
      type(cursor_type), intent(inout) :: cursor
      !> Start of the step
      type(instant), intent(in) :: now
      !> Length of the step
      real(wp), intent(in) :: h
      character(len=:), allocatable :: words
      real(wp), allocatable :: slope(:), y(:), z(:, :)
      integer :: i, place
      real(wp) :: t

      allocate (z(size(problem%lag), 2), slope(problem%n))
      y = step%y
      call cursor%set(problem, past, now, h)
      call cursor%values(problem, past, [0.0_wp, h], z)
      do place = 1, 2
         t = now%hi + (place - 1)*h
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
      words = "f at a stage of the step"
   end function not_finite
end module dde_diagnosis
