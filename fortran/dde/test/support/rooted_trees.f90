!> Butcher's order conditions as one differential equation: to each rooted tree belongs a component
!> whose derivative is the product of the components of its subtrees. From y = 0 its solution is
!> t**order/density, and a Runge-Kutta step of order p gives just that for all trees up to order p
!> (Hairer, Norsett and Wanner 1993, sec. II.2).
module rooted_trees
   use dde, only: dde_problem_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: grow_trees, tree_counts, tree_system

   !> Trees of each order (sequence A000081 of the encyclopedia of integer sequences).
   integer, parameter :: tree_counts(9) = [1, 1, 2, 4, 9, 20, 48, 115, 286]
   !> A tree of the highest order has fewer subtrees than this.
   integer, parameter :: most_subtrees = size(tree_counts)

   !> All trees up to some order.
   type, extends(dde_problem_type) :: tree_system
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
      procedure :: initial => zero
      procedure :: history => no_history
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
      allocate (trees%lag(0), trees%component(0))
      allocate (trees%order(most), trees%density(most), trees%subtrees(most))
      allocate (trees%subtree(most_subtrees, most))
      do order = 1, highest
         call graft(trees, order, [integer ::], order - 1, (trees%n))
      end do
   end function grow_trees

   !> Add the trees whose subtrees are those chosen and more, none later than `latest`, with `nodes`
   !> more nodes.
   pure recursive subroutine graft(trees, order, chosen, nodes, latest)
      !> Trees so far
      type(tree_system), intent(inout) :: trees
      !> Order of the trees to add
      integer, intent(in) :: order
      !> Subtrees chosen so far
      integer, intent(in) :: chosen(:)
      !> Nodes still to come
      integer, intent(in) :: nodes
      !> Latest subtree allowed
      integer, intent(in) :: latest
      integer :: i

      if (nodes == 0) call trees%add(order, chosen)
      do i = 1, latest
         if (trees%order(i) > nodes) exit
         call graft(trees, order, [chosen, i], nodes - trees%order(i), i)
      end do
   end subroutine graft

   !> Add one tree.
   pure subroutine add(self, order, chosen)
      !> Trees so far
      class(tree_system), intent(inout) :: self
      !> Number of nodes
      integer, intent(in) :: order
      !> Subtrees at its root
      integer, intent(in) :: chosen(:)

      self%n = self%n + 1
      self%order(self%n) = order
      self%density(self%n) = order*product(self%density(chosen))
      self%subtrees(self%n) = size(chosen)
      self%subtree(:size(chosen), self%n) = chosen
   end subroutine add

   !> The start of all components.
   pure subroutine zero(self, y)
      !> The trees
      class(tree_system), intent(in) :: self
      !> 0
      real(wp), intent(out) :: y(self%n)

      y = 0.0_wp
   end subroutine zero

   !> Nothing is delayed here.
   pure function no_history(self, t, component) result(value)
      !> The trees
      class(tree_system), intent(in) :: self
      !> Time, without influence
      real(wp), intent(in) :: t
      !> Component, without influence
      integer, intent(in) :: component
      real(wp) :: value

      value = 0.0_wp
   end function no_history

   !> Each derivative is a product over subtrees.
   pure subroutine products(self, t, y, z, dydt)
      !> The trees
      class(tree_system), intent(in) :: self
      !> Time
      real(wp), intent(in) :: t
      !> One value for each tree
      real(wp), intent(in) :: y(self%n)
      !> Nothing
      real(wp), intent(in) :: z(size(self%lag))
      !> Derivatives
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
