!> A velocity step and the friction law it tries, from the namelist group &velocity_step.
module velocity_step_input
   use dde_errors, only: error_type
   use velocity_step_friction, only: friction_parameters_type
   use dde_kinds, only: wp
   use namelist_input, only: close_namelist, not_given, open_namelist
   use velocity_step, only: step_protocol_type
   use solver_checks, only: check_tolerance
   use value_checks, only: check_count, check_number
   implicit none (type, external)
   private
   public :: read_protocol

contains

   !> Read and check a protocol.
   subroutine read_protocol(path, protocol, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The protocol
      type(step_protocol_type), intent(out) :: protocol
      !> Error if the file cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error

      call read_group(path, protocol, error)
      associate (law => protocol%law)
         call check_number(error, path, "mu0", law%mu0, at_least=0.0_wp)
         call check_number(error, path, "a", law%a, at_least=0.0_wp)
         call check_number(error, path, "b", law%b, at_least=0.0_wp)
         call check_number(error, path, "dc", law%dc, above=0.0_wp)
         call check_number(error, path, "v0", law%v0, above=0.0_wp)
         call check_number(error, path, "b_state", law%b_state, above=0.0_wp)
      end associate
      call check_number(error, path, "delta_v", protocol%delta_v, above=0.0_wp)
      call check_number(error, path, "slip_before", protocol%slip_before, above=0.0_wp)
      call check_number(error, path, "slip_after", protocol%slip_after, above=0.0_wp)
      call check_count(error, path, "samples", protocol%samples, at_least=2)
      call check_tolerance(error, path, "tolerance", protocol%tolerance)
   end subroutine read_protocol

   !> Read the group &velocity_step.
   subroutine read_group(path, protocol, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The protocol
      type(step_protocol_type), intent(out) :: protocol
      !> Error if the file cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=256) :: reason
      real(wp) :: mu0, a, b, dc, v0, b_state, delta_v, slip_before, slip_after, tolerance
      integer :: samples, status, unit
      namelist /velocity_step/ mu0, a, b, dc, v0, b_state, delta_v, slip_before, slip_after, &
         samples, tolerance

      mu0 = not_given()
      a = mu0
      b = mu0
      dc = mu0
      v0 = mu0
      b_state = mu0
      delta_v = mu0
      slip_before = mu0
      slip_after = mu0
      tolerance = mu0
      samples = 0
      call open_namelist(path, "velocity_step", unit, error)
      if (allocated(error)) return
      read (unit, nml=velocity_step, iostat=status, iomsg=reason)
      call close_namelist(path, "velocity_step", unit, status, reason, error)
      protocol = step_protocol_type( &
                 friction_parameters_type(mu0=mu0, a=a, b=b, dc=dc, v0=v0, b_state=b_state), &
                 delta_v=delta_v, slip_before=slip_before, slip_after=slip_after, &
                 samples=samples, tolerance=tolerance)
   end subroutine read_group
end module velocity_step_input
