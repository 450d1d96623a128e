! SPDX-License-Identifier: BSD-3-Clause
!> What a compiled model and a program that opens it share: the procedures of a model, over plain
!> arrays. No type with procedures and no allocatable array crosses, so that the two may come from
!> different compilers. A digest of this file is the first thing that a program asks of a model.
!>
!> A model gives these under the names `model_NAME`, of which `switching`, `act`, `moving_lags`,
!> `network_lags` and all from `relaxation_rate` on may be missing. Behind the parameters is, for
!> each value of `switching`, the side on which the equations are: 1 where it is > 0, else 0. Arrays
!> are explained where `model_type` has them, those of networks in generator/network.py.
module model_border
   use, intrinsic :: iso_c_binding, only: c_char, c_int
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: copy_line, lanes, line_length, reciprocal, shape_type
   public :: change_state, describe_line, expand, expand_tangents, find_delayed, find_exponents, &
             find_forms, find_jacobian, find_lags, find_network_lags, find_rate, find_rhs, &
             find_state, list_terms

   !> Disturbances computed at a time.
   integer, parameter :: lanes = 4
   !> Highest degree of a series, and 1/k up to it; i is only that of the list.
   integer, parameter :: highest_degree = 256
   integer :: i
   real(wp), parameter :: reciprocal(highest_degree) = [(1.0_wp/i, i=1, highest_degree)]
   !> Letters of a line of the description.
   integer, parameter :: line_length = 1024

   !> Sizes of a model, and where its blocks stand.
   type, bind(c) :: shape_type
      !> States, and delayed values
      integer(c_int) :: n = 0, values = 0
      !> Blocks of a chain, and delayed values of each
      integer(c_int) :: blocks = 1, delays = 0
      !> Largest distance of neighbours, at least 1; diagonals above the main one
      integer(c_int) :: reach = 1, upper = -1
      !> Of a chain whose blocks move alike: minus the second difference of a disturbance over the
      !> disturbance, an eigenvalue
      real(wp) :: mode = 0.0_wp
   end type shape_type

   abstract interface
      !> A line of the description: words between tabs. Its length; 0 beyond the last line.
      integer(c_int) function describe_line(number, text) result(length) bind(c)
         import :: c_char, c_int, line_length
         implicit none (type, external)
         integer(c_int), intent(in) :: number
         character(kind=c_char), intent(out) :: text(line_length)
      end function describe_line

      !> Delays and components of the delayed states of the definition.
      pure subroutine find_delayed(parameters, lag, component) bind(c)
         import :: c_int, wp
         implicit none (type, external)
         real(wp), intent(in) :: parameters(*)
         real(wp), intent(out) :: lag(*)
         integer(c_int), intent(out) :: component(*)
      end subroutine find_delayed

      !> The delays that move, those of the last delayed states, shape (moving).
      pure subroutine find_lags(self, parameters, t, y, lag) bind(c)
         import :: shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*), t, y(self%n)
         real(wp), intent(out) :: lag(*)
      end subroutine find_lags

      !> The delays of all nodes and edges of a network.
      pure subroutine find_network_lags(self, parameters, left, right, lag) bind(c)
         import :: c_int, shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*)
         integer(c_int), intent(in) :: left(*), right(*)
         real(wp), intent(out) :: lag(*)
      end subroutine find_network_lags

      !> The state at rest, of one block of a chain; not a number if there is none.
      pure subroutine find_state(parameters, state) bind(c)
         import :: wp
         implicit none (type, external)
         real(wp), intent(in) :: parameters(*)
         real(wp), intent(out) :: state(*)
      end subroutine find_state

      !> The derivative form of an order at the steady state, of disturbances of the states and of
      !> the delayed states of the definition, shape (n, 1 + delayed states, order).
      pure subroutine find_forms(self, parameters, state, delayed, order, arguments, form) bind(c)
         import :: c_int, shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*), state(*)
         integer(c_int), intent(in) :: delayed, order
         complex(wp), intent(in) :: arguments(self%n, 1 + delayed, order)
         complex(wp), intent(out) :: form(self%n)
      end subroutine find_forms

      !> The terms of the characteristic function at the steady state, of a chain that of a mode,
      !> and their derivatives by the parameters where these are not 0.
      pure subroutine list_terms(self, parameters, state, terms, coefficient, power, delay, part, &
                                 coefficient_by, delay_by) bind(c)
         import :: c_int, shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*), state(*)
         integer(c_int), intent(in) :: terms
         real(wp), intent(out) :: coefficient(terms), delay(terms)
         integer(c_int), intent(out) :: power(terms), part(terms)
         real(wp), intent(inout) :: coefficient_by(terms, *), delay_by(terms, *)
      end subroutine list_terms

      !> The equations.
      pure subroutine find_rhs(self, parameters, place, left, right, t, y, z, dydt) bind(c)
         import :: c_int, shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*)
         integer(c_int), intent(in) :: place(*), left(*), right(*)
         real(wp), intent(in) :: t, y(self%n), z(self%values)
         real(wp), intent(out) :: dydt(self%n)
      end subroutine find_rhs

      !> Their derivatives by states and delayed values.
      pure subroutine find_jacobian(self, parameters, place, left, right, t, y, z, rows_y, rows_z, &
                                    by_y, by_z) bind(c)
         import :: c_int, shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*)
         integer(c_int), intent(in) :: place(*), left(*), right(*)
         real(wp), intent(in) :: t, y(self%n), z(self%values)
         integer(c_int), intent(in) :: rows_y, rows_z
         real(wp), intent(out) :: by_y(rows_y, self%n), by_z(rows_z, self%values)
      end subroutine find_jacobian

      !> Exponents of their exponential terms, or `switching`, what is 0 where they are not smooth.
      pure subroutine find_exponents(self, parameters, place, left, right, t, y, z, exponents) &
         bind(c)
         import :: c_int, shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*)
         integer(c_int), intent(in) :: place(*), left(*), right(*)
         real(wp), intent(in) :: t, y(self%n), z(self%values)
         real(wp), intent(out) :: exponents(*)
      end subroutine find_exponents

      !> The state after an event whose function rises (1) or falls (0) through zero, and whether it
      !> changes.
      pure subroutine change_state(self, parameters, place, left, right, t, z, number, rises, y, &
                                   acts) bind(c)
         import :: c_int, shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*)
         integer(c_int), intent(in) :: place(*), left(*), right(*)
         real(wp), intent(in) :: t, z(self%values)
         integer(c_int), intent(in) :: number, rises
         real(wp), intent(inout) :: y(self%n)
         integer(c_int), intent(out) :: acts
      end subroutine change_state

      !> Taylor coefficients of the solution, or better ones of the slow solution.
      pure subroutine expand(self, parameters, place, left, right, t, unit, degree, z, y) bind(c)
         import :: c_int, shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*)
         integer(c_int), intent(in) :: place(*), left(*), right(*)
         real(wp), intent(in) :: t, unit
         integer(c_int), intent(in) :: degree
         real(wp), intent(in) :: z(0:degree, self%values)
         real(wp), intent(inout) :: y(0:degree, self%n)
      end subroutine expand

      !> Taylor coefficients of disturbances; `before` are those of the solution before the last
      !> iteration, of the slow solution alone.
      pure subroutine expand_tangents(self, parameters, place, left, right, t, unit, degree, z, &
                                      before, y, vectors, dz, dy) bind(c)
         import :: c_int, shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*)
         integer(c_int), intent(in) :: place(*), left(*), right(*)
         real(wp), intent(in) :: t, unit
         integer(c_int), intent(in) :: degree
         real(wp), intent(in) :: z(0:degree, self%values)
         real(wp), intent(in) :: before(0:degree, self%n), y(0:degree, self%n)
         integer(c_int), intent(in) :: vectors
         real(wp), intent(in) :: dz(0:degree, self%values, vectors)
         real(wp), intent(inout) :: dy(0:degree, self%n, vectors)
      end subroutine expand_tangents

      !> The rate at which the fast state approaches its balance.
      pure subroutine find_rate(self, parameters, t, y, rate) bind(c)
         import :: shape_type, wp
         implicit none (type, external)
         type(shape_type), intent(in) :: self
         real(wp), intent(in) :: parameters(*), t, y(self%n)
         real(wp), intent(out) :: rate
      end subroutine find_rate
   end interface

contains

   !> A line as letters; its length.
   integer(c_int) function copy_line(line, text) result(length)
      !> The line
      character(len=*), intent(in) :: line
      !> Its letters, shape (line_length)
      character(kind=c_char), intent(out) :: text(:)
      integer :: k

      length = min(len(line), line_length)
      text(:length) = [(line(k:k), k=1, length)]
   end function copy_line
end module model_border
