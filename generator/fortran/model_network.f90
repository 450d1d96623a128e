! SPDX-License-Identifier: BSD-3-Clause
!> The nodes and edges of a network: read from a file, and where delayed values stand.
!>
!> The file holds the numbers of nodes, of parameters of each node and of each edge, and of edges,
!> 32 bits each; the first edge of each node, one more, and the node at which each edge begins, 32
!> bits; the parameters of nodes, one after another, and those of edges, 64 bits.
module model_network
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: iso_fortran_env, only: int32, real64
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use model_description, only: of_far_node, of_node, sizes_type
   implicit none (type, external)
   private
   public :: count_lags, place_values, read_network

   !> Most nodes of which all pairs are edges: their number is one of 32 bits.
   integer, parameter :: most_nodes = 46340

   !> Delayed values, each time of a component once.
   type :: values_type
      integer :: number = 0
      !> Delays and components of the values, and their first and last equations, shape (2, values)
      real(wp), allocatable :: lag(:)
      integer, allocatable :: component(:), rows(:, :)
      !> The newest value of each component, and before each value an older one of its component
      integer, allocatable :: newest(:), older(:)
   contains
      procedure :: take, widen
   end type values_type

contains

   !> Read a network of a model, and keep the edges that take part.
   subroutine read_network(path, sizes, first_edge, begins, numbers, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Sizes of the definition
      type(sizes_type), intent(in) :: sizes
      !> First edge of each node, and one more, shape (nodes + 1); nodes at which edges begin
      integer(c_int), allocatable, intent(out) :: first_edge(:), begins(:)
      !> Parameters of the nodes, then of the edges
      real(wp), allocatable, intent(out) :: numbers(:)
      !> It cannot be read, or belongs to another definition
      type(error_type), allocatable, intent(out) :: error
      integer(int32), allocatable :: first(:), from(:)
      real(real64), allocatable :: of_edges(:, :), of_nodes(:)
      character(len=200) :: reason
      integer(int32) :: counts(4)
      integer :: status, unit

      open (newunit=unit, file=path, access="stream", form="unformatted", action="read", &
            status="old", iostat=status, iomsg=reason)
      if (status == 0) then
         read (unit, iostat=status, iomsg=reason) counts
         if (status == 0 .and. any(counts(2:3) /= [sizes%vectors, sizes%matrices])) then
            close (unit)
            call raise(error, path//": "//text(int(counts(2)))//" and "//text(int(counts(3))) &
                       //" parameters of nodes and edges; expected "//text(sizes%vectors)//" and " &
                       //text(sizes%matrices))
            return
         end if
         if (status == 0) then
            allocate (first(counts(1) + 1), from(counts(4)), of_nodes(counts(1)*counts(2)))
            allocate (of_edges(counts(4), counts(3)))
            read (unit, iostat=status, iomsg=reason) first, from, of_nodes, of_edges
         end if
         close (unit)
      end if
      if (status /= 0) then
         call raise(error, path//": cannot be read: "//trim(reason))
         return
      end if
      if (sizes%needed(ubound(sizes%needed, 1)) .and. counts(1) > most_nodes) then
         call raise(error, text(int(counts(1)))//" nodes, all to all; expected at most " &
                    //text(most_nodes)//", or terms that are 0 where a matrix is")
         return
      end if
      call keep_edges(sizes%needed, int(counts(1)), first, from, real(of_edges, wp), first_edge, &
                      begins, numbers)
      numbers = [real(of_nodes, wp), numbers]
   end subroutine read_network

   !> Keep the edges that take part: all pairs of nodes, or those with a parameter that is not 0.
   subroutine keep_edges(needed, nodes, first, from, values, first_edge, begins, numbers)
      !> Whether an edge takes part by the set of parameters that are 0 there, shape (0:)
      logical, intent(in) :: needed(0:)
      integer, intent(in) :: nodes
      !> Edges, and their parameters, shape (edges, parameters)
      integer(int32), intent(in) :: first(:), from(:)
      real(wp), intent(in) :: values(:, :)
      !> Those that are kept
      integer(c_int), allocatable, intent(out) :: first_edge(:), begins(:)
      real(wp), allocatable, intent(out) :: numbers(:)
      real(wp), allocatable :: kept(:, :)
      real(wp) :: row(nodes, size(values, 2))
      integer :: edges, k, node
      logical :: all_pairs

      all_pairs = needed(ubound(needed, 1))
      edges = merge(nodes**2, size(from), all_pairs)
      allocate (first_edge(nodes + 1), source=1_c_int)
      allocate (begins(edges), kept(edges, size(values, 2)))
      edges = 0
      do node = 1, nodes
         associate (listed => [(k, k=first(node), first(node + 1) - 1)])
            if (all_pairs) then
               row = 0.0_wp
               row(from(listed), :) = values(listed, :)
               do k = 1, nodes
                  call keep(k, row(k, :))
               end do
            else
               do k = 1, size(listed)
                  call keep(int(from(listed(k))), values(listed(k), :))
               end do
            end if
         end associate
         first_edge(node + 1) = int(edges + 1, c_int)
      end do
      begins = begins(:edges)
      numbers = [kept(:edges, :)]

   contains

      !> Keep an edge if it takes part.
      subroutine keep(other, given)
         integer, intent(in) :: other
         real(wp), intent(in) :: given(:)
         integer :: bit

         if (.not. needed(sum([(merge(0, 2**(bit - 1), abs(given(bit)) > 0.0_wp), &
                                bit=1, size(given))]))) return
         edges = edges + 1
         begins(edges) = int(other, c_int)
         kept(edges, :) = given
      end subroutine keep
   end subroutine keep_edges

   !> Number of delayed values of all nodes and edges, of which some may be the same.
   pure integer function count_lags(sizes, nodes, edges) result(number)
      type(sizes_type), intent(in) :: sizes
      integer, intent(in) :: nodes, edges

      associate (of_nodes => count(sizes%read == of_node))
         number = of_nodes*nodes + (size(sizes%read) - of_nodes)*edges
      end associate
   end function count_lags

   !> The delayed values: each time of a component once.
   pure subroutine place_values(sizes, first_edge, begins, lags, keeps_zero, place, lag, &
                                component, rows, lower, upper)
      type(sizes_type), intent(in) :: sizes
      !> Edges, as `read_network` gives them
      integer(c_int), intent(in) :: first_edge(:), begins(:)
      !> Delays of all nodes and edges, in the order of the model's procedures
      real(wp), intent(in) :: lags(:)
      !> Whether delays of 0 are delayed values, too
      logical, intent(in) :: keeps_zero
      !> Number of the delayed value of each of them, 0 for none, and behind them the first equation
      !> that takes each value
      integer(c_int), allocatable, intent(out) :: place(:)
      !> Delays and components of the values
      real(wp), allocatable, intent(out) :: lag(:)
      integer, allocatable, intent(out) :: component(:)
      !> First and last equation that takes each, shape (2, values)
      integer, allocatable, intent(out) :: rows(:, :)
      !> Diagonals of the Jacobian below and above the main one
      integer, intent(out) :: lower, upper
      integer :: at, edge, i, node, nodes
      type(values_type) :: values

      nodes = size(first_edge) - 1
      allocate (values%lag(size(lags)), values%component(size(lags)), values%older(size(lags)))
      allocate (values%rows(2, size(lags)), values%newest(sizes%states*nodes), source=0)
      allocate (place(size(lags)))
      at = 0
      lower = merge(nodes - 1, 0, sizes%full)
      upper = lower
      do i = 1, size(sizes%read)
         if (sizes%read(i) /= of_node) cycle
         do node = 1, nodes
            at = at + 1
            call values%take(sizes, i, node, lags(at), keeps_zero, place(at))
            call values%widen(sizes, place(at), merge(1, node, sizes%full), &
                              merge(nodes, node, sizes%full))
         end do
      end do
      do node = 1, nodes
         do edge = first_edge(node), first_edge(node + 1) - 1
            associate (other => begins(edge))
               lower = max(lower, node - other)
               upper = max(upper, other - node)
               do i = 1, count(sizes%read == of_node)
                  call values%widen(sizes, place((i - 1)*nodes + other), node, node)
               end do
            end associate
         end do
      end do
      do i = 1, size(sizes%read)
         if (sizes%read(i) == of_node) cycle
         do node = 1, nodes
            do edge = first_edge(node), first_edge(node + 1) - 1
               at = at + 1
               call values%take(sizes, i, merge(int(begins(edge)), node, &
                                                sizes%read(i) == of_far_node), &
                                lags(at), keeps_zero, place(at))
               call values%widen(sizes, place(at), node, node)
            end do
         end do
      end do
      lag = values%lag(:values%number)
      component = values%component(:values%number)
      rows = values%rows(:, :values%number)
      place = [place, int(rows(1, :), c_int)]
      lower = min(sizes%states*nodes - 1, sizes%states*(lower + 1) - 1)
      upper = min(sizes%states*nodes - 1, sizes%states*(upper + 1) - 1)
   end subroutine place_values

   !> Take a delayed value of a state of a node, unless it is known.
   pure subroutine take(self, sizes, which, node, lag, keeps_zero, known)
      class(values_type), intent(inout) :: self
      type(sizes_type), intent(in) :: sizes
      !> Which delayed value of the definition, and of which node
      integer, intent(in) :: which, node
      real(wp), intent(in) :: lag
      !> Whether a delay of 0 is one, too
      logical, intent(in) :: keeps_zero
      !> Its number; 0 if it is none
      integer(c_int), intent(out) :: known

      known = 0
      if (.not. (lag > 0.0_wp .or. keeps_zero)) return
      associate (newest => self%newest(sizes%states*(node - 1) + sizes%read_states(which)))
         known = int(newest, c_int)
         do while (known > 0)
            if (abs(self%lag(known) - lag) <= 0.0_wp) return
            known = int(self%older(known), c_int)
         end do
         self%number = self%number + 1
         known = int(self%number, c_int)
         self%lag(known) = lag
         self%component(known) = sizes%states*(node - 1) + sizes%read_states(which)
         self%older(known) = newest
         newest = known
      end associate
   end subroutine take

   !> Equations of the nodes from `first` to `last` take a value.
   pure subroutine widen(self, sizes, number, first, last)
      class(values_type), intent(inout) :: self
      type(sizes_type), intent(in) :: sizes
      integer(c_int), intent(in) :: number
      integer, intent(in) :: first, last

      if (number == 0) return
      associate (rows => self%rows(:, number))
         if (rows(1) == 0) rows(1) = huge(1)
         rows(1) = min(rows(1), sizes%states*(first - 1) + 1)
         rows(2) = max(rows(2), sizes%states*last)
      end associate
   end subroutine widen
end module model_network
