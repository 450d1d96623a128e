!> Small changes of a periodic orbit. On one interval of the mesh the nodes follow from the left
!> end, the delayed values and the forcing. So all follow, interval by interval, from the past.
module orbit_passes
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: orbit_passes_type

   !> Linear equations for changes of an orbit. The past has the state at s = 0 and the delayed
   !> components at the nodes of the last `reach` intervals before.
   type :: orbit_passes_type
      !> Number of equations n, degree m, intervals, and intervals of the past
      integer :: n = 0, degree = 0, intervals = 0, reach = 0
      !> Components that are delayed
      integer, allocatable :: delayed(:)
      !> Which of them each delayed value is
      integer, allocatable :: row(:)
      !> First node from which a delayed value is interpolated, counted from the start of the past,
      !> shape (delays, m, intervals)
      integer, allocatable :: source(:, :, :)
      !> Weights of it and the m following ones, shape (m + 1, delays, m, intervals); 0 where the
      !> delay does not reach out of the interval
      real(wp), allocatable :: weight(:, :, :, :)
      !> Answer of an interval's nodes but the first, shape (n m, inputs, intervals). Inputs: state
      !> at the left end (n), delayed values at the points (delays m), forcings: the residual, a
      !> relative change of the period, changes of free parameters in their units.
      real(wp), allocatable :: response(:, :, :)
   contains
      procedure :: past_size, pass
   end type orbit_passes_type

contains

   !> Numbers of a past.
   pure integer function past_size(self) result(value)
      class(orbit_passes_type), intent(in) :: self

      value = self%n + size(self%delayed)*self%reach*self%degree
   end function past_size

   !> Nodes over a period, and the past a period later, that follow from a past and forcings.
   pure subroutine pass(self, past, forcing, nodes, later)
      class(orbit_passes_type), intent(in) :: self
      !> State at s = 0, delayed components at nodes before, ascending
      real(wp), intent(in) :: past(:)
      real(wp), intent(in) :: forcing(:)
      !> State at the nodes, shape (n (intervals m + 1)): node by node
      real(wp), intent(out) :: nodes(:)
      real(wp), intent(out) :: later(:)
      ! at all nodes, also of the past
      real(wp) :: delayed(size(self%delayed), (self%reach + self%intervals)*self%degree + 1)
      real(wp) :: answer(self%n*self%degree), input(size(self%response, 2))
      integer :: column, first, i, k, l, node

      associate (n => self%n, m => self%degree, lags => size(self%row))
         node = self%reach*m
         delayed(:, :node) = reshape(past(n + 1:), [size(self%delayed), node])
         delayed(:, node + 1) = past(self%delayed)
         delayed(:, node + 2:) = 0.0_wp
         nodes(:n) = past(:n)
         input(n + m*lags + 1:) = forcing
         do i = 1, self%intervals
            first = (i - 1)*m*n
            input(:n) = nodes(first + 1:first + n)
            column = n
            do k = 1, m
               do l = 1, lags
                  column = column + 1
                  associate (from => self%source(l, k, i))
                     input(column) = dot_product(self%weight(:, l, k, i), &
                                                 delayed(self%row(l), from:from + m))
                  end associate
               end do
            end do
            answer = 0.0_wp
            do column = 1, size(input)
               answer = answer + input(column)*self%response(:, column, i)
            end do
            first = first + n
            nodes(first + 1:first + n*m) = answer
            do k = 1, m
               node = (self%reach + i - 1)*m + k + 1
               delayed(:, node) = answer((k - 1)*n + self%delayed)
            end do
         end do
         later(:n) = nodes(size(nodes) - n + 1:)
         later(n + 1:) = reshape(delayed(:, self%intervals*m + 1:size(delayed, 2) - 1), &
                                 [size(later) - n])
      end associate
   end subroutine pass
end module orbit_passes
