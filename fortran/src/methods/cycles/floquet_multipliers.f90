! SPDX-License-Identifier: BSD-3-Clause
!> Floquet multipliers of a periodic orbit: eigenvalues of the map that takes a small disturbance of
!> the past over one period.
module floquet_multipliers
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use orbit_map, only: leading_eigenvalues, linear_map_type
   use orbit_passes, only: orbit_passes_type
   implicit none (type, external)
   private
   public :: find_multipliers, multipliers_type

   !> Multipliers of an orbit.
   type :: multipliers_type
      !> Those wanted without the trivial one, in descending order of modulus; of a pair the
      !> one with positive imaginary part first
      complex(wp), allocatable :: values(:)
      !> Distance of the trivial multiplier from 1: the accuracy
      real(wp) :: trivial_error = 0.0_wp
      !> Greatest modulus of all. Where no disturbance is the flow, none of them is trivial.
      real(wp) :: greatest = 0.0_wp
   contains
      procedure :: unstable
   end type multipliers_type

   !> Residual of an eigenvector over the greatest modulus.
   real(wp), parameter :: tolerance = 1.0e-11_wp

   !> The map of the past.
   type, extends(linear_map_type) :: period_map_type
      !> Linear equations about the orbit
      type(orbit_passes_type) :: linear
   contains
      procedure :: apply => past_after_period
   end type period_map_type

contains

   !> Multipliers of greatest modulus.
   subroutine find_multipliers(linear, wanted, found, error, disturbances)
      !> Linear equations about the orbit
      type(orbit_passes_type), intent(in) :: linear
      !> Number of multipliers
      integer, intent(in) :: wanted
      !> What was found
      type(multipliers_type), intent(out) :: found
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      !> Disturbances over the period at the nodes of the orbit, shape (n, nodes, multipliers)
      complex(wp), allocatable, intent(out), optional :: disturbances(:, :, :)
      complex(wp), allocatable :: pasts(:, :), values(:)
      type(period_map_type) :: map
      real(wp) :: no_sums(linear%n, linear%intervals*linear%degree + 1, 0)
      integer :: i, kept, trivial

      map%linear = linear
      call map%linear%reach_back()
      call map%linear%prepare(no_sums)
      call leading_eigenvalues(map, map%linear%past_size(), wanted + 1, tolerance, values, pasts, &
                               error)
      if (allocated(error)) return
      found%greatest = abs(values(1))
      trivial = minloc(abs(values - 1.0_wp), dim=1)
      found%trivial_error = abs(values(trivial) - 1.0_wp)
      found%values = pack(values, [(i /= trivial, i=1, size(values))])
      if (.not. present(disturbances)) return
      allocate (disturbances(size(no_sums, 1), size(no_sums, 2), size(found%values)))
      kept = 0
      do i = 1, size(values)
         if (i == trivial) cycle
         kept = kept + 1
         disturbances(:, :, kept) = cmplx(over_period(map%linear, real(pasts(:, i))), &
                                          over_period(map%linear, aimag(pasts(:, i))), kind=wp)
      end do
   end subroutine find_multipliers

   !> A disturbance over the period.
   pure function over_period(linear, past) result(disturbance)
      type(orbit_passes_type), intent(in) :: linear
      real(wp), intent(in) :: past(:)
      real(wp) :: disturbance(linear%n, linear%intervals*linear%degree + 1), later(size(past))
      real(wp) :: no_sums(0)

      call linear%pass(past, [real(wp) ::], later, no_sums, disturbance)
   end function over_period

   !> The past a period later.
   subroutine past_after_period(self, vector, image)
      class(period_map_type), intent(inout) :: self
      real(wp), intent(in) :: vector(:)
      real(wp), intent(out) :: image(:)
      real(wp) :: no_sums(0)

      call self%linear%pass(vector, [real(wp) ::], image, no_sums)
   end subroutine past_after_period

   !> Number of multipliers outside of the unit circle.
   pure integer function unstable(self) result(value)
      class(multipliers_type), intent(in) :: self

      value = count(abs(self%values) > 1.0_wp)
   end function unstable
end module floquet_multipliers
