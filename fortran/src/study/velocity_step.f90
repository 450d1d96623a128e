!> Response of friction to steps of the imposed velocity (Figure 8): (1.2) integrated through three
!> phases, v0, v0 + delta v and v0 again, with (1.1) along the way.
module velocity_step
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type
   use velocity_step_friction, only: friction_coefficient, friction_parameters_type, &
                                     state_evolution_type, steady_state
   use dde_kinds, only: wp
   use value_checks, only: missing, missing_count
   implicit none (type, external)
   private
   public :: friction_response_type, respond, step_protocol_type

   !> What is imposed; its namelist must give all of it.
   type :: step_protocol_type
      !> The law, SI units
      type(friction_parameters_type) :: law
      !> Velocity step, m/s
      real(wp) :: delta_v = missing
      !> Slip in the first phase and in each of the others, in units of Dc
      real(wp) :: slip_before = missing, slip_after = missing
      !> Samples in each phase
      integer :: samples = missing_count
      !> Relative tolerance of the integration
      real(wp) :: tolerance = missing
   end type step_protocol_type

   !> The response; all arrays of shape (3 samples), the ends of two phases at the same slip.
   type :: friction_response_type
      !> Time, s
      real(wp), allocatable :: time(:)
      !> Slip, m
      real(wp), allocatable :: slip(:)
      !> Imposed velocity, m/s
      real(wp), allocatable :: velocity(:)
      !> State, s
      real(wp), allocatable :: theta(:)
      !> Friction coefficient
      real(wp), allocatable :: mu(:)
   end type friction_response_type

contains

   !> Impose the steps on a block that slides steadily.
   subroutine respond(protocol, response, error)
      !> What is imposed
      type(step_protocol_type), intent(in) :: protocol
      !> The response
      type(friction_response_type), intent(out) :: response
      !> The integration failed
      type(error_type), allocatable, intent(out) :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(table_sampler) :: table
      real(wp), allocatable :: time(:)
      real(wp) :: duration, slip, slip_start, theta, time_start, v
      integer :: i, phase

      allocate (response%time(0), response%slip(0), response%velocity(0), response%theta(0), &
                response%mu(0))
      time_start = 0.0_wp
      slip_start = 0.0_wp
      theta = steady_state(protocol%law, protocol%law%v0)
      do phase = 1, 3
         v = protocol%law%v0
         slip = protocol%slip_after*protocol%law%dc
         if (phase == 1) slip = protocol%slip_before*protocol%law%dc
         if (phase == 2) v = v + protocol%delta_v
         duration = slip/v
         time = [(duration*i/(protocol%samples - 1), i=0, protocol%samples - 1)]
         time(protocol%samples) = duration
         table = table_sampler([1], time)
         options%relative = protocol%tolerance
         options%absolute = protocol%tolerance*theta
         call integrate(state_evolution_type(protocol%law, v, theta), 0.0_wp, duration, options, &
                        outcome, error, table)
         if (allocated(error)) return
         response%time = [response%time, time_start + time]
         response%slip = [response%slip, slip_start + v*time]
         response%velocity = [response%velocity, (v, i=1, protocol%samples)]
         response%theta = [response%theta, table%values(1, :)]
         response%mu = [response%mu, friction_coefficient(protocol%law, v, table%values(1, :))]
         time_start = time_start + duration
         slip_start = slip_start + slip
         theta = outcome%y(1)
      end do
   end subroutine respond
end module velocity_step
