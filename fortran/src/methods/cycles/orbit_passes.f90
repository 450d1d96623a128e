! SPDX-License-Identifier: BSD-3-Clause
!> Small changes of a periodic orbit. On one interval of the mesh the nodes follow from the left
!> end, the delayed values and the forcing. So all follow, interval by interval, from the past.
module orbit_passes
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: orbit_passes_type

   !> Numbers that are summed together: one sum alone waits for each of its additions.
   integer, parameter :: together = 4

   !> Linear equations for changes of an orbit. The past has the state at s = 0 and the delayed
   !> components at the nodes of the last `reach` intervals before.
   type :: orbit_passes_type
      !> Number of equations n, degree m, intervals, and intervals of the past
      integer :: n = 0, degree = 0, intervals = 0, reach = 0
      !> Unit of the state
      real(wp) :: unit = 1.0_wp
      !> Components that are delayed
      integer, allocatable :: delayed(:)
      !> Which of them each delayed value is
      integer, allocatable :: row(:)
      !> Interval from which a delayed value is interpolated: 0 is the last before s = 0; and the
      !> number of periods by which it is later than the delay says, shape (delays, m, intervals)
      integer, allocatable :: source(:, :, :), later(:, :, :)
      !> Weights of its m + 1 nodes, shape (m + 1, delays, m, intervals); 0 where the delay does not
      !> reach out of the interval
      real(wp), allocatable :: weight(:, :, :, :)
      !> Answer of an interval's nodes but the first, shape (inputs, n m, intervals). Inputs: state
      !> at the left end (n), delayed values at the points (delays m), forcings: the residual, a
      !> relative change of the period, changes of free parameters in their units.
      real(wp), allocatable :: response(:, :, :)
      !> What a pass needs of it: state at the right end, delayed components at the other nodes, and
      !> sums over the nodes; shape (together, parts, inputs, intervals)
      real(wp), allocatable, private :: lead(:, :, :, :)
      !> Weights of these sums at the first node, shape (n, sums)
      real(wp), allocatable, private :: at_start(:, :)
   contains
      procedure :: inputs, past_size, prepare, reach_back, pass
   end type orbit_passes_type

contains

   !> Number of inputs without forcings.
   pure integer function inputs(self) result(value)
      class(orbit_passes_type), intent(in) :: self

      value = self%n + self%degree*size(self%row)
   end function inputs

   !> Numbers of a past.
   pure integer function past_size(self) result(value)
      class(orbit_passes_type), intent(in) :: self

      value = self%n + size(self%delayed)*self%reach*self%degree
   end function past_size

   !> Take delayed values from as far back as the delay says: disturbances are not periodic.
   pure subroutine reach_back(self)
      class(orbit_passes_type), intent(inout) :: self

      self%source = self%source - self%later*self%intervals
      self%later = 0
      if (size(self%row) > 0) self%reach = max(0, 1 - minval(self%source))
   end subroutine reach_back

   !> Prepare passes that find sums over the nodes.
   subroutine prepare(self, weights)
      class(orbit_passes_type), intent(inout) :: self
      !> Weights of each sum, shape (n, nodes, sums)
      real(wp), intent(in) :: weights(:, :, :)
      real(wp) :: total(size(self%response, 1))
      integer :: i, j, k, l, last

      if (allocated(self%lead)) deallocate (self%lead)
      self%at_start = weights(:, 1, :)
      associate (n => self%n, m => self%degree, d => size(self%delayed), sums => size(weights, 3))
         last = n + (m - 1)*d
         allocate (self%lead(together, (last + sums + together - 1)/together, size(total), &
                             self%intervals), source=0.0_wp)
         do i = 1, self%intervals
            do j = 1, n
               call put(j, self%response(:, (m - 1)*n + j, i))
            end do
            do k = 1, m - 1
               do j = 1, d
                  call put(n + (k - 1)*d + j, self%response(:, (k - 1)*n + self%delayed(j), i))
               end do
            end do
            do l = 1, sums
               total = 0.0_wp
               do k = 1, m
                  do j = 1, n
                     total = total + weights(j, (i - 1)*m + 1 + k, l) &
                                     *self%response(:, (k - 1)*n + j, i)
                  end do
               end do
               call put(last + l, total)
            end do
         end do
      end associate

   contains

      !> Set a number of the answer of interval i.
      subroutine put(place, response)
         integer, intent(in) :: place
         real(wp), intent(in) :: response(:)

         self%lead(modulo(place - 1, together) + 1, (place - 1)/together + 1, :, i) = response
      end subroutine put
   end subroutine prepare

   !> The past a period later, and sums, that follow from a past and forcings.
   pure subroutine pass(self, past, forcing, later, sums, nodes)
      class(orbit_passes_type), intent(in) :: self
      !> State at s = 0, delayed components at nodes before, ascending
      real(wp), intent(in) :: past(:)
      !> Forcings; those that are left out are 0
      real(wp), intent(in) :: forcing(:)
      real(wp), intent(out) :: later(:)
      !> The sums for which passes were prepared
      real(wp), intent(out) :: sums(:)
      !> State at the nodes, shape (n, intervals m + 1)
      real(wp), intent(out), optional :: nodes(:, :)
      ! at all nodes, also of the past
      real(wp) :: delayed((self%reach + self%intervals)*self%degree + 1, size(self%delayed))
      real(wp) :: answer(together*size(self%lead, 2)), input(self%inputs() + size(forcing))
      real(wp) :: part(together), value
      integer :: column, first, i, j, k, l, node

      associate (n => self%n, m => self%degree, d => size(self%delayed))
         node = self%reach*m
         do j = 1, d
            delayed(:node, j) = past(n + j::d)
            delayed(node + 1, j) = past(self%delayed(j))
         end do
         delayed(node + 2:, :) = 0.0_wp
         sums = matmul(past(:n), self%at_start)
         input(:n) = past(:n)
         input(self%inputs() + 1:) = forcing
         if (present(nodes)) nodes(:, 1) = past(:n)
         do i = 1, self%intervals
            column = n
            do k = 1, m
               do l = 1, size(self%row)
                  column = column + 1
                  first = (self%source(l, k, i) - 1 + self%reach)*m
                  value = 0.0_wp
                  do j = 1, m + 1
                     value = value + self%weight(j, l, k, i)*delayed(first + j, self%row(l))
                  end do
                  input(column) = value
               end do
            end do
            do l = 1, size(self%lead, 2)
               part = 0.0_wp
               do column = 1, size(input)
                  do j = 1, together
                     part(j) = part(j) + input(column)*self%lead(j, l, column, i)
                  end do
               end do
               answer(together*(l - 1) + 1:together*l) = part
            end do
            if (present(nodes)) then
               do k = 1, m
                  do j = 1, n
                     nodes(j, (i - 1)*m + 1 + k) &
                        = dot_product(input, self%response(:size(input), (k - 1)*n + j, i))
                  end do
               end do
            end if
            input(:n) = answer(:n)
            node = (self%reach + i - 1)*m + 1
            do k = 1, m - 1
               do j = 1, d
                  delayed(node + k, j) = answer(n + (k - 1)*d + j)
               end do
            end do
            delayed(node + m, :) = answer(self%delayed)
            first = n + (m - 1)*d
            sums = sums + answer(first + 1:first + size(sums))
         end do
         later(:n) = input(:n)
         do j = 1, d
            later(n + j::d) = delayed(self%intervals*m + 1:size(delayed, 1) - 1, j)
         end do
      end associate
   end subroutine pass
end module orbit_passes
