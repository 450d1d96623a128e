! SPDX-License-Identifier: BSD-3-Clause
!> Chains of blocks: their order, their modes, and disturbances of blocks that move alike. The suite
!> generated_models shows that a mode is a block with other parameters.
module test_chains
   use block_builder, only: build_block, paper_law
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_chain, only: blocks_in_order, chain_ends, find_neighbours, mode_eigenvalue
   use model_problem, only: model_type
   use pseudo_random, only: uniform
   use transverse_growth, only: of_mode
   implicit none (type, external)
   private
   public :: collect_chains

   integer, parameter :: lengths(5) = [2, 3, 4, 7, 10]
   real(wp), parameter :: pi = acos(-1.0_wp)
   real(wp), parameter :: kappa = 1.3_wp

contains

   subroutine collect_chains(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("order of blocks", test_order), &
                   new_unittest("second differences of modes", test_modes), &
                   new_unittest("disturbances of blocks that move alike", test_disturbances)]
   end subroutine collect_chains

   !> A chain in motion.
   type(model_type) function chain(blocks, ends, kappa) result(model)
      integer, intent(in) :: blocks
      character(len=*), intent(in) :: ends
      real(wp), intent(in) :: kappa

      model = build_block(7.0_wp, 0.7_wp, 0.5_wp, 0.8_wp, 0.2_wp, -0.3_wp, 1.7_wp, &
                          "chain_"//paper_law, [kappa], blocks, ends)
   end function chain

   !> Each block once, and neighbours near each other.
   subroutine test_order(error)
      type(error_type), allocatable, intent(out) :: error
      integer, allocatable :: left(:), right(:)
      integer :: i, k, n

      call expect(error, all(blocks_in_order(5, "ring") == [1, 5, 2, 4, 3]), "five folded")
      if (allocated(error)) return
      do k = 1, size(chain_ends)
         do n = 3, 9
            associate (order => blocks_in_order(n, chain_ends(k)))
               call expect(error, all([(any(order == i), i=1, n)]), "each block once")
               if (allocated(error)) return
               call find_neighbours(n, chain_ends(k), left, right)
               call expect(error, maxval(abs([left, right] - [([(i, i=1, n)], k=1, 2)]), &
                                         mask=[left, right] > 0) <= 2, "near neighbours")
               if (allocated(error)) return
            end associate
         end do
      end do
   end subroutine test_order

   !> They are minus the eigenvalue times the mode.
   subroutine test_modes(error)
      type(error_type), allocatable, intent(out) :: error
      integer, allocatable :: left(:), right(:)
      real(wp), allocatable :: shape_of_mode(:)
      integer :: i, k, m, n

      do k = 1, size(chain_ends)
         do i = 1, size(lengths)
            n = lengths(i)
            if (chain_ends(k) == "ring" .and. n < 3) cycle
            call find_neighbours(n, chain_ends(k), left, right)
            do m = merge(1, 0, chain_ends(k) == "plate"), n - 1
               shape_of_mode = mode_shape(m, n, chain_ends(k))
               call expect_close(error, beside(left) + beside(right) - 2.0_wp*shape_of_mode, &
                                 -mode_eigenvalue(m, n, chain_ends(k))*shape_of_mode, &
                                 1.0e-13_wp, trim(chain_ends(k)))
            end do
         end do
      end do

   contains

      !> The mode at neighbours.
      function beside(neighbours) result(values)
         integer, intent(in) :: neighbours(:)
         real(wp) :: values(size(neighbours))
         integer :: j

         do j = 1, size(neighbours)
            values(j) = 0.0_wp
            if (neighbours(j) > 0) values(j) = shape_of_mode(neighbours(j))
         end do
      end function beside
   end subroutine test_modes

   !> The mode at the places of the state vector, by the formulas of vibrating strings.
   pure function mode_shape(mode, blocks, ends) result(values)
      integer, intent(in) :: mode, blocks
      character(len=*), intent(in) :: ends
      real(wp) :: values(blocks)

      associate (j => blocks_in_order(blocks, ends))
         select case (ends)
         case ("free")
            values = cos(pi*mode*(j - 0.5_wp)/blocks)
         case ("ring")
            values = cos(2.0_wp*pi*mode*j/blocks + 0.3_wp)
         case default
            values = sin(pi*mode*j/(blocks + 1))
         end select
      end associate
   end function mode_shape

   !> Along the motion of blocks that move alike, a disturbance of a mode is that of one block.
   subroutine test_disturbances(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: degree = 9
      character(len=4), parameter :: ends(2) = ["free", "ring"]
      type(model_type) :: blocks, one
      real(wp) :: y(0:degree, 3), z(0:degree, 1), dy(0:degree, 3, 1), dz(0:degree, 1, 1)
      real(wp), allocatable :: all_y(:, :), all_dy(:, :, :), all_dz(:, :, :)
      integer :: i, j, k, m, n

      z(:, 1) = uniform(1, degree + 1, -0.5_wp, 0.5_wp)
      dz(:, 1, 1) = uniform(2, degree + 1, -0.5_wp, 0.5_wp)
      do k = 1, size(ends)
         do i = 2, size(lengths)
            n = lengths(i)
            blocks = chain(n, ends(k), kappa)
            do m = 0, n - 1
               associate (mode => mode_shape(m, n, ends(k)))
                  one = of_mode(chain(1, "free", 1.0_wp), &
                                1.0_wp + kappa*mode_eigenvalue(m, n, ends(k)))
                  call one%initial(y(0, :))
                  dy(0, :, 1) = uniform(m + 5, 3, -1.0_wp, 1.0_wp)
                  allocate (all_y(0:degree, 3*n), all_dy(0:degree, 3*n, 1), source=0.0_wp)
                  allocate (all_dz(0:degree, n, 1))
                  do j = 1, n
                     all_y(0, 3*j - 2:3*j) = y(0, :)
                     all_dy(0, 3*j - 2:3*j, 1) = mode(j)*dy(0, :, 1)
                     all_dz(:, j, 1) = mode(j)*dz(:, 1, 1)
                  end do
                  call one%series(0.0_wp, 0.3_wp, degree, z, y)
                  call blocks%series(0.0_wp, 0.3_wp, degree, spread(z(:, 1), 2, n), all_y)
                  call one%tangent_series(0.0_wp, 0.3_wp, degree, z, y, 1, dz, dy)
                  call blocks%tangent_series(0.0_wp, 0.3_wp, degree, spread(z(:, 1), 2, n), &
                                             all_y, 1, all_dz, all_dy)
                  do j = 1, n
                     call expect_close(error, [all_y(:, 3*j - 2:3*j)], [y], 1.0e-13_wp, "motion")
                     call expect_close(error, [all_dy(:, 3*j - 2:3*j, 1)], [mode(j)*dy(:, :, 1)], &
                                       1.0e-12_wp, "disturbance")
                  end do
                  deallocate (all_y, all_dy, all_dz)
               end associate
            end do
         end do
      end do
   end subroutine test_disturbances
end module test_chains
