! SPDX-License-Identifier: BSD-3-Clause
!> A problem whose Jacobian is given as a band that holds all of the matrix.
module banded_problems
   use dde, only: dde_problem_type, not_given
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: in_a_band

   !> The problem with its full Jacobian.
   type, extends(dde_problem_type) :: in_a_band
      class(dde_problem_type), allocatable :: inner
   contains
      procedure :: initial, history, rhs, jacobian
   end type in_a_band

   interface in_a_band
      module procedure :: new_problem
   end interface in_a_band

contains

   type(in_a_band) function new_problem(inner) result(problem)
      class(dde_problem_type), intent(in) :: inner

      problem%n = inner%n
      problem%lag = inner%lag
      problem%component = inner%component
      problem%lower = inner%n - 1
      problem%upper = inner%n - 1
      problem%rows = spread([1, inner%n], 2, size(inner%lag))
      allocate (problem%inner, source=inner)
   end function new_problem

   pure subroutine initial(self, y)
      class(in_a_band), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      call self%inner%initial(y)
   end subroutine initial

   pure function history(self, t, component) result(value)
      class(in_a_band), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = self%inner%history(t, component)
   end function history

   pure subroutine rhs(self, t, y, z, dydt)
      class(in_a_band), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      call self%inner%rhs(t, y, z, dydt)
   end subroutine rhs

   pure subroutine jacobian(self, t, y, z, by_y, by_z)
      class(in_a_band), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)
      real(wp) :: full(self%n, self%n)
      integer :: j

      by_y = not_given
      call self%inner%jacobian(t, y, z, full, by_z)
      if (.not. any(full > not_given)) return
      by_y = 0.0_wp
      do j = 1, self%n
         by_y(1 + self%n - j:2*self%n - j, j) = full(:, j)
      end do
   end subroutine jacobian
end module banded_problems
