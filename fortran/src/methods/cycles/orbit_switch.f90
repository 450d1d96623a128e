!> The branch of orbits of twice the period that starts at a period doubling.
module orbit_switch
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use orbit_change, only: orbit_change_type
   use periodic_orbit, only: periodic_orbit_type
   use problem_family, only: problem_family_type
   use special_points, only: period_doubling, special_point_type
   implicit none (type, external)
   private
   public :: orbit_of_double_period

   !> Multipliers among which that at -1 is looked for.
   integer, parameter :: multipliers_wanted = 8

contains

   !> First approximation of an orbit on the branch: the orbit passed twice, plus a multiple of the
   !> disturbance v with v(s + 1) = -v(s).
   subroutine orbit_of_double_period(family, point, amplitude, orbit, tangent, error)
      !> The problems
      class(problem_family_type), intent(in) :: family
      !> The period doubling
      type(special_point_type), intent(in) :: point
      !> Largest change of a component
      real(wp), intent(in) :: amplitude
      !> The orbit
      type(periodic_orbit_type), intent(out) :: orbit
      !> Direction of growing amplitude
      type(orbit_change_type), intent(out) :: tangent
      !> Error if the point is no period doubling
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: disturbances(:, :, :)
      type(multipliers_type) :: multipliers
      integer :: critical, last

      if (point%kind /= period_doubling) then
         call raise(error, "double period: a point of kind "//trim(point%kind)//"; " &
                    //period_doubling//" expected")
         return
      end if
      call find_multipliers(family, point%orbit, multipliers_wanted, multipliers, error, &
                            disturbances)
      if (allocated(error)) return
      critical = minloc(abs(multipliers%values + 1.0_wp), dim=1)
      last = size(point%orbit%nodes, 2)
      allocate (tangent%nodes(size(point%orbit%nodes, 1), 2*last - 1))
      associate (v => real(disturbances(:, :, critical)))
         tangent%nodes(:, :last) = v/maxval(abs(v))
      end associate
      tangent%nodes(:, last + 1:) = -tangent%nodes(:, 2:last)
      tangent%nodes(:, 2*last - 1) = tangent%nodes(:, 1)
      tangent%parameters = [0.0_wp]
      orbit = point%orbit
      orbit%period = 2.0_wp*orbit%period
      associate (mesh => point%orbit%mesh)
         orbit%mesh = [0.5_wp*mesh, 0.5_wp + 0.5_wp*mesh(2:)]
      end associate
      orbit%nodes = reshape([point%orbit%nodes, point%orbit%nodes(:, 2:)], shape(tangent%nodes)) &
                    + amplitude*tangent%nodes
   end subroutine orbit_of_double_period
end module orbit_switch
