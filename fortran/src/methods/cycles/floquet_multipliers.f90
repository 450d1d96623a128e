!> Floquet multipliers of a periodic orbit: eigenvalues of the map that takes a small disturbance of
!> the past over one period.
module floquet_multipliers
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use linear_map, only: leading_eigenvalues, linear_map_type
   use model_family, only: family_type
   use orbit_linearisation, only: linearise_orbit
   use orbit_passes, only: orbit_passes_type
   use periodic_orbit, only: periodic_orbit_type
   implicit none (type, external)
   private
   public :: find_largest_multiplier, find_multipliers, multipliers_type

   !> Multipliers of an orbit.
   type :: multipliers_type
      !> Those wanted without the trivial one, in descending order of modulus; of a pair the
      !> one with positive imaginary part first
      complex(wp), allocatable :: values(:)
      !> Distance of the trivial multiplier from 1: the accuracy
      real(wp) :: trivial_error = 0.0_wp
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
   subroutine find_multipliers(family, orbit, wanted, found, error, disturbances, linear)
      !> The model and its free parameters
      type(family_type), intent(in) :: family
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> Number of multipliers
      integer, intent(in) :: wanted
      !> What was found
      type(multipliers_type), intent(out) :: found
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      !> Disturbances over the period at the nodes of the orbit, shape (n, nodes, multipliers)
      complex(wp), allocatable, intent(out), optional :: disturbances(:, :, :)
      !> Linear equations about the orbit, if they are known
      type(orbit_passes_type), intent(in), optional :: linear
      complex(wp), allocatable :: pasts(:, :), values(:)
      type(period_map_type) :: map
      integer :: i, kept, trivial

      call find_eigenvalues(family, orbit, wanted + 1, map, values, pasts, error, linear)
      if (allocated(error)) return
      trivial = minloc(abs(values - 1.0_wp), dim=1)
      found%trivial_error = abs(values(trivial) - 1.0_wp)
      found%values = pack(values, [(i /= trivial, i=1, size(values))])
      if (.not. present(disturbances)) return
      allocate (disturbances(size(orbit%nodes, 1), size(orbit%nodes, 2), size(found%values)))
      kept = 0
      do i = 1, size(values)
         if (i == trivial) cycle
         kept = kept + 1
         disturbances(:, :, kept) = cmplx(over_period(map, real(pasts(:, i)), orbit), &
                                          over_period(map, aimag(pasts(:, i)), orbit), kind=wp)
      end do
   end subroutine find_multipliers

   !> The largest modulus of all multipliers. They may be those of disturbances of which none is the
   !> flow: then no multiplier is trivial.
   subroutine find_largest_multiplier(family, orbit, modulus, error)
      !> Problems; a solution of them is the orbit
      type(family_type), intent(in) :: family
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> The modulus
      real(wp), intent(out) :: modulus
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: pasts(:, :), values(:)
      type(period_map_type) :: map

      modulus = 0.0_wp
      call find_eigenvalues(family, orbit, 1, map, values, pasts, error)
      if (allocated(error)) return
      modulus = abs(values(1))
   end subroutine find_largest_multiplier

   !> Eigenvalues of greatest modulus of the map of the past, and their eigenvectors.
   subroutine find_eigenvalues(family, orbit, wanted, map, values, pasts, error, linear)
      type(family_type), intent(in) :: family
      type(periodic_orbit_type), intent(in) :: orbit
      integer, intent(in) :: wanted
      !> The map
      type(period_map_type), intent(out) :: map
      complex(wp), allocatable, intent(out) :: values(:)
      !> Eigenvectors, shape (numbers of a past, size(values))
      complex(wp), allocatable, intent(out) :: pasts(:, :)
      type(error_type), allocatable, intent(out) :: error
      type(orbit_passes_type), intent(in), optional :: linear
      real(wp) :: no_sums(size(orbit%nodes, 1), size(orbit%nodes, 2), 0)

      if (present(linear)) then
         map%linear = linear
         call map%linear%reach_back()
      else
         call linearise_orbit(family, orbit, .true., map%linear, error)
         if (allocated(error)) return
      end if
      call map%linear%prepare(no_sums)
      call leading_eigenvalues(map, map%linear%past_size(), wanted, tolerance, values, pasts, error)
   end subroutine find_eigenvalues

   !> A disturbance over the period.
   function over_period(map, past, orbit) result(disturbance)
      type(period_map_type), intent(inout) :: map
      real(wp), intent(in) :: past(:)
      type(periodic_orbit_type), intent(in) :: orbit
      real(wp) :: disturbance(size(orbit%nodes, 1), size(orbit%nodes, 2)), later(size(past))
      real(wp) :: no_sums(0)

      call map%linear%pass(past, [real(wp) ::], later, no_sums, disturbance)
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
