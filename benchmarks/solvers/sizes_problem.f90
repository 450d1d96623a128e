! SPDX-License-Identifier: BSD-3-Clause
!> A delayed reaction in n cells in a row, which exchange with their neighbours (sizes.py),
!>
!>     y_i' = 1.8 y_i (1 - w_i) + y_(i-1) - 2 y_i + y_(i+1).
!>
!> Of several cells w_i is the delayed value of component i, of a single one the mean of all
!> delayed values. The delays are all 1, or spread from 1 to 2.
module sizes_problem
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: cells, cells_with_jacobian

   !> Rate of the reaction
   real(wp), parameter :: reaction = 1.8_wp

   !> The cells.
   type, extends(constant_past) :: cells
   contains
      procedure :: set_up, rhs, series
   end type cells

   !> Cells that give their derivatives.
   type, extends(cells) :: cells_with_jacobian
   contains
      procedure :: jacobian
   end type cells_with_jacobian

contains

   !> Cells and their delays: a single cell, or one delay for each.
   subroutine set_up(self, n, delays, spread)
      class(cells), intent(inout) :: self
      integer, intent(in) :: n, delays
      !> The longest delay less the shortest
      real(wp), intent(in) :: spread
      real(wp) :: start(n)
      integer :: i

      start = [(1.0_wp + 0.5_wp*cos(3.0_wp*(i - 1)/n), i=1, n)]
      call fill(self, n, start, start, [(1.0_wp + spread*(i - 1)/delays, i=1, delays)], &
                [(min(i, n), i=1, delays)])
      self%lower = min(1, n - 1)
      self%upper = self%lower
      self%rows = reshape([(min(i, n), min(i, n), i=1, delays)], [2, delays])
   end subroutine set_up

   pure subroutine rhs(self, t, y, z, dydt)
      class(cells), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      integer :: i

      if (self%n == 1) then
         dydt = reaction*y*(1.0_wp - sum(z)/size(z))
         return
      end if
      do i = 1, self%n
         dydt(i) = reaction*y(i)*(1.0_wp - z(i)) &
                   + y(max(i - 1, 1)) - 2.0_wp*y(i) + y(min(i + 1, self%n))
      end do
   end subroutine rhs

   pure subroutine jacobian(self, t, y, z, by_y, by_z)
      class(cells_with_jacobian), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)

      if (self%n == 1) then
         by_y = reaction*(1.0_wp - sum(z)/size(z))
         by_z = -reaction*y(1)/size(z)
         return
      end if
      by_y = 1.0_wp
      by_y(2, :) = reaction*(1.0_wp - z) - 2.0_wp
      by_y(2, 1) = by_y(2, 1) + 1.0_wp
      by_y(2, self%n) = by_y(2, self%n) + 1.0_wp
      by_z(1, :) = -reaction*y
   end subroutine jacobian

   pure subroutine series(self, t, unit, degree, z, y)
      class(cells), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp) :: mean(0:degree)
      integer :: i, k

      if (self%n == 1) mean = sum(z, dim=2)/size(self%lag)
      do k = 0, degree - 1
         do i = 1, self%n
            if (self%n > 1) mean(:k) = z(:k, i)
            y(k + 1, i) = unit/(k + 1)*(reaction*(y(k, i) - dot_product(y(:k, i), mean(k:0:-1))) &
                          + y(k, max(i - 1, 1)) - 2.0_wp*y(k, i) + y(k, min(i + 1, self%n)))
         end do
      end do
   end subroutine series
end module sizes_problem
