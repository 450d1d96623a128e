!> The polynomial that a step leaves behind, in Newton form over s = (t - t_n)/h,
!>
!>     p(s) = a(0) + (s - x(1)) [a(1) + (s - x(2)) [a(2) + ... ]],
!>
!> whose nodes x belong to the method and whose coefficients a to the step and component.
module dde_interpolant
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: newton_slope, newton_value

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

   !> Derivative of p at s, by s.
   pure function newton_slope(nodes, coefficients, s) result(slope)
      !> Nodes x(1..degree) of the method
      real(wp), intent(in) :: nodes(:)
      !> Coefficients a(0..degree)
      real(wp), intent(in) :: coefficients(0:size(nodes))
      !> Place in the step, 0..1
      real(wp), intent(in) :: s
      real(wp) :: slope, value
      integer :: j

      value = coefficients(size(nodes))
      slope = 0.0_wp
      do j = size(nodes), 1, -1
         slope = value + (s - nodes(j))*slope
         value = coefficients(j - 1) + (s - nodes(j))*value
      end do
   end function newton_slope
end module dde_interpolant
