! SPDX-License-Identifier: BSD-3-Clause
!> A model whose equations were made from a definition and compiled (generator/README.md): a problem
!> of the solver, its derivatives of any order at the steady state, and its characteristic function.
!> `open_model` (model_library) fills it with the procedures of a shared object.
module model_problem
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: not_given
   use dde_kinds, only: wp
   use model_chain, only: blocks_in_order
   use model_description, only: description_type
   use model_parameters, only: given_model_type
   implicit none (type, external)
   private
   public :: model_type

   !> A model with its procedures.
   type, extends(given_model_type) :: model_type
   contains
      procedure :: rhs, jacobian, exponents, switching, act, name_of
      procedure :: series, tangent_series, relaxation_rate, slow_series, slow_tangent_series
      procedure :: moving_lags, steady_state, derivative, characteristic_terms
   end type model_type

contains

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
