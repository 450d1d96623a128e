!> The parameters of the block, its law of friction, and its history before t = 0. The ranges are
!> those of the law's definition. All quantities are nondimensional; the defaults are steady sliding
!> by the paper's law.
module block_parameters
   use chain, only: chain_ends, ends_length => word_length
   use dde_errors, only: error_type, text
   use dde_kinds, only: wp
   use model_description, only: description_type, unbounded, word_length
   use model_library, only: list_models, open_model
   use model_problem, only: model_type
   use value_checks, only: absent, check_choice, check_count, check_number, missing
   implicit none (type, external)
   private
   public :: absent_history, block_history_type, block_parameters_type, chain_law, describe_law, &
             history_names, law_names, law_parameters, meaning_of, missing_history, &
             missing_parameters, paper_law, parameter_meanings, parameter_names, vector_of, &
             with_vector

   !> The law of equation (4).
   character(len=*), parameter :: paper_law = "slip_delayed_logarithm"
   !> What names of models of chains have before the law.
   character(len=*), parameter :: chain_prefix = "chain_"
   !> Most parameters that a law has beside the block's: a user's eight, and zeta.
   integer, parameter :: most_own = 9
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
      !> The law's own parameters by name; once checked in the order of its definition
      character(len=word_length) :: own_names(most_own) = ""
      real(wp) :: own(most_own) = 0.0_wp
      !> Number of blocks of a chain
      integer :: blocks = 1
      !> Spring constant between neighbours over that to the plate, k_c/k
      real(wp) :: kappa = 0.0_wp
      !> Ends of the chain
      character(len=ends_length) :: ends = "free"
   contains
      !> Whether there are several blocks
      procedure :: is_chain
      !> Names of all parameters in the order of their numbers
      procedure :: names => names_of_parameters
      !> Give a parameter a value by its name
      procedure :: put => put_parameter
      !> Put the law's own parameters in order, and refuse a parameter out of range
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

   !> All parameters by number: the block's, then the law's own.
   pure function vector_of(parameters) result(vector)
      !> Parameters by name
      class(block_parameters_type), intent(in) :: parameters
      real(wp) :: vector(size(parameter_names) + most_own)

      vector = [parameters%tau, parameters%epsilon, parameters%xi, parameters%gamma, parameters%own]
   end function vector_of

   !> Parameters of the same law with these values.
   pure type(block_parameters_type) function with_vector(parameters, vector) result(changed)
      !> The law; its own parameters as far as the vector has none
      type(block_parameters_type), intent(in) :: parameters
      !> Parameters by number, at least the block's
      real(wp), intent(in) :: vector(:)

      changed = parameters
      call set_vector(changed, vector)
   end function with_vector

   !> Give parameters their values by number.
   pure subroutine set_vector(parameters, vector)
      class(block_parameters_type), intent(inout) :: parameters
      real(wp), intent(in) :: vector(:)

      parameters%tau = vector(1)
      parameters%epsilon = vector(2)
      parameters%xi = vector(3)
      parameters%gamma = vector(4)
      parameters%own(:size(vector) - size(parameter_names)) = vector(size(parameter_names) + 1:)
   end subroutine set_vector

   !> Names of all parameters in the order of their numbers.
   pure function names_of_parameters(self) result(names)
      class(block_parameters_type), intent(in) :: self
      character(len=word_length), allocatable :: names(:)

      names = [character(len=word_length) :: parameter_names, &
               pack(self%own_names, self%own_names /= "")]
   end function names_of_parameters

   !> Give a parameter a value by its name, which `check` refuses if the law has none.
   pure subroutine put_parameter(self, name, value)
      class(block_parameters_type), intent(inout) :: self
      !> Name of the parameter; blank for none
      character(len=*), intent(in) :: name
      !> Its value
      real(wp), intent(in) :: value
      real(wp) :: vector(size(parameter_names) + most_own)
      integer :: number

      if (name == "") return
      number = findloc([character(len=word_length) :: parameter_names], name, dim=1)
      if (number == 0) then
         number = findloc(self%own_names, name, dim=1)
         if (number == 0) number = findloc(self%own_names, "", dim=1)
         if (number == 0) return
         self%own_names(number) = name
         number = number + size(parameter_names)
      end if
      vector = vector_of(self)
      vector(number) = value
      call set_vector(self, vector)
   end subroutine put_parameter

   !> All parameters in the order of the law's definition.
   function law_parameters(parameters, model) result(vector)
      !> Parameters by name
      type(block_parameters_type), intent(in) :: parameters
      !> The model of the law
      class(model_type), intent(in) :: model
      real(wp), allocatable :: vector(:)

      vector = vector_of(parameters)
      vector = vector(:model%sizes%parameters)
      if (model%is_chain()) vector(size(vector)) = parameters%kappa
   end function law_parameters

   !> Whether there are several blocks.
   pure logical function is_chain(self) result(value)
      class(block_parameters_type), intent(in) :: self

      value = self%blocks > 1
   end function is_chain

   !> Names of the laws that are compiled.
   function law_names() result(names)
      character(len=word_length), allocatable :: names(:)

      names = list_models("")
      names = pack(names, index(names, chain_prefix) /= 1)
   end function law_names

   !> What the definition of a law says.
   subroutine describe_law(law, description, error)
      !> Name of the law
      character(len=*), intent(in) :: law
      !> What it says
      type(description_type), intent(out) :: description
      !> Error if there is no law of this name
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model

      call open_model(trim(law), model, error)
      if (.not. allocated(error)) description = model%describe()
   end subroutine describe_law

   !> What the definition of a law says of one of its parameters.
   function meaning_of(law, name) result(meaning)
      !> Names of the law and of the parameter, which were checked
      character(len=*), intent(in) :: law, name
      character(len=:), allocatable :: meaning
      type(description_type) :: description
      type(error_type), allocatable :: error

      call describe_law(law, description, error)
      associate (known => description%parameters)
         meaning = trim(known(findloc(known%name, name, dim=1))%meaning)
      end associate
   end function meaning_of

   !> Put the law's own parameters in the order of its definition. Refuse a law that there is not,
   !> names that it has not, and parameters out of its ranges; keep an earlier error.
   subroutine check_parameters(self, place, error)
      class(block_parameters_type), intent(inout) :: self
      character(len=*), intent(in) :: place
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: lag(:), vector(:)
      type(model_type) :: model
      type(description_type) :: law
      integer :: i

      call check_choice(error, place, "law", self%law, law_names())
      if (.not. allocated(error)) call open_model(trim(self%law), model, error)
      if (allocated(error)) return
      law = model%describe()
      vector = vector_of(self)
      associate (names => law%parameters%name, first => size(parameter_names) + 1)
         if (any(self%own_names /= "")) vector(first:) = absent
         do i = 1, most_own
            if (self%own_names(i) == "") cycle
            call check_choice(error, place, "parameter of the law "//trim(self%law), &
                              self%own_names(i), names)
            if (allocated(error)) return
            vector(findloc(names, self%own_names(i), dim=1)) = self%own(i)
         end do
         call set_vector(self, vector)
         self%own_names = ""
         self%own_names(:size(names) - first + 1) = names(first:)
      end associate
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
      if (.not. allocated(error)) then
         lag = model%delays(vector(:size(law%parameters)))
         do i = 1, size(lag)
            call check_number(error, place//": law "//trim(self%law), "delay "//text(i), lag(i), &
                              at_least=0.0_wp)
         end do
      end if
      call check_chain(self, place, error)
   end subroutine check_parameters

   !> Refuse a chain that there is not; keep an earlier error.
   subroutine check_chain(self, place, error)
      class(block_parameters_type), intent(in) :: self
      character(len=*), intent(in) :: place
      type(error_type), allocatable, intent(inout) :: error

      call check_count(error, place, "blocks", self%blocks, at_least=1)
      call check_number(error, place, "kappa", self%kappa, at_least=0.0_wp)
      call check_choice(error, place, "ends", self%ends, chain_ends)
      if (allocated(error) .or. .not. self%is_chain()) return
      if (self%ends == "ring") then
         call check_count(error, place//": ends = ring: ", "blocks", self%blocks, at_least=3)
      end if
      call check_choice(error, place//": a chain", "law", self%law, list_models(chain_prefix))
   end subroutine check_chain

   !> The name of the model of a chain with a law.
   pure function chain_law(law) result(name)
      !> Name of the law
      character(len=*), intent(in) :: law
      character(len=:), allocatable :: name

      name = chain_prefix//trim(law)
   end function chain_law

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
