! SPDX-License-Identifier: BSD-3-Clause
!> Meshes that follow an orbit: the (m + 1)-th derivative of each component, scaled by the range of
!> the component, is distributed evenly (de Boor 1973; Ascher, Christiansen and Russell 1979, Math.
!> Comp. 33, 659). It is found from the jumps of the m-th derivative between intervals.
module orbit_mesh
   use dde_kinds, only: wp
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: adapted_mesh, uniform_mesh

   !> Share of the intervals that is distributed evenly in time, against gaps.
   real(wp), parameter :: even_share = 0.1_wp

contains

   !> A mesh of intervals of one length.
   pure function uniform_mesh(intervals) result(mesh)
      !> Number of intervals
      integer, intent(in) :: intervals
      real(wp) :: mesh(intervals + 1)
      integer :: i

      mesh = [(real(i, wp)/intervals, i=0, intervals)]
   end function uniform_mesh

   !> A mesh of which each interval has the same share of the integral of the density of intervals.
   pure function adapted_mesh(orbit, intervals) result(mesh)
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> Number of intervals
      integer, intent(in) :: intervals
      real(wp) :: mesh(intervals + 1)
      real(wp) :: density(size(orbit%mesh) - 1), part(0:size(orbit%mesh) - 1), wanted
      integer :: i, old

      density = density_of(orbit)
      part(0) = 0.0_wp
      do i = 1, size(density)
         part(i) = part(i - 1) + density(i)*(orbit%mesh(i + 1) - orbit%mesh(i))
      end do
      ! part of the intervals follows time itself
      associate (whole => part(size(density)))
         if (whole <= 0.0_wp) then
            mesh = uniform_mesh(intervals)
            return
         end if
         part = part/whole*(1.0_wp - even_share) + even_share*orbit%mesh
      end associate
      old = 1
      mesh(1) = 0.0_wp
      do i = 1, intervals - 1
         wanted = real(i, wp)/intervals
         do while (part(old) < wanted)
            old = old + 1
         end do
         mesh(i + 1) = orbit%mesh(old) + (orbit%mesh(old + 1) - orbit%mesh(old)) &
                       *(wanted - part(old - 1))/(part(old) - part(old - 1))
      end do
      mesh(intervals + 1) = 1.0_wp
   end function adapted_mesh

   !> Scaled (m + 1)-th derivative to the power 1/(m + 1) in each interval.
   pure function density_of(orbit) result(density)
      type(periodic_orbit_type), intent(in) :: orbit
      real(wp) :: density(size(orbit%mesh) - 1)
      real(wp) :: derivative(size(orbit%nodes, 1), 0:size(density) + 1)
      real(wp) :: jump(size(density) + 1), length(0:size(density) + 1)
      real(wp) :: range(size(orbit%nodes, 1))
      integer :: i, last

      last = size(density)
      range = maxval(orbit%nodes, dim=2) - minval(orbit%nodes, dim=2)
      associate (m => orbit%basis%degree)
         do i = 1, last
            length(i) = orbit%mesh(i + 1) - orbit%mesh(i)
            derivative(:, i) = matmul(orbit%nodes(:, (i - 1)*m + 1:i*m + 1), orbit%basis%leading) &
                               /length(i)**m*gamma(m + 1.0_wp)
         end do
         length(0) = length(last)
         length(last + 1) = length(1)
         derivative(:, 0) = derivative(:, last)
         derivative(:, last + 1) = derivative(:, 1)
         do i = 1, last + 1
            jump(i) = norm2((derivative(:, i) - derivative(:, i - 1))/max(range, tiny(1.0_wp))) &
                      /(0.5_wp*(length(i) + length(i - 1)))
         end do
         do i = 1, last
            density(i) = (0.5_wp*(jump(i) + jump(i + 1)))**(1.0_wp/(m + 1))
         end do
      end associate
   end function density_of
end module orbit_mesh
