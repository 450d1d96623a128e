!> The parameters of the block, its law of friction, and its history before t = 0. The ranges are
!> those of the law's definition. All quantities are nondimensional; the defaults are steady sliding
!> by the paper's law.
module block_parameters
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_problem, only: description_type, model_type, unbounded, word_length
   use model_registry, only: make_model, model_names
   use value_checks, only: absent, check_choice, check_number, missing
   implicit none (type, external)
   private
   public :: absent_history, block_history_type, block_parameters_type, describe_law, &
             history_names, law_parameters, missing_history, missing_parameters, &
             most_own, paper_law, parameter_meanings, parameter_names, with_vector, vector_of

   !> The law of equation (4).
   character(len=*), parameter :: paper_law = "slip_delayed_logarithm"
   !> Most parameters that a law has beside the block's.
   integer, parameter :: most_own = 8
   !> Names of the block's parameters, the first of every law, in the order of their numbers.
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
      !> Name of the law of friction
      character(len=word_length) :: law = paper_law
      !> The law's own parameters, in the order of its definition
      real(wp) :: own(most_own) = 0.0_wp
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
      missing_parameters = block_parameters_type(missing, missing, missing, missing, law="", &
                                                 own=absent)
   type(block_history_type), parameter :: missing_history = &
                                          block_history_type(missing, missing, missing)
   !> A history beyond the last of a list.
   type(block_history_type), parameter :: absent_history = &
                                          block_history_type(absent, absent, absent)

contains

   !> The block's parameters by number.
   pure function vector_of(parameters) result(vector)
      !> Parameters by name
      class(block_parameters_type), intent(in) :: parameters
      real(wp) :: vector(size(parameter_names))

      vector = [parameters%tau, parameters%epsilon, parameters%xi, parameters%gamma]
   end function vector_of

   !> Parameters of the same law with these values.
   pure type(block_parameters_type) function with_vector(parameters, vector) result(changed)
      !> The law and its own parameters
      type(block_parameters_type), intent(in) :: parameters
      !> The block's parameters in the order of `parameter_names`
      real(wp), intent(in) :: vector(:)

      changed = parameters
      changed%tau = vector(1)
      changed%epsilon = vector(2)
      changed%xi = vector(3)
      changed%gamma = vector(4)
   end function with_vector

   !> All parameters in the order of the law's definition.
   function law_parameters(parameters, model) result(vector)
      !> Parameters by name
      type(block_parameters_type), intent(in) :: parameters
      !> The model of the law
      class(model_type), intent(in) :: model
      real(wp), allocatable :: vector(:)
      type(description_type) :: law

      law = model%describe()
      vector = [vector_of(parameters), parameters%own]
      vector = vector(:size(law%parameters))
   end function law_parameters

   !> What the definition of a law says.
   subroutine describe_law(law, description)
      !> Name of a law that there is
      character(len=*), intent(in) :: law
      !> What it says
      type(description_type), intent(out) :: description
      class(model_type), allocatable :: model

      call make_model(trim(law), model)
      description = model%describe()
   end subroutine describe_law

   !> Refuse a law that there is not, and parameters out of its ranges; keep an earlier error.
   subroutine check_parameters(self, place, error)
      class(block_parameters_type), intent(in) :: self
      character(len=*), intent(in) :: place
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: vector(:)
      type(description_type) :: law
      integer :: i

      call check_choice(error, place, "law", self%law, model_names)
      if (allocated(error)) return
      call describe_law(self%law, law)
      vector = [vector_of(self), self%own]
      do i = 1, size(law%parameters)
         associate (one => law%parameters(i))
            if (one%at_least > unbounded) then
               call check_number(error, place, trim(one%name), vector(i), at_least=one%at_least)
            else if (one%above > unbounded) then
               call check_number(error, place, trim(one%name), vector(i), above=one%above)
            else
               call check_number(error, place, trim(one%name), vector(i))
            end if
         end associate
      end do
   end subroutine check_parameters

   !> Refuse a value of the history out of range; keep an earlier error.
   pure subroutine check_history(self, place, error)
      class(block_history_type), intent(in) :: self
      character(len=*), intent(in) :: place
      type(error_type), allocatable, intent(inout) :: error

      call check_number(error, place, trim(history_names(1)), self%theta)
      call check_number(error, place, trim(history_names(2)), self%u)
      call check_number(error, place, trim(history_names(3)), self%v, above=0.0_wp)
   end subroutine check_history
end module block_parameters
