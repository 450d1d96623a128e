!> The polynomial that a step leaves behind, in Newton form over s = (t - t_n)/h,
!>
!>     p(s) = a(0) + (s - x(1)) [a(1) + (s - x(2)) [a(2) + ... ]],
!>
!> whose nodes x belong to the method and whose coefficients a to the step and component.
module dde_interpolant
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: highest_degree, newton_state, newton_value, newton_values

   !> Highest degree of an interpolant.
   integer, parameter :: highest_degree = 8

contains

   !> Value of p at s.
   pure function newton_value(degree, nodes, coefficients, s) result(value)
      !> Degree of p
      integer, intent(in) :: degree
      !> Nodes x(1..degree) of the method
      real(wp), intent(in) :: nodes(degree)
      !> Coefficients a(0..degree)
      real(wp), intent(in) :: coefficients(0:degree)
      !> Place in the step, 0..1
      real(wp), intent(in) :: s
      real(wp) :: value
      integer :: j

      value = coefficients(degree)
      do j = degree, 1, -1
         value = coefficients(j - 1) + (s - nodes(j))*value
      end do
   end function newton_value

   !> Values of p at ascending places, from the `first` on as far as they lie within a limit;
   !> written out for the highest degree, since delayed values are what a step asks for most.
   pure subroutine newton_values(x, a, offset, length, limit, places, ahead, first, values)
      !> Nodes
      real(wp), intent(in) :: x(highest_degree)
      !> Coefficients, 0 above the degree of p
      real(wp), intent(in) :: a(0:highest_degree)
      !> Time from the start of p's step to the origin of `ahead`
      real(wp), intent(in) :: offset
      !> Length of p's step
      real(wp), intent(in) :: length
      !> Time since the start of p's step up to which p serves
      real(wp), intent(in) :: limit
      !> Number of places
      integer, intent(in) :: places
      !> Places as times, ascending
      real(wp), intent(in) :: ahead(places)
      !> First place to serve; moved on to the first that lies beyond the limit
      integer, intent(inout) :: first
      !> Values at all places
      real(wp), intent(inout) :: values(places)
      real(wp) :: s
      integer :: i

      do i = first, places
         if (offset + ahead(i) > limit) exit
         s = (offset + ahead(i))/length
         values(i) = a(0) + (s - x(1))*(a(1) + (s - x(2))*(a(2) + (s - x(3))*(a(3) &
                     + (s - x(4))*(a(4) + (s - x(5))*(a(5) + (s - x(6))*(a(6) &
                     + (s - x(7))*(a(7) + (s - x(8))*a(8))))))))
      end do
      first = i
   end subroutine newton_values

   !> Values at s of several polynomials over the same nodes, and their derivatives by s.
   pure subroutine newton_state(nodes, coefficients, s, values, slopes)
      !> Nodes x(1..degree) of the method
      real(wp), intent(in) :: nodes(:)
      !> Coefficients a(0..degree) of each, shape (polynomials, 0:degree)
      real(wp), intent(in) :: coefficients(:, 0:)
      !> Place in the step, 0..1
      real(wp), intent(in) :: s
      !> Values, shape (polynomials)
      real(wp), intent(out) :: values(:)
      !> Derivatives, shape (polynomials)
      real(wp), intent(out) :: slopes(:)
      integer :: i, j

      do i = 1, size(values)
         values(i) = coefficients(i, size(nodes))
         slopes(i) = 0.0_wp
         do j = size(nodes), 1, -1
            slopes(i) = values(i) + (s - nodes(j))*slopes(i)
            values(i) = coefficients(i, j - 1) + (s - nodes(j))*values(i)
         end do
      end do
   end subroutine newton_state
end module dde_interpolant
