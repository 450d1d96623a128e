! SPDX-License-Identifier: BSD-3-Clause
!> One run of many cells or delays (sizes.py). Arguments: numbers of equations and delays, the
!> longest delay less the shortest, what the problem gives besides f, the method, the end of the
!> run, and most steps. If the method is `f`, f is evaluated as often. Prints accepted steps, all
!> steps, evaluations, seconds of CPU time, and the most memory of the process in MB.
program sizes_worker
   use dde, only: integrate, integration_options, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use dde_outcome, only: too_many_steps
   use sizes_problem, only: cells, cells_with_jacobian
   implicit none (type, external)
   character(len=16) :: argument(7)
   class(cells), allocatable :: problem
   integer :: delays, i, n
   integer(int64) :: steps
   real(wp) :: finish, spread, start, t_end
   type(error_type), allocatable :: error
   type(integration_options) :: options
   type(integration_result) :: outcome

   do i = 1, size(argument)
      call get_command_argument(i, argument(i))
   end do
   read (argument(:3), *) n, delays, spread
   read (argument(6:), *) t_end, steps
   allocate (problem, source=cells())
   if (argument(4) == "jacobian") then
      deallocate (problem)
      allocate (problem, source=cells_with_jacobian())
   end if
   call problem%set_up(n, delays, spread)
   problem%analytic = argument(4) == "series"
   call cpu_time(start)
   if (argument(5) == "f") then
      call evaluate(int(steps), [(1.0_wp, i=1, n)], [(1.0_wp, i=1, delays)])
   else
      options = integration_options(method=argument(5) (:8), relative=1.0e-6_wp, &
                                    absolute=1.0e-6_wp, most_steps=steps)
      call integrate(problem, 0.0_wp, t_end, options, outcome, error)
      if (allocated(error) .and. outcome%reason /= too_many_steps) then
         error stop "sizes_worker: "//error%message
      end if
   end if
   call cpu_time(finish)
   print *, outcome%accepted, outcome%accepted + outcome%rejected, outcome%evaluations, &
      finish - start, peak()

contains

   !> The most memory that this process has held, in MB, as Linux tells it.
   real(wp) function peak() result(megabytes)
      character(len=80) :: line
      integer :: unit

      line = ""
      open (newunit=unit, file="/proc/self/status", action="read", status="old")
      do while (line(:6) /= "VmHWM:")
         read (unit, "(a)") line
      end do
      close (unit)
      read (line(7:index(line, "kB") - 1), *) megabytes
      megabytes = megabytes/1000.0_wp
   end function peak

   !> Evaluate f again and again.
   subroutine evaluate(times, state, z)
      integer, intent(in) :: times
      real(wp), intent(in) :: state(:), z(:)
      real(wp) :: slope(size(state)), y(size(state))
      integer :: i

      y = state
      do i = 1, times
         call problem%rhs(0.0_wp, y, z, slope)
         y = y + 1.0e-3_wp*slope
      end do
      if (.not. abs(sum(y)) < huge(y)) error stop "sizes_worker: f is not finite"
   end subroutine evaluate
end program sizes_worker
