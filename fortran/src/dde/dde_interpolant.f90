!> The polynomial that a step leaves behind, in Newton form over s = (t - t_n)/h,
!>
!>     p(s) = a(0) + (s - x(1)) [a(1) + (s - x(2)) [a(2) + ... ]],
!>
!> whose nodes x belong to the method and whose coefficients a to the step and component.
module dde_interpolant
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: newton_state, newton_value

contains

   !> Value of p at s.
   pure function newton_value(nodes, coefficients, s) result(value)
      !> Nodes x(1..degree) of the method
      real(wp), intent(in) :: nodes(:)
      !> Coefficients a(0..degree)
      real(wp), intent(in) :: coefficients(0:size(nodes))
      !> Place in the step, 0..1
      real(wp), intent(in) :: s
      real(wp) :: value
      integer :: j

      value = coefficients(size(nodes))
      do j = size(nodes), 1, -1
         value = coefficients(j - 1) + (s - nodes(j))*value
      end do
   end function newton_value

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
