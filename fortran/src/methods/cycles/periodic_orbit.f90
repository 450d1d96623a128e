! SPDX-License-Identifier: BSD-3-Clause
!> A periodic orbit as a continuous piecewise polynomial of s = t/T, with its period T and the
!> parameters it belongs to.
module periodic_orbit
   use collocation_basis, only: collocation_basis_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: periodic_orbit_type

   !> Interval i has the nodes (i - 1) m + 1 to i m + 1, where m is the degree.
   type :: periodic_orbit_type
      !> Polynomials on an interval
      type(collocation_basis_type) :: basis
      !> Ends of the intervals in s, from 0 to 1
      real(wp), allocatable :: mesh(:)
      !> State at the nodes, shape (n, intervals m + 1); the last is the first
      real(wp), allocatable :: nodes(:, :)
      !> Unit of the state, > 0, in which amplitudes and changes of it count
      real(wp) :: unit = 1.0_wp
      !> Period T > 0
      real(wp) :: period = 0.0_wp
      !> Parameters of the problem family
      real(wp), allocatable :: parameters(:)
   contains
      procedure :: intervals, locate, at, node_times, on_mesh, deviations, amplitude
      procedure :: opposite_parts, comes_to_shorter, range_of, find_highest, functional
   end type periodic_orbit_type

   !> Most turns of a shorter cycle that an orbit is compared with.
   integer, parameter :: most_turns = 3

contains

   !> Number of intervals.
   pure integer function intervals(self) result(value)
      class(periodic_orbit_type), intent(in) :: self

      value = size(self%mesh) - 1
   end function intervals

   !> The interval and the place 0..1 in it of a time in [0, 1].
   pure subroutine locate(self, s, interval, place)
      class(periodic_orbit_type), intent(in) :: self
      !> Time in periods, 0..1
      real(wp), intent(in) :: s
      integer, intent(out) :: interval
      real(wp), intent(out) :: place
      integer :: above, middle

      interval = 1
      above = size(self%mesh)
      do while (above - interval > 1)
         middle = (interval + above)/2
         if (self%mesh(middle) <= s) then
            interval = middle
         else
            above = middle
         end if
      end do
      associate (left => self%mesh(interval), right => self%mesh(interval + 1))
         place = (s - left)/(right - left)
      end associate
   end subroutine locate

   !> State at a time of any period.
   pure function at(self, s) result(state)
      class(periodic_orbit_type), intent(in) :: self
      real(wp), intent(in) :: s
      real(wp) :: state(size(self%nodes, 1))
      real(wp) :: place
      integer :: first, i

      call self%locate(s - floor(s), i, place)
      first = (i - 1)*self%basis%degree + 1
      state = matmul(self%nodes(:, first:first + self%basis%degree), self%basis%values_at(place))
   end function at

   !> Times of all nodes, in periods.
   pure function node_times(self) result(times)
      class(periodic_orbit_type), intent(in) :: self
      real(wp) :: times((size(self%mesh) - 1)*self%basis%degree + 1)
      integer :: i

      associate (m => self%basis%degree, mesh => self%mesh)
         do i = 1, self%intervals()
            times((i - 1)*m + 1:i*m) = mesh(i) + (mesh(i + 1) - mesh(i))*self%basis%node(:m)
         end do
         times(size(times)) = 1.0_wp
      end associate
   end function node_times

   !> The orbit by its values at the nodes of another mesh.
   pure function on_mesh(self, mesh) result(orbit)
      class(periodic_orbit_type), intent(in) :: self
      !> Ends of the intervals, from 0 to 1
      real(wp), intent(in) :: mesh(:)
      type(periodic_orbit_type) :: orbit
      integer :: i

      orbit%basis = self%basis
      orbit%mesh = mesh
      orbit%unit = self%unit
      orbit%period = self%period
      orbit%parameters = self%parameters
      associate (times => orbit%node_times())
         allocate (orbit%nodes(size(self%nodes, 1), size(times)))
         do i = 1, size(times)
            orbit%nodes(:, i) = self%at(times(i))
         end do
      end associate
      orbit%nodes(:, size(orbit%nodes, 2)) = orbit%nodes(:, 1)
   end function on_mesh

   !> State at the nodes less the mean of all nodes, shape (n, nodes).
   pure function deviations(self) result(nodes)
      class(periodic_orbit_type), intent(in) :: self
      real(wp) :: nodes(size(self%nodes, 1), size(self%nodes, 2))

      nodes = self%nodes - spread(sum(self%nodes, dim=2)/size(self%nodes, 2), 2, &
                                  size(self%nodes, 2))
   end function deviations

   !> The largest range of a component, by the nodes, in its unit.
   pure real(wp) function amplitude(self) result(value)
      class(periodic_orbit_type), intent(in) :: self

      value = maxval(maxval(self%nodes, dim=2) - minval(self%nodes, dim=2))/self%unit
   end function amplitude

   !> Number k of turns after which the mean of an orbit is taken if the parts of two orbits on the
   !> same mesh beside these means are opposite, or 0. With k = 1 they lie on both sides of a Hopf
   !> point, otherwise on both sides of a cycle of 1/k of their period, on a branch that passes
   !> through it. There the parts may also be shifted: then they are neither opposite nor alike.
   pure integer function opposite_parts(self, other) result(turns)
      class(periodic_orbit_type), intent(in) :: self
      type(periodic_orbit_type), intent(in) :: other
      real(wp), parameter :: alike = 0.7_wp
      real(wp), dimension(size(self%nodes, 1), size(self%nodes, 2)) :: mine, theirs

      do turns = 1, most_turns
         mine = part_beside(self, turns)
         theirs = part_beside(other, turns)
         if (sum(mine*theirs) < merge(0.0_wp, alike, turns == 1)*norm2(mine)*norm2(theirs)) return
      end do
      turns = 0
   end function opposite_parts

   !> Whether a branch reaches an orbit of a part of its period.
   pure logical function comes_to_shorter(self, last) result(value)
      class(periodic_orbit_type), intent(in) :: self
      type(periodic_orbit_type), intent(in) :: last
      real(wp), parameter :: least_share = 0.02_wp
      real(wp) :: share

      share = part_share(self)
      value = .false.
      if (share < least_share) value = share < part_share(last)
   end function comes_to_shorter

   !> Least share of an orbit beside its means after 1/k of the period, k > 1: it is 0 where the
   !> orbit is one of 1/k of its period.
   pure real(wp) function part_share(self) result(share)
      class(periodic_orbit_type), intent(in) :: self
      integer :: turns

      share = 1.0_wp
      do turns = 2, most_turns
         share = min(share, norm2(part_beside(self, turns))/norm2(part_beside(self, 1)))
      end do
   end function part_share

   !> What is left of an orbit at its nodes without its mean or, for k > 1, without the mean of its
   !> values after 0, 1/k, ... of the period.
   pure function part_beside(orbit, turns) result(part)
      class(periodic_orbit_type), intent(in) :: orbit
      integer, intent(in) :: turns
      real(wp) :: part(size(orbit%nodes, 1), size(orbit%nodes, 2))
      real(wp) :: times(size(orbit%nodes, 2))
      integer :: i, k

      part = orbit%deviations()
      if (turns == 1) return
      part = orbit%nodes*(1.0_wp - 1.0_wp/turns)
      times = orbit%node_times()
      do i = 1, size(times)
         do k = 1, turns - 1
            part(:, i) = part(:, i) - orbit%at(times(i) + real(k, wp)/turns)/turns
         end do
      end do
   end function part_beside

   !> Least and greatest value of a component. Each extreme at a node is made better by the extreme
   !> of its polynomial, found by golden section between the neighbouring nodes.
   pure function range_of(self, component) result(range)
      class(periodic_orbit_type), intent(in) :: self
      integer, intent(in) :: component
      real(wp) :: range(2)
      real(wp) :: time

      call find_highest(self, component, -1.0_wp, range(1), time)
      range(1) = -range(1)
      call find_highest(self, component, 1.0_wp, range(2), time)
   end function range_of

   !> Maximum of a component times a sign, and its time in periods.
   pure subroutine find_highest(self, component, sign, value, time)
      class(periodic_orbit_type), intent(in) :: self
      integer, intent(in) :: component
      real(wp), intent(in) :: sign
      real(wp), intent(out) :: value, time
      real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp)
      integer, parameter :: sections = 40
      real(wp) :: left, p, q, right, state(size(self%nodes, 1)), times(size(self%nodes, 2))
      integer :: i, node

      times = self%node_times()
      node = maxloc(sign*self%nodes(component, :size(times) - 1), dim=1)
      left = times(max(node, 2) - 1)
      if (node == 1) left = times(size(times) - 1) - 1.0_wp
      right = times(node + 1)
      time = times(node)
      value = sign*self%nodes(component, node)
      do i = 1, sections
         p = right - golden*(right - left)
         q = left + golden*(right - left)
         state = self%at(p)
         associate (at_p => sign*state(component))
            if (at_p > value) then
               value = at_p
               time = p
            end if
            state = self%at(q)
            if (at_p > sign*state(component)) then
               right = q
            else
               left = p
            end if
         end associate
      end do
   end subroutine find_highest

   !> Weights g of the nodes with sum(g x) = integral of a . x over the period, for a function a and
   !> all piecewise polynomials x.
   pure function functional(self, a) result(g)
      class(periodic_orbit_type), intent(in) :: self
      !> Values of a at the collocation points, shape (n, m, intervals)
      real(wp), intent(in) :: a(:, :, :)
      real(wp) :: g(size(self%nodes, 1), size(self%nodes, 2))
      integer :: first, i, j, k

      g = 0.0_wp
      associate (m => self%basis%degree)
         do i = 1, self%intervals()
            first = (i - 1)*m
            do k = 1, m
               do j = 1, m + 1
                  g(:, first + j) = g(:, first + j) + (self%mesh(i + 1) - self%mesh(i)) &
                                    *self%basis%weight(k)*self%basis%value(j, k)*a(:, k, i)
               end do
            end do
         end do
      end associate
   end function functional
end module periodic_orbit
