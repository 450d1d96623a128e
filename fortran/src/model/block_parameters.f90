!> The four parameters of the block and its history before t = 0, with the ranges in which the
!> equations have a meaning. All quantities are nondimensional; the defaults are steady sliding.
module block_parameters
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use value_checks, only: absent, check_number, missing
   implicit none (type, external)
   private
   public :: absent_history, block_history_type, block_parameters_type, &
             check_quantity, history_names, missing_history, missing_parameters, &
             parameter_meanings, parameter_names, parameters_of, vector_of

   !> Names of the parameters, in the order of their numbers.
   character(len=*), parameter :: parameter_names(4) = ["tau    ", "epsilon", "xi     ", "gamma  "]
   !> Descriptions of the parameters, in the same order.
   character(len=*), parameter :: parameter_meanings(4) = [ &
                                  "delay                                 ", &
                                  "sensitivity of the velocity relaxation", &
                                  "spring constant                       ", &
                                  "frequency                             "]
   !> Names of the values for t <= 0, in the order of the components.
   character(len=*), parameter :: history_names(3) = ["theta", "u    ", "v    "]

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
   contains
      !> Refuse a value out of range
      procedure :: check => check_history
   end type block_history_type

   !> Parameters and a history that must be given.
   type(block_parameters_type), parameter :: &
      missing_parameters = block_parameters_type(missing, missing, missing, missing)
   type(block_history_type), parameter :: missing_history = &
                                          block_history_type(missing, missing, missing)
   !> A history beyond the last of a list.
   type(block_history_type), parameter :: absent_history = &
                                          block_history_type(absent, absent, absent)

contains

   !> Parameters by number.
   pure function vector_of(parameters) result(vector)
      !> Parameters by name
      class(block_parameters_type), intent(in) :: parameters
      real(wp) :: vector(size(parameter_names))

      vector = [parameters%tau, parameters%epsilon, parameters%xi, parameters%gamma]
   end function vector_of

   !> Parameters by name.
   pure type(block_parameters_type) function parameters_of(vector) result(parameters)
      !> Parameters in the order of `parameter_names`
      real(wp), intent(in) :: vector(:)

      parameters = block_parameters_type(tau=vector(1), epsilon=vector(2), xi=vector(3), &
                                         gamma=vector(4))
   end function parameters_of

   !> Refuse a parameter out of range; keep an earlier error.
   pure subroutine check_parameters(self, place, error)
      class(block_parameters_type), intent(in) :: self
      character(len=*), intent(in) :: place
      type(error_type), allocatable, intent(inout) :: error
      real(wp) :: vector(size(parameter_names))
      integer :: i

      vector = vector_of(self)
      do i = 1, size(vector)
         call check_quantity(error, place, trim(parameter_names(i)), vector(i))
      end do
   end subroutine check_parameters

   !> Refuse a value of the history out of range; keep an earlier error.
   pure subroutine check_history(self, place, error)
      class(block_history_type), intent(in) :: self
      character(len=*), intent(in) :: place
      type(error_type), allocatable, intent(inout) :: error
      real(wp) :: values(size(history_names))
      integer :: i

      values = [self%theta, self%u, self%v]
      do i = 1, size(values)
         call check_quantity(error, place, trim(history_names(i)), values(i))
      end do
   end subroutine check_history

   !> Refuse a value of a parameter or of the history out of range; keep an earlier error.
   pure subroutine check_quantity(error, place, quantity, value, key)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> File and what it describes, for the message; name of its component
      character(len=*), intent(in) :: place, quantity
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
