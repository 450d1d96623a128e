! SPDX-License-Identifier: BSD-3-Clause
!> A problem in other units of time and state, and in another order of components and delays: what
!> such a change may do to a run.
module renamed_problems
   use dde, only: dde_problem_type
   use dde_kinds, only: wp
   use test_problems, only: constant_past
   implicit none (type, external)
   private
   public :: renamed

   !> The problem with its new names.
   type, extends(dde_problem_type) :: renamed
      class(constant_past), allocatable :: inner
      !> Components and delays of the inner problem, in the new order
      integer, allocatable :: order(:), delays(:)
      !> Units: of each component in the new order, and of time
      real(wp), allocatable :: unit(:)
      real(wp) :: unit_of_time = 1.0_wp
   contains
      procedure :: initial, history, past_series, rhs, series
   end type renamed

   interface renamed
      module procedure :: new_renamed
   end interface renamed

contains

   !> Reversed where wanted.
   type(renamed) function new_renamed(inner, unit, unit_of_time, reversed) result(problem)
      class(constant_past), intent(in) :: inner
      real(wp), intent(in) :: unit(:), unit_of_time
      logical, intent(in) :: reversed
      integer :: i

      associate (n => inner%n, delays => size(inner%lag))
         problem%n = n
         problem%order = [(merge(n + 1 - i, i, reversed), i=1, n)]
         problem%delays = [(merge(delays + 1 - i, i, reversed), i=1, delays)]
         problem%lag = unit_of_time*inner%lag(problem%delays)
         problem%component = [(findloc(problem%order, inner%component(problem%delays(i)), dim=1), &
                               i=1, delays)]
      end associate
      problem%analytic = inner%analytic
      problem%unit = unit
      problem%unit_of_time = unit_of_time
      allocate (problem%inner, source=inner)
   end function new_renamed

   pure subroutine initial(self, y)
      class(renamed), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = self%unit*self%inner%first(self%order)
   end subroutine initial

   pure function history(self, t, component) result(value)
      class(renamed), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%unit(component)*self%inner%history(t/self%unit_of_time, self%order(component))
   end function history

   pure subroutine past_series(self, t, component, unit, y)
      class(renamed), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: component
      real(wp), intent(out) :: y(0:)

      call self%inner%past_series(t/self%unit_of_time, self%order(component), &
                                  unit/self%unit_of_time, y)
      y = self%unit(component)*y
   end subroutine past_series

   pure subroutine rhs(self, t, y, z, dydt)
      class(renamed), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: f(self%n), y_inner(self%n), z_inner(size(z))

      y_inner(self%order) = y/self%unit
      z_inner(self%delays) = z/self%unit(self%component)
      call self%inner%rhs(t/self%unit_of_time, y_inner, z_inner, f)
      dydt = self%unit/self%unit_of_time*f(self%order)
   end subroutine rhs

   pure subroutine series(self, t, unit, degree, z, y)
      class(renamed), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp) :: y_inner(0:degree, self%n), z_inner(0:degree, size(self%lag))

      y_inner(:, self%order) = y/spread(self%unit, 1, degree + 1)
      z_inner(:, self%delays) = z/spread(self%unit(self%component), 1, degree + 1)
      call self%inner%series(t/self%unit_of_time, unit/self%unit_of_time, degree, z_inner, y_inner)
      y = spread(self%unit, 1, degree + 1)*y_inner(:, self%order)
   end subroutine series
end module renamed_problems
