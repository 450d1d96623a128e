!> One scene without samples in a process of its own (long_runs.py). Reads the scene and the
!> tolerance; prints CPU seconds, steps and the most memory that the process has held, in kB.
program long_run
   use block_parameters, only: block_history_type, block_parameters_type
   use dde, only: integrate, integration_options, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use spring_block, only: spring_block_type
   implicit none (type, external)
   !> Short runs are repeated for this time, in seconds.
   real(wp), parameter :: least_seconds = 0.1_wp
   character(len=1024) :: message
   integer :: runs, status
   real(wp) :: finish, scene(9), start, tolerance
   type(error_type), allocatable :: error
   type(integration_options) :: options
   type(integration_result) :: outcome
   type(spring_block_type) :: block_model

   read (*, *, iostat=status, iomsg=message) scene, tolerance
   if (status /= 0) error stop "long_run: "//trim(message)
   options = integration_options(relative=tolerance, absolute=tolerance)
   block_model = spring_block_type( &
                 block_parameters_type(tau=scene(1), epsilon=scene(2), xi=scene(3), &
                                       gamma=scene(4)), &
                 block_history_type(theta=scene(5), u=scene(6), v=exp(scene(7))))
   call cpu_time(start)
   do runs = 1, 1000
      call integrate(block_model, 0.0_wp, scene(8), options, outcome, error)
      if (allocated(error)) error stop "long_run: "//error%message
      call cpu_time(finish)
      if (finish - start >= least_seconds) exit
   end do
   print "(es12.5, 2(1x, i0))", (finish - start)/runs, outcome%accepted, peak_memory()

contains

   !> The mark that Linux keeps of this process, in kB.
   integer function peak_memory() result(kilobytes)
      character(len=80) :: line
      integer :: unit

      open (newunit=unit, file="/proc/self/status", action="read", status="old", iostat=status, &
            iomsg=message)
      do while (status == 0)
         read (unit, "(a)", iostat=status, iomsg=message) line
         if (line(:6) == "VmHWM:") exit
      end do
      if (status == 0) read (line(7:), *, iostat=status, iomsg=message) kilobytes
      if (status /= 0) error stop "long_run: /proc/self/status: "//trim(message)
      close (unit)
   end function peak_memory
end program long_run
