! SPDX-License-Identifier: BSD-3-Clause
!> Slopes at even times of a function known at uneven times, for spectra of motions whose fast
!> events are shorter than the time between even samples.
module even_slope
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: finer, smoothed_slope, undo_smoothing

   !> Even samples within one interval of an uneven trajectory.
   integer, parameter :: finer = 16

contains

   !> Means of du/dt over a hat of half-width h, at t(1) + h, t(1) + 2 h, ...: the means of u over
   !> two neighbouring intervals differ by h times that mean. The hat multiplies the amplitude at
   !> frequency f by (sin(pi f h)/(pi f h))^2, so that aliases of short events are small. Between
   !> its times u is a cubic.
   pure function smoothed_slope(t, u, slope, h) result(means)
      !> Times, ascending; u at these times; du/dt at these times; time between the means
      real(wp), intent(in) :: t(:), u(:), slope(:), h
      real(wp), allocatable :: means(:)
      real(wp) :: from, to
      integer :: i, j

      allocate (means(int((t(size(t)) - t(1))/h)), source=0.0_wp)
      j = 1
      to = t(1)
      do i = 1, size(means)
         do while (to < t(1) + i*h)
            from = to
            if (from >= t(j + 1)) j = j + 1
            to = min(t(j + 1), t(1) + i*h)
            means(i) = means(i) + 0.5_wp*(to - from)/h*(cubic(j, from) + cubic(j, to))
         end do
      end do
      means = (means(2:) - means(:size(means) - 1))/h

   contains

      !> u between two of its times.
      pure real(wp) function cubic(j, time) result(value)
         !> Number of the first of both
         integer, intent(in) :: j
         real(wp), intent(in) :: time
         real(wp) :: d, s

         d = t(j + 1) - t(j)
         s = (time - t(j))/d
         value = (1.0_wp - s)**2*((1.0_wp + 2.0_wp*s)*u(j) + d*s*slope(j)) &
                 + s**2*((3.0_wp - 2.0_wp*s)*u(j + 1) - d*(1.0_wp - s)*slope(j + 1))
      end function cubic
   end function smoothed_slope

   !> Divide a power spectrum by that of the hat, and keep it up to the frequency of two intervals
   !> of the trajectory.
   pure subroutine undo_smoothing(h, frequency, power)
      !> Half-width of the hat
      real(wp), intent(in) :: h
      !> Frequencies from 0 on, power spectral density there
      real(wp), allocatable, intent(inout) :: frequency(:), power(:)
      real(wp), allocatable :: angle(:)

      frequency = pack(frequency, frequency <= 0.5_wp/(finer*h))
      angle = acos(-1.0_wp)*h*frequency(2:)
      power = [power(1), power(2:size(frequency))*(angle/sin(angle))**4]
   end subroutine undo_smoothing
end module even_slope
