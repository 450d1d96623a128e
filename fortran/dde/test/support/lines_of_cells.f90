! SPDX-License-Identifier: BSD-3-Clause
!> A delayed logistic reaction that diffuses between cells, y_i' = 1.8 y_i (1 - z_i) + d (y_(i-1) -
!> 2 y_i + y_(i+1)) without flux at the ends, z_i = y_i(t - 1), or y_i itself without delay.
module lines_of_cells
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: cells

   !> The cells.
   type, extends(constant_past) :: cells
      !> Diffusion between neighbours
      real(wp) :: diffusion = 0.0_wp
   contains
      procedure :: rhs => reaction_and_diffusion
   end type cells

   interface cells
      module procedure :: new_cells
   end interface cells

contains

   !> The problem with its parameters, from one wave.
   type(cells) function new_cells(n, diffusion, delayed) result(problem)
      integer, intent(in) :: n
      real(wp), intent(in) :: diffusion
      logical, intent(in) :: delayed
      integer :: i

      problem%diffusion = diffusion
      allocate (problem%lag(merge(n, 0, delayed)), source=1.0_wp)
      allocate (problem%component(size(problem%lag)), problem%past(n))
      do i = 1, n
         if (delayed) problem%component(i) = i
         problem%past(i) = 1.0_wp + 0.5_wp*cos(2.0_wp*acos(0.0_wp)*(i - 0.5_wp)/n)
      end do
      problem%rows = reshape([(i, i, i=1, size(problem%lag))], [2, size(problem%lag)])
      call fill(problem, n, first=problem%past)
   end function new_cells

   pure subroutine reaction_and_diffusion(self, t, y, z, dydt)
      class(cells), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      integer :: i

      do i = 1, self%n
         if (size(z) > 0) then
            dydt(i) = 1.8_wp*y(i)*(1.0_wp - z(i))
         else
            dydt(i) = 1.8_wp*y(i)*(1.0_wp - y(i))
         end if
         if (i > 1) dydt(i) = dydt(i) + self%diffusion*(y(i - 1) - y(i))
         if (i < self%n) dydt(i) = dydt(i) + self%diffusion*(y(i + 1) - y(i))
      end do
   end subroutine reaction_and_diffusion
end module lines_of_cells
