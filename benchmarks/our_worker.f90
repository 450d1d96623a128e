!> One scene in the project's own solver, run as often as standard input asks (compare.py).
!> Its argument is the method.
program our_worker
   use, intrinsic :: iso_fortran_env, only: iostat_end
   use block_parameters, only: block_history_type, block_parameters_type
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u, spring_block_type
   use version, only: project_version
   implicit none (type, external)
   character(len=8) :: method
   character(len=1024) :: message, request
   integer :: i, last, runs, status
   real(wp) :: finish, scene(9), start, t_end, tolerance
   type(error_type), allocatable :: error
   type(integration_options) :: options
   type(integration_result) :: outcome
   type(spring_block_type) :: block_model
   type(table_sampler) :: samples

   call get_command_argument(1, method)
   read (*, *, iostat=status, iomsg=message) scene
   if (status /= 0) error stop "our_worker: scene: "//trim(message)
   block_model = spring_block_type( &
                 block_parameters_type(tau=scene(1), epsilon=scene(2), xi=scene(3), &
                                       gamma=scene(4)), &
                 block_history_type(theta=scene(5), u=scene(6), v=exp(scene(7))))
   t_end = scene(8)
   last = nint(t_end/scene(9))
   print "(a)", "answer: "//project_version

   do
      read (*, "(a)", iostat=status, iomsg=message) request
      if (status == iostat_end) exit
      if (status == 0) read (request, *, iostat=status, iomsg=message) tolerance, runs
      if (status /= 0) error stop "our_worker: request: "//trim(message)
      options = integration_options(method=method, relative=tolerance, absolute=tolerance)
      if (runs == 0) then
         samples = table_sampler([index_of_theta, index_of_u, index_of_ln_v], &
                                 [(min(i*scene(9), t_end), i=0, last)])
         call integrate(block_model, 0.0_wp, t_end, options, outcome, error, samples)
         call write_table(trim(request(index(request, " 0 ") + 3:)), samples)
      end if
      call cpu_time(start)
      do i = 1, runs
         call integrate(block_model, 0.0_wp, t_end, options, outcome, error)
         if (allocated(error)) exit
      end do
      call cpu_time(finish)
      if (allocated(error)) then
         print "(a)", "answer: 0 "//error%message
      else
         print "(a, es15.8, a)", "answer: ", (finish - start)/max(runs, 1), " ok"
      end if
      flush (6)
   end do

contains

   !> Write the samples, a row a time.
   subroutine write_table(file_path, table)
      character(len=*), intent(in) :: file_path
      type(table_sampler), intent(in) :: table
      integer :: row, unit

      open (newunit=unit, file=file_path, action="write", status="replace", iostat=status, &
            iomsg=message)
      if (status /= 0) error stop "our_worker: "//trim(message)
      do row = 1, table%received
         write (unit, "(*(es25.17e3, :, a))") table%time(row), achar(9), table%values(1, row), &
            achar(9), table%values(2, row), achar(9), table%values(3, row)
      end do
      close (unit, iostat=status, iomsg=message)
      if (status /= 0) error stop "our_worker: "//trim(message)
   end subroutine write_table
end program our_worker
