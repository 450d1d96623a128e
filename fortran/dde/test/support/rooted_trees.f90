! SPDX-License-Identifier: BSD-3-Clause
!> Butcher's order conditions as one differential equation: to each rooted tree belongs a component
!> whose derivative is the product of the components of its subtrees. From y = 0 its solution is
!> t**order/density, and a Runge-Kutta step of order p gives just that for all trees up to order p
!> (Hairer, Norsett and Wanner 1993, sec. II.2).
module rooted_trees
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: grow_trees, tree_counts, tree_system

   !> Trees of each order (sequence A000081 of the encyclopedia of integer sequences).
   integer, parameter :: tree_counts(9) = [1, 1, 2, 4, 9, 20, 48, 115, 286]
   !> A tree of the highest order has fewer subtrees than this.
   integer, parameter :: most_subtrees = size(tree_counts)

   !> All trees up to some order.
   type, extends(constant_past) :: tree_system
      !> Number of nodes, shape (n)
      integer, allocatable :: order(:)
      !> Density, shape (n)
      real(wp), allocatable :: density(:)
      !> Number of subtrees at the root, shape (n)
      integer, allocatable :: subtrees(:)
      !> The subtrees, shape (most_subtrees, n)
      integer, allocatable :: subtree(:, :)
      !> Whether t itself stands for the tree of one node, which it equals
      logical :: by_the_clock = .false.
   contains
      procedure :: rhs => products
      procedure, private :: add
   end type tree_system

contains

   !> All trees up to `highest` nodes, in ascending order.
   pure type(tree_system) function grow_trees(highest) result(trees)
      !> Highest order, at most size(tree_counts)
      integer, intent(in) :: highest
      integer :: order, most

      most = sum(tree_counts(:highest))
      call fill(trees, 0, [real(wp) ::], spread(0.0_wp, 1, most))
      allocate (trees%order(most), trees%density(most), trees%subtrees(most))
      allocate (trees%subtree(most_subtrees, most))
      do order = 1, highest
         call graft(trees, order, [integer ::], order - 1, (trees%n))
      end do
   end function grow_trees

   !> Add the trees whose subtrees are those chosen and more, none later than `latest`, with `nodes`
   !> more nodes.
   pure recursive subroutine graft(trees, order, chosen, nodes, latest)
      type(tree_system), intent(inout) :: trees
      integer, intent(in) :: order, chosen(:), nodes, latest
      integer :: i

      if (nodes == 0) call trees%add(order, chosen)
      do i = 1, latest
         if (trees%order(i) > nodes) exit
         call graft(trees, order, [chosen, i], nodes - trees%order(i), i)
      end do
   end subroutine graft

   !> Add one tree.
   pure subroutine add(self, order, chosen)
      class(tree_system), intent(inout) :: self
      integer, intent(in) :: order, chosen(:)

      self%n = self%n + 1
      self%order(self%n) = order
      self%density(self%n) = order*product(self%density(chosen))
      self%subtrees(self%n) = size(chosen)
      self%subtree(:size(chosen), self%n) = chosen
   end subroutine add

   !> Each derivative is a product over subtrees.
   pure subroutine products(self, t, y, z, dydt)
      class(tree_system), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: value(self%n)
      integer :: i

      value = y
      if (self%by_the_clock) value(1) = t
      do i = 1, self%n
         dydt(i) = product(value(self%subtree(:self%subtrees(i), i)))
      end do
   end subroutine products
end module rooted_trees
