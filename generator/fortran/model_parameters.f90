! SPDX-License-Identifier: BSD-3-Clause
!> What a compiled model is given: parameters, blocks or a network, a past, and what follows from
!> them: where delayed values stand, and on which sides its equations are.
module model_parameters
   use, intrinsic :: iso_c_binding, only: c_int
   use dde, only: problem_with_tangents
   use dde_kinds, only: wp
   use model_border, only: shape_type
   use model_chain, only: find_band, find_neighbours
   use model_code, only: code_type
   use model_description, only: description_of, description_type, sizes_type, word_length
   use model_network, only: count_lags, place_values
   implicit none (type, external)
   private
   public :: given_model_type

   !> A model: its parameters, and constant values up to the initial time.
   type, abstract, extends(problem_with_tangents) :: given_model_type
      !> The compiled procedures
      type(code_type) :: code
      !> Sizes of the definition
      type(sizes_type) :: sizes
      !> Parameters in the order of the definition: names, values, and bounds of values
      character(len=word_length), allocatable :: names(:)
      real(wp), allocatable :: numbers(:), above(:), at_least(:)
      !> These, and the sides of the switches
      real(wp), allocatable :: given(:)
      !> States up to the initial time, shape (n)
      real(wp), allocatable :: past(:)
      !> Place of each delayed state of the definition among the delayed values; 0: its delay is 0
      integer(c_int), allocatable :: place(:)
      !> Sizes, and the eigenvalue of disturbances of blocks that move alike
      type(shape_type) :: shape
      !> Neighbours of the blocks of a chain on both sides; 0: the plate, at rest. Of a network the
      !> first edge of each node, and where edges begin, see `model_network`. Empty for others
      integer(c_int), allocatable :: left(:), right(:)
      !> Parameters of the nodes and edges of a network
      real(wp), allocatable :: of_network(:)
      !> What is beyond the last block of a chain, see `chain_ends`
      character(len=word_length) :: ends = "free"
      !> Whether delays of 0 are delayed values, too
      logical :: keeps_delays = .false.
      !> Whether thresholds count in units of its motion; otherwise its numbers are of order 1
      logical :: own_units = .false.
   contains
      procedure :: describe, set, put, set_blocks, number_of, states, is_chain, is_network
      procedure :: initial, history, past_series, take_sides, delays
   end type given_model_type

contains

   !> What the definition says.
   function describe(self) result(description)
      class(given_model_type), intent(in) :: self
      type(description_type) :: description

      description = description_of(self%code%description)
   end function describe

   !> Delays of a block with these parameters, or of all nodes and edges of a network; some are 0.
   pure function delays(self, parameters) result(lag)
      class(given_model_type), intent(in) :: self
      !> Parameters, in the order of the definition
      real(wp), intent(in) :: parameters(:)
      real(wp), allocatable :: lag(:)
      integer(c_int) :: state(self%sizes%delayed)
      type(shape_type) :: shape

      if (self%is_network()) then
         shape%blocks = size(self%left) - 1
         allocate (lag(count_lags(self%sizes, shape%blocks, size(self%right))))
         call self%code%network_lags(shape, [parameters, self%of_network], self%left, &
                                     self%right, lag)
      else
         allocate (lag(self%sizes%delayed))
         call self%code%delayed(parameters, lag, state)
      end if
   end function delays

   !> Give a chain its blocks, before its parameters. Other models have as many as they have.
   pure subroutine set_blocks(self, blocks, ends)
      class(given_model_type), intent(inout) :: self
      !> Number of blocks; of other models the number they have
      integer, intent(inout) :: blocks
      !> What is beyond the ends of a chain
      character(len=*), intent(in) :: ends

      self%ends = ends
      if (size(self%sizes%couplings) > 0) then
         call find_neighbours(blocks, trim(ends), self%left, self%right)
      else if (self%is_network()) then
         blocks = size(self%left) - 1
      end if
   end subroutine set_blocks

   !> Give a model its parameters and its past. A delay of 0 is none unless it is kept. A chain has
   !> its neighbours before.
   pure subroutine set(self, parameters, past, keep_delays)
      class(given_model_type), intent(inout) :: self
      !> Parameters, in the order of the definition
      real(wp), intent(in) :: parameters(:)
      !> States up to the initial time
      real(wp), intent(in) :: past(:)
      !> Whether delays of 0 are delayed values, too; .false. unless given
      logical, intent(in), optional :: keep_delays

      self%keeps_delays = .false.
      if (present(keep_delays)) self%keeps_delays = keep_delays
      self%past = past
      call self%put(parameters)
   end subroutine set

   !> Give a model other parameters; it keeps its past, and is on the sides of it.
   pure subroutine put(self, parameters)
      class(given_model_type), intent(inout) :: self
      !> Parameters, in the order of the definition
      real(wp), intent(in) :: parameters(:)
      real(wp) :: values(self%sizes%switches)
      integer :: k

      self%n = size(self%past)
      self%analytic = associated(self%code%series)
      self%analytic_tangents = self%analytic
      self%numbers = parameters
      self%switches = self%sizes%switches
      self%acting = self%sizes%acting
      self%moving = self%sizes%moving
      self%given = [parameters, (0.0_wp, k=1, self%switches)]
      if (.not. allocated(self%left)) allocate (self%left(0), self%right(0))
      self%delayed_exponents = self%sizes%delayed_exponents > 0
      if (self%is_network()) then
         self%shape%blocks = size(self%left) - 1
         self%given = [self%given, self%of_network]
         call place_values(self%sizes, self%left, self%right, self%delays(parameters), &
                           self%keeps_delays, self%place, self%lag, self%component, self%rows, &
                           self%lower, self%upper)
      else
         call place_in_blocks(self)
      end if
      self%shape%n = self%n
      self%shape%values = size(self%lag)
      self%shape%upper = self%upper
      do k = 1, self%switches
         ! a side may depend on those before it
         call self%switching(0.0_wp, self%past, self%past(self%component), values)
         call self%take_sides(values > 0.0_wp)
      end do
   end subroutine put

   !> The delayed values of a block, or of all blocks of a chain.
   pure subroutine place_in_blocks(self)
      class(given_model_type), intent(inout) :: self
      integer(c_int) :: component(self%sizes%delayed)
      real(wp) :: lag(self%sizes%delayed)
      logical, allocatable :: kept(:)
      integer :: block, k, states

      call self%code%delayed(self%numbers, lag, component)
      kept = lag > 0.0_wp .or. self%keeps_delays
      self%place = merge([(count(kept(:k)), k=1, size(lag))], 0, kept)
      associate (blocks => self%shape%blocks)
         blocks = max(1, size(self%left))
         states = self%n/blocks
         self%component = [(pack(component, kept) + states*(block - 1), block=1, blocks)]
         self%lag = [(pack(lag, kept), block=1, blocks)]
         self%exponentials = self%sizes%exponentials*blocks
      end associate
      self%shape%delays = count(kept)
      if (self%is_chain()) then
         call find_band(self%left, self%right, self%sizes%couplings, states, self%shape%delays, &
                        self%shape%reach, self%lower, self%upper, self%rows)
      end if
   end subroutine place_in_blocks

   !> Number of a parameter by its name; 0 if there is none.
   pure integer function number_of(self, name) result(number)
      class(given_model_type), intent(in) :: self
      !> Name of the parameter
      character(len=*), intent(in) :: name

      number = findloc(self%names, name, dim=1)
   end function number_of

   !> Number of states of a block.
   pure integer function states(self) result(number)
      class(given_model_type), intent(in) :: self

      number = self%n/self%shape%blocks
   end function states

   !> Whether it has blocks with neighbours, even one block.
   pure logical function is_chain(self) result(value)
      class(given_model_type), intent(in) :: self

      value = allocated(self%left) .and. .not. self%is_network()
      if (value) value = size(self%left) > 0
   end function is_chain

   !> Whether it has nodes and edges.
   pure logical function is_network(self) result(value)
      class(given_model_type), intent(in) :: self

      value = allocated(self%sizes%needed)
   end function is_network

   !> The past holds up to the initial time.
   pure subroutine initial(self, y)
      class(given_model_type), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%past
   end subroutine initial

   !> A component up to the initial time.
   pure function history(self, t, component) result(value)
      class(given_model_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%past(component)
   end function history

   !> Its Taylor coefficients.
   pure subroutine past_series(self, t, component, unit, y)
      class(given_model_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp), intent(in) :: unit
      real(wp), intent(out) :: y(0:)

      y = 0.0_wp
      y(0) = self%past(component)
   end subroutine past_series

   !> Go to other sides.
   pure subroutine take_sides(self, above)
      class(given_model_type), intent(inout) :: self
      logical, intent(in) :: above(:)

      self%given(size(self%numbers) + 1:) = merge(1.0_wp, 0.0_wp, above)
   end subroutine take_sides
end module model_parameters
