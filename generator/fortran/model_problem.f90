! SPDX-License-Identifier: BSD-3-Clause
!> A model whose equations were made from a definition and compiled (generator/README.md): a problem
!> of the solver, its derivatives of any order at the steady state, and its characteristic function.
!> `open_model` (model_library) fills it with the procedures of a shared object.
module model_problem
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: not_given, problem_with_tangents
   use dde_kinds, only: wp
   use model_border, only: shape_type
   use model_chain, only: blocks_in_order, find_band, find_neighbours
   use model_code, only: code_type
   use model_description, only: description_of, description_type, sizes_type, word_length
   use model_network, only: count_lags, place_values
   implicit none (type, external)
   private
   public :: model_type

   !> A model: its parameters, and constant values up to the initial time.
   type, extends(problem_with_tangents) :: model_type
      !> The compiled procedures
      type(code_type) :: code
      !> Sizes of the definition
      type(sizes_type) :: sizes
      !> Parameters in the order of the definition: names, values, and bounds of values
      character(len=word_length), allocatable :: names(:)
      real(wp), allocatable :: numbers(:), above(:), at_least(:)
      !> These, and the sides of the switches
      real(wp), allocatable, private :: given(:)
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
      procedure :: initial, history, past_series, rhs, jacobian, exponents, switching, take_sides
      procedure :: act, name_of, series, tangent_series, relaxation_rate, slow_series
      procedure :: slow_tangent_series, moving_lags
      procedure :: delays, steady_state, derivative, characteristic_terms
   end type model_type

contains

   !> What the definition says.
   function describe(self) result(description)
      class(model_type), intent(in) :: self
      type(description_type) :: description

      description = description_of(self%code%description)
   end function describe

   !> Delays of a block with these parameters, or of all nodes and edges of a network; some are 0.
   pure function delays(self, parameters) result(lag)
      class(model_type), intent(in) :: self
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
      class(model_type), intent(inout) :: self
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
      class(model_type), intent(inout) :: self
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
      class(model_type), intent(inout) :: self
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
      type(model_type), intent(inout) :: self
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
      class(model_type), intent(in) :: self
      !> Name of the parameter
      character(len=*), intent(in) :: name

      number = findloc(self%names, name, dim=1)
   end function number_of

   !> Number of states of a block.
   pure integer function states(self) result(number)
      class(model_type), intent(in) :: self

      number = self%n/self%shape%blocks
   end function states

   !> Whether it has blocks with neighbours, even one block.
   pure logical function is_chain(self) result(value)
      class(model_type), intent(in) :: self

      value = allocated(self%left) .and. .not. self%is_network()
      if (value) value = size(self%left) > 0
   end function is_chain

   !> Whether it has nodes and edges.
   pure logical function is_network(self) result(value)
      class(model_type), intent(in) :: self

      value = allocated(self%sizes%needed)
   end function is_network

   !> The past holds up to the initial time.
   pure subroutine initial(self, y)
      class(model_type), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%past
   end subroutine initial

   !> A component up to the initial time.
   pure function history(self, t, component) result(value)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%past(component)
   end function history

   !> Its Taylor coefficients.
   pure subroutine past_series(self, t, component, unit, y)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp), intent(in) :: unit
      real(wp), intent(out) :: y(0:)

      y = 0.0_wp
      y(0) = self%past(component)
   end subroutine past_series

   !> Delays that depend on time or states.
   pure subroutine moving_lags(self, t, y, lag)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp), intent(out) :: lag(self%moving)

      call self%code%moving_lags(self%shape, self%numbers, t, y, lag)
   end subroutine moving_lags

   !> The equations.
   pure subroutine rhs(self, t, y, z, dydt)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      call self%code%rhs(self%shape, self%given, self%place, self%left, self%right, &
                         t, y, z, dydt)
   end subroutine rhs

   !> Their derivatives by states and delayed values, if the object has them.
   pure subroutine jacobian(self, t, y, z, by_y, by_z)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)

      if (associated(self%code%jacobian)) then
         call self%code%jacobian(self%shape, self%given, self%place, self%left, self%right, &
                                 t, y, z, size(by_y, 1), size(by_z, 1), by_y, by_z)
      else
         by_y = not_given
         by_z = not_given
      end if
   end subroutine jacobian

   !> Exponents of their exponential terms.
   pure subroutine exponents(self, t, y, z, values)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: values(self%exponentials)

      call self%code%exponents(self%shape, self%given, self%place, self%left, self%right, &
                               t, y, z, values)
   end subroutine exponents

   !> What is 0 where the equations are not smooth.
   pure subroutine switching(self, t, y, z, values)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: values(self%switches)

      call self%code%switching(self%shape, self%given, self%place, self%left, self%right, &
                               t, y, z, values)
   end subroutine switching

   !> Go to other sides.
   pure subroutine take_sides(self, above)
      class(model_type), intent(inout) :: self
      logical, intent(in) :: above(:)

      self%given(size(self%numbers) + 1:) = merge(1.0_wp, 0.0_wp, above)
   end subroutine take_sides

   !> The state after an event.
   pure subroutine act(self, number, rises, t, z, y, acts)
      class(model_type), intent(in) :: self
      integer, intent(in) :: number
      logical, intent(in) :: rises
      real(wp), intent(in) :: t, z(size(self%lag))
      real(wp), intent(inout) :: y(self%n)
      logical, intent(out) :: acts
      integer(c_int) :: changes

      call self%code%act(self%shape, self%given, self%place, self%left, self%right, t, z, number, &
                         merge(1, 0, rises), y, changes)
      acts = changes == 1
   end subroutine act

   !> What the definition calls a value.
   function name_of(self, kind, number) result(name)
      class(model_type), intent(in) :: self
      character(len=*), intent(in) :: kind
      integer, intent(in) :: number
      character(len=:), allocatable :: name
      type(description_type) :: about

      about = self%describe()
      name = about%name_of(kind, number, blocks_in_order(self%shape%blocks, trim(self%ends)))
   end function name_of

   !> Taylor coefficients of the solution.
   pure subroutine series(self, t, unit, degree, z, y)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)

      call self%code%series(self%shape, self%given, self%place, self%left, self%right, &
                            t, unit, degree, z, y)
   end subroutine series

   !> Taylor coefficients of disturbances of the solution.
   pure subroutine tangent_series(self, t, unit, degree, z, y, vectors, dz, dy)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag)), y(0:degree, self%n)
      integer, intent(in) :: vectors
      real(wp), intent(in) :: dz(0:degree, size(self%lag), vectors)
      real(wp), intent(inout) :: dy(0:degree, self%n, vectors)

      call self%code%tangent_series(self%shape, self%given, self%place, self%left, &
                                    self%right, t, unit, degree, z, y, y, vectors, dz, dy)
   end subroutine tangent_series

   !> The rate at which the fast state approaches its balance; 0 if there is none.
   pure function relaxation_rate(self, t, y) result(rate)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp) :: rate

      rate = 0.0_wp
      if (associated(self%code%relaxation_rate)) then
         call self%code%relaxation_rate(self%shape, self%numbers, t, y, rate)
      end if
   end function relaxation_rate

   !> Better Taylor coefficients of the slow solution, where a state has a relaxation rate.
   pure subroutine slow_series(self, t, unit, degree, z, y)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)

      call self%code%slow_series(self%shape, self%numbers, self%place, self%left, self%right, &
                                 t, unit, degree, z, y)
   end subroutine slow_series

   !> Better Taylor coefficients of disturbances of the slow solution.
   pure subroutine slow_tangent_series(self, t, unit, degree, z, before, y, vectors, dz, dy)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(in) :: before(0:degree, self%n), y(0:degree, self%n)
      integer, intent(in) :: vectors
      real(wp), intent(in) :: dz(0:degree, size(self%lag), vectors)
      real(wp), intent(inout) :: dy(0:degree, self%n, vectors)

      call self%code%slow_tangent_series(self%shape, self%numbers, self%place, self%left, &
                                         self%right, t, unit, degree, z, before, y, vectors, dz, dy)
   end subroutine slow_tangent_series

   !> The state at rest; not a number if the definition has none.
   pure function steady_state(self) result(state)
      class(model_type), intent(in) :: self
      real(wp) :: state(self%n)
      integer :: block

      associate (of_block => rest_of_block(self))
         state = [(of_block, block=1, self%shape%blocks)]
      end associate
   end function steady_state

   !> That of one block of a chain, whose blocks are alike.
   pure function rest_of_block(self) result(state)
      class(model_type), intent(in) :: self
      real(wp) :: state(self%sizes%states)

      state = ieee_value(1.0_wp, ieee_quiet_nan)
      if (associated(self%code%steady_state)) call self%code%steady_state(self%numbers, state)
   end function rest_of_block

   !> The derivative of the order of the number of arguments, linear in each of them; not a number
   !> of a chain, or without a state at rest.
   pure function derivative(self, arguments) result(form)
      class(model_type), intent(in) :: self
      !> Disturbances of the state and of the delayed states of the definition, shape
      !> (n, 1 + delayed states, order)
      complex(wp), intent(in) :: arguments(:, :, :)
      complex(wp) :: form(size(arguments, 1))

      form = ieee_value(1.0_wp, ieee_quiet_nan)
      if (associated(self%code%derivative)) then
         call self%code%derivative(self%shape, self%numbers, rest_of_block(self), &
                                   size(arguments, 2) - 1, size(arguments, 3), arguments, form)
      end if
   end function derivative

   !> The terms coefficient s**power exp(-s delay) of
   !> det(s I - A_0 - sum over k of A_k exp(-s lag_k)), the highest power first; of a chain those
   !> of the mode with the eigenvalue `shape%mode`.
   pure subroutine characteristic_terms(self, coefficient, power, delay, part, coefficient_by, &
                                        delay_by)
      class(model_type), intent(in) :: self
      !> Coefficients and delays, shape (terms)
      real(wp), allocatable, intent(out) :: coefficient(:), delay(:)
      !> Powers of s, and numbers of the delays, where 1 is that of no delay; shape (terms)
      integer(c_int), allocatable, intent(out) :: power(:), part(:)
      !> Derivatives by the parameters, shape (terms, parameters)
      real(wp), allocatable, intent(out) :: coefficient_by(:, :), delay_by(:, :)

      associate (terms => self%sizes%terms, parameters => size(self%numbers))
         allocate (coefficient(terms), delay(terms), power(terms), part(terms))
         allocate (coefficient_by(terms, parameters), delay_by(terms, parameters), source=0.0_wp)
         if (terms == 0) return
         call self%code%characteristic_terms(self%shape, self%numbers, rest_of_block(self), terms, &
                                             coefficient, power, delay, part, coefficient_by, &
                                             delay_by)
      end associate
   end subroutine characteristic_terms
end module model_problem
