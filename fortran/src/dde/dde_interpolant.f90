!> The polynomial that a step leaves behind, in Newton form over s = (t - t_n)/h,
!>
!>     p(s) = a(0) + (s - x(1)) [a(1) + (s - x(2)) [a(2) + ... ]],
!>
!> whose nodes x belong to the method and whose coefficients a to the step and component.
module dde_interpolant
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: newton_value

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
end module dde_interpolant
