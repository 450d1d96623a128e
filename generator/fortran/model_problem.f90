!> What all models have whose equations are made from a definition (generator/README.md): a problem
!> of the solver, its derivatives of any order at the steady state, and its characteristic function.
module model_problem
   use dde, only: problem_with_tangents
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: description_type, lanes, model_type, parameter_type, reciprocal, unbounded, word_length

   !> Disturbances computed at a time.
   integer, parameter :: lanes = 4
   !> Highest degree of a series, and 1/k up to it; i is only that of the list.
   integer, parameter :: highest_degree = 256
   integer :: i
   real(wp), parameter :: reciprocal(highest_degree) = [(1.0_wp/i, i=1, highest_degree)]

   !> Letters of names; of meanings and equations.
   integer, parameter :: word_length = 64, line_length = 512
   !> Bound of a parameter that has none.
   real(wp), parameter :: unbounded = -huge(1.0_wp)

   !> A parameter.
   type :: parameter_type
      !> Its name
      character(len=word_length) :: name = ""
      !> What it is
      character(len=line_length) :: meaning = ""
      !> Its unit, or "nondimensional"
      character(len=word_length) :: unit = ""
      !> Values are above this, and at least that
      real(wp) :: above = unbounded, at_least = unbounded
   end type parameter_type

   !> What a definition says, for messages and files.
   type :: description_type
      !> Name, and where the equations are from
      character(len=line_length) :: name = "", source = ""
      !> Parameters
      type(parameter_type), allocatable :: parameters(:)
      !> Equations and definitions as they are written, one a line
      character(len=line_length), allocatable :: equations(:)
   end type description_type

   !> A model: its parameters, and constant values up to the initial time unless it has others.
   type, abstract, extends(problem_with_tangents) :: model_type
      !> Parameters, in the order of the definition
      real(wp), allocatable :: parameters(:)
      !> States up to the initial time, shape (n)
      real(wp), allocatable :: past(:)
      !> Where each delayed state of the definition is among the delayed values of the problem; 0
      !> where its delay is 0
      integer, allocatable :: place(:)
      !> Blocks of a chain, and delayed values of each
      integer :: blocks = 1, delays = 0
      !> Neighbours of the blocks of a chain on both sides; 0: the plate, which is at rest
      integer, allocatable :: left(:), right(:)
      !> Largest distance of neighbours, at least 1
      integer :: reach = 1
      !> Of a chain whose blocks move alike: minus the second difference of a disturbance over the
      !> disturbance, an eigenvalue
      real(wp) :: mode = 0.0_wp
   contains
      !> Give the model its parameters and its past
      procedure :: set
      !> Equations of a chain that contain second differences
      procedure :: couplings => no_couplings
      procedure :: initial => past_state
      procedure :: history => past_component
      procedure :: past_series => past_component_series
      !> What the definition says
      procedure(describe_model), deferred :: describe
      !> Delayed states of the definition: delays and components
      procedure(list_delayed), deferred :: delayed
      !> State at rest, shape (n)
      procedure(find_state), deferred :: steady_state
      !> Derivative form of the right-hand side at the steady state
      procedure(evaluate_form), deferred :: derivative
      !> Terms of the characteristic function
      procedure(list_terms), deferred :: characteristic_terms
   end type model_type

   abstract interface
      !> What the definition says.
      pure function describe_model(self) result(description)
         import :: description_type, model_type
         implicit none (type, external)
         class(model_type), intent(in) :: self
         type(description_type) :: description
      end function describe_model

      !> Delays and components of the delayed states.
      pure subroutine list_delayed(self, lag, component)
         import :: model_type, wp
         implicit none (type, external)
         class(model_type), intent(in) :: self
         !> Delays, >= 0
         real(wp), allocatable, intent(out) :: lag(:)
         !> Components, 1..n
         integer, allocatable, intent(out) :: component(:)
      end subroutine list_delayed

      !> The state at rest.
      pure function find_state(self) result(state)
         import :: model_type, wp
         implicit none (type, external)
         class(model_type), intent(in) :: self
         real(wp) :: state(self%n)
      end function find_state

      !> The derivative of the order of the number of arguments, linear in each of them.
      pure function evaluate_form(self, arguments) result(form)
         import :: model_type, wp
         implicit none (type, external)
         class(model_type), intent(in) :: self
         !> Disturbances of the state and of the delayed states of the definition, shape
         !> (n, 1 + delayed states, order)
         complex(wp), intent(in) :: arguments(:, :, :)
         complex(wp) :: form(size(arguments, 1))
      end function evaluate_form

      !> The terms coefficient s**power exp(-s delay) of
      !> det(s I - A_0 - sum over k of A_k exp(-s lag_k)), the highest power first.
      pure subroutine list_terms(self, coefficient, power, delay, part, coefficient_by, &
                                 delay_by)
         import :: model_type, wp
         implicit none (type, external)
         class(model_type), intent(in) :: self
         !> Coefficients and delays, shape (terms)
         real(wp), allocatable, intent(out) :: coefficient(:), delay(:)
         !> Powers of s, and numbers of the delays, where 1 is that of no delay; shape (terms)
         integer, allocatable, intent(out) :: power(:), part(:)
         !> Derivatives by the parameters, shape (terms, parameters)
         real(wp), allocatable, intent(out) :: coefficient_by(:, :), delay_by(:, :)
      end subroutine list_terms
   end interface

contains

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
      integer, allocatable :: component(:)
      real(wp), allocatable :: lag(:)
      logical, allocatable :: kept(:)
      integer :: block, k, states

      self%n = size(past)
      self%analytic = .true.
      self%analytic_tangents = .true.
      self%parameters = parameters
      self%past = past
      call self%delayed(lag, component)
      kept = lag > 0.0_wp
      if (present(keep_delays)) kept = kept .or. keep_delays
      self%place = merge([(count(kept(:k)), k=1, size(lag))], 0, kept)
      if (allocated(self%left)) self%blocks = size(self%left)
      self%delays = count(kept)
      states = self%n/self%blocks
      self%component = [(pack(component, kept) + states*(block - 1), block=1, self%blocks)]
      self%lag = [(pack(lag, kept), block=1, self%blocks)]
      if (allocated(self%left)) call set_band(self, states)
   end subroutine set

   !> The band of the Jacobian of a chain, and the equations of each delayed value.
   pure subroutine set_band(self, states)
      class(model_type), intent(inout) :: self
      !> States of a block
      integer, intent(in) :: states
      integer, allocatable :: column(:), row(:)
      integer :: block, k

      call self%couplings(row, column)
      self%reach = 1
      do block = 1, self%blocks
         associate (beside => [self%left(block), self%right(block)])
            self%reach = max(self%reach, maxval(abs(beside - block), mask=beside > 0))
         end associate
      end do
      self%lower = min(self%n - 1, max(states - 1, states*self%reach + maxval(row - column)))
      self%upper = min(self%n - 1, max(states - 1, states*self%reach + maxval(column - row)))
      self%rows = reshape([((states*(block - 1) + 1, states*block, k=1, self%delays), &
                            block=1, self%blocks)], [2, self%blocks*self%delays])
   end subroutine set_band

   !> None.
   pure subroutine no_couplings(self, row, column)
      class(model_type), intent(in) :: self
      !> Numbers of equations within a block, and of the states of which they take a second
      !> difference
      integer, allocatable, intent(out) :: row(:), column(:)

      allocate (row(0), column(0))
   end subroutine no_couplings

   !> The past holds up to the initial time.
   pure subroutine past_state(self, y)
      class(model_type), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%past
   end subroutine past_state

   !> A constant past.
   pure function past_component(self, t, component) result(value)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%past(component)
   end function past_component

   !> The series of a constant past.
   pure subroutine past_component_series(self, t, component, unit, y)
      class(model_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp), intent(in) :: unit
      real(wp), intent(out) :: y(0:)

      y = 0.0_wp
      y(0) = self%past(component)
   end subroutine past_component_series
end module model_problem
