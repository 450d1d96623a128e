!> The four parameters of the block and its history before t = 0, with the ranges in which the
!> equations have a meaning. All quantities are nondimensional; the defaults are steady sliding.
module block_parameters
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use value_checks, only: check_number
   implicit none (type, external)
   private
   public :: block_history_type, block_parameters_type, check_quantity

   !> Parameters of the block.
   type :: block_parameters_type
      !> Delay of the friction
      real(wp) :: tau = 0.0_wp
      !> Sensitivity of the velocity relaxation, (B - A)/A
      real(wp) :: epsilon = 0.0_wp
      !> Spring constant, k L/A
      real(wp) :: xi = 1.0_wp
      !> Frequency, sqrt(k/M) L/v0
      real(wp) :: gamma = 1.0_wp
   contains
      !> Refuse a parameter out of range
      procedure :: check => check_parameters
   end type block_parameters_type

   !> Constant values for t <= 0.
   type :: block_history_type
      !> Friction state
      real(wp) :: theta = 0.0_wp
      !> Displacement
      real(wp) :: u = 0.0_wp
      !> Velocity
      real(wp) :: v = 1.0_wp
   end type block_history_type

contains

   !> Refuse a parameter out of range; keep an earlier error.
   pure subroutine check_parameters(self, place, error)
      !> The parameters
      class(block_parameters_type), intent(in) :: self
      !> File and what it describes, for the message
      character(len=*), intent(in) :: place
      !> First error met
      type(error_type), allocatable, intent(inout) :: error

      call check_quantity(error, place, "tau", self%tau)
      call check_quantity(error, place, "epsilon", self%epsilon)
      call check_quantity(error, place, "xi", self%xi)
      call check_quantity(error, place, "gamma", self%gamma)
   end subroutine check_parameters

   !> Refuse a value of a parameter or of the history out of range; keep an earlier error.
   pure subroutine check_quantity(error, place, quantity, value, key)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> File and what it describes, for the message
      character(len=*), intent(in) :: place
      !> Name of its component
      character(len=*), intent(in) :: quantity
      !> Value of the component
      real(wp), intent(in) :: value
      !> Key for the message, where it is not that name
      character(len=*), intent(in), optional :: key
      character(len=:), allocatable :: shown

      shown = quantity
      if (present(key)) shown = key
      select case (quantity)
      case ("tau")
         call check_number(error, place, shown, value, at_least=0.0_wp)
      case ("epsilon")
         call check_number(error, place, shown, value, above=-1.0_wp)
      case ("xi", "gamma", "v")
         call check_number(error, place, shown, value, above=0.0_wp)
      case default
         call check_number(error, place, shown, value)
      end select
   end subroutine check_quantity
end module block_parameters
