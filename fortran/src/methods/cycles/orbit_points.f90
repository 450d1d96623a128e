! SPDX-License-Identifier: BSD-3-Clause
!> Special points on branches of periodic orbits: folds, period doublings, torus (Neimark-Sacker)
!> points, and points at which another branch crosses. Each is a root of a test function on the
!> segment between two orbits, and each is found on two meshes.
module orbit_points
   use branch_ends, only: follow_settings_type
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use floquet_multipliers, only: find_multipliers, multipliers_type
   use model_family, only: family_type
   use orbit_branch, only: branch_type
   use orbit_change, only: difference_of, inner_product, orbit_change_type
   use orbit_equations, only: correct_orbit, newton_type, turn_to_tangent
   use orbit_mesh, only: adapted_mesh
   use periodic_orbit, only: periodic_orbit_type
   use sign_change, only: sign_change_type
   use special_points, only: branching, fold, judge_point, period_doubling, special_point_type, &
                             torus_bifurcation
   use torus_normal_form, only: find_torus_coefficient
   implicit none (type, external)
   private
   public :: find_special_points

   !> Intervals of a mesh over those of the one before, and the difference of the parameter between
   !> two meshes that agree, in its unit
   real(wp), parameter :: refinement = 1.5_wp, agreement = 1.0e-10_wp
   !> Iterations of a root search, and the share of the segment to which it goes
   integer, parameter :: most_iterations = 60
   real(wp), parameter :: share = 1.0e-11_wp
   !> A test function is 0 where it is this small; a jump is larger.
   real(wp), parameter :: small = 1.0e-6_wp
   !> Distance from a torus point at which the growth is found, over the segment
   real(wp), parameter :: beside = 0.01_wp
   !> Halvings of a segment with several special points
   integer, parameter :: most_halvings = 8

   !> The orbits between two of a branch, in the direction from the first to the second.
   type :: segment_type
      !> First and second orbit, on one mesh
      type(periodic_orbit_type) :: ends(2)
      !> Direction, of norm 1
      type(orbit_change_type) :: along(1)
      !> Distance of the two
      real(wp) :: length = 0.0_wp
   end type segment_type

contains

   !> Special points on a branch.
   subroutine find_special_points(settings, branch, points, missed, reasons)
      !> How the branch was followed
      type(follow_settings_type), intent(in) :: settings
      !> The branch
      type(branch_type), intent(in) :: branch
      !> The points, in the order of the branch
      type(special_point_type), allocatable, intent(out) :: points(:)
      !> Orbits after which multipliers change so that a point is there that was not found, and why
      integer, allocatable, intent(out) :: missed(:)
      type(error_type), allocatable, intent(out) :: reasons(:)
      type(error_type), allocatable :: error
      integer :: i

      allocate (points(0), missed(0), reasons(0))
      do i = 1, size(branch%orbits) - 1
         call search_between(settings, branch%orbits(i), branch%orbits(i + 1), &
                             [sign(1.0_wp, branch%tangents(i)%parameters(1)), &
                              sign(1.0_wp, branch%tangents(i + 1)%parameters(1))], &
                             branch%multipliers(i), branch%multipliers(i + 1), most_halvings, &
                             points, error)
         if (.not. allocated(error)) cycle
         missed = [missed, i]
         reasons = [reasons, error]
      end do
   end subroutine find_special_points

   !> Special points between two orbits.
   recursive subroutine search_between(settings, first, second, signs, before, behind, &
                                       halvings, points, error)
      type(follow_settings_type), intent(in) :: settings
      type(periodic_orbit_type), intent(in) :: first, second
      !> Direction of the parameter there, 1 or -1
      real(wp), intent(in) :: signs(2)
      type(multipliers_type), intent(in) :: before, behind
      integer, intent(in) :: halvings
      type(special_point_type), allocatable, intent(inout) :: points(:)
      type(error_type), allocatable, intent(out) :: error
      type(multipliers_type) :: between
      type(newton_type) :: newton
      type(orbit_change_type) :: tangent
      type(periodic_orbit_type) :: middle
      type(segment_type) :: segment
      type(special_point_type) :: point
      integer :: change
      logical :: folds
      real(wp) :: sign_between

      change = behind%unstable() - before%unstable()
      folds = signs(1)*signs(2) < 0.0_wp
      if (change == 0 .and. .not. folds) return
      point%kind = ""
      if (folds .and. abs(change) == 1) point%kind = fold
      if (.not. folds .and. abs(change) == 2) point%kind = torus_bifurcation
      if (.not. folds .and. abs(change) == 1) then
         point%kind = branching
         if (count(real(before%values) < -1.0_wp) /= count(real(behind%values) < -1.0_wp)) then
            point%kind = period_doubling
         end if
      end if
      segment = segment_between(first, second, settings%family)
      if (point%kind /= "") then
         point%unstable = [before%unstable(), behind%unstable()]
         call locate_on_meshes(settings, segment, point, error)
         if (.not. allocated(error)) then
            points = [points, point]
            return
         end if
      end if
      if (halvings == 0) then
         if (.not. allocated(error)) call raise(error, "special points: "//text(change) &
                                                //" multipliers cross within a step")
         return
      end if
      if (allocated(error)) deallocate (error)
      call find_orbit_at(settings%family, segment, 0.5_wp, middle, newton, error)
      if (allocated(error)) return
      call find_multipliers(newton%linear, settings%refinement%multipliers, between, error)
      if (allocated(error)) return
      tangent = segment%along(1)
      call turn_to_tangent(middle, newton%linear, tangent, error)
      if (allocated(error)) return
      sign_between = sign(1.0_wp, tangent%parameters(1))
      call search_between(settings, first, middle, [signs(1), sign_between], before, between, &
                          halvings - 1, points, error)
      if (allocated(error)) return
      call search_between(settings, middle, second, [sign_between, signs(2)], between, behind, &
                          halvings - 1, points, error)
   end subroutine search_between

   !> Find a point on the mesh of the segment, then on finer ones until the last two agree.
   subroutine locate_on_meshes(settings, segment, point, error)
      type(follow_settings_type), intent(in) :: settings
      type(segment_type), intent(in) :: segment
      type(special_point_type), intent(inout) :: point
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: finer(:)
      real(wp) :: coarse
      integer :: intervals, p
      type(periodic_orbit_type) :: first

      call locate_point(settings, segment, point, error)
      if (allocated(error)) return
      call set_coefficient(settings, point)
      p = settings%family%free(1)
      coarse = point%orbit%parameters(p)
      do
         intervals = nint(refinement*point%orbit%intervals())
         finer = adapted_mesh(point%orbit, intervals)
         first = segment%ends(1)%on_mesh(finer)
         call locate_point(settings, segment_between(first, segment%ends(2), settings%family), &
                           point, error)
         if (allocated(error)) return
         call set_coefficient(settings, point)
         point%mesh_error = abs(point%orbit%parameters(p) - coarse)
         coarse = point%orbit%parameters(p)
         if (point%mesh_error <= agreement*settings%family%unit(1)) return
         if (intervals >= settings%refinement%most_intervals) return
      end do
   end subroutine locate_on_meshes

   !> Set the coefficient of a torus point on this mesh, and its difference from that before.
   subroutine set_coefficient(settings, point)
      type(follow_settings_type), intent(in) :: settings
      type(special_point_type), intent(inout) :: point
      type(error_type), allocatable :: failure
      real(wp) :: coefficient, disturbed(size(point%orbit%nodes, 1))

      if (point%kind /= torus_bifurcation) return
      call find_torus_coefficient(settings%family, point%orbit, point%multiplier, &
                                  settings%refinement%multipliers, coefficient, disturbed, failure)
      if (allocated(point%coefficient_error)) deallocate (point%coefficient_error)
      if (allocated(failure)) then
         if (allocated(point%coefficient)) deallocate (point%coefficient)
         return
      end if
      if (allocated(point%coefficient)) then
         point%coefficient_error = abs(coefficient - point%coefficient)
      end if
      point%coefficient = coefficient
      point%disturbed = disturbed
   end subroutine set_coefficient

   !> Find a point on a segment.
   subroutine locate_point(settings, segment, point, error)
      type(follow_settings_type), intent(in) :: settings
      type(segment_type), intent(in) :: segment
      type(special_point_type), intent(inout) :: point
      type(error_type), allocatable, intent(out) :: error
      type(newton_type) :: newton
      type(sign_change_type) :: change
      real(wp) :: at, g, moved, ignored
      integer :: i

      do i = 1, 2
         call test_at(settings, segment, change%places(i), point, newton, change%values(i), error)
         if (allocated(error)) return
      end do
      if (product(change%values) > 0.0_wp) then
         call raise(error, "special point "//trim(point%kind)//": test function " &
                    //text(change%values(1))//" and "//text(change%values(2)) &
                    //" at the ends of a step; different signs expected")
         return
      end if
      do i = 1, most_iterations
         at = change%next()
         call test_at(settings, segment, at, point, newton, g, error)
         if (allocated(error)) return
         call change%narrow(at, g, moved)
         if (moved <= share .or. abs(g) <= tiny(g)) exit
         ! nearer to the point the other branch makes the equations singular
         if (point%kind == branching .and. abs(g) <= small) exit
      end do
      if (abs(g) > small) then
         call raise(error, "special point "//trim(point%kind)//": test function "//text(g) &
                    //" where it changes sign; at most "//text(small)//" expected")
      else if (point%kind == torus_bifurcation) then
         call set_growth(settings, segment, at, point)
      else if (point%kind == fold) then
         ! its test function needs no multipliers
         call judge_point(settings, point, newton%linear, ignored, error)
      end if
   end subroutine locate_point

   !> Set the growth of a torus point by the multipliers on both sides.
   subroutine set_growth(settings, segment, at, point)
      type(follow_settings_type), intent(in) :: settings
      type(segment_type), intent(in) :: segment
      real(wp), intent(in) :: at
      type(special_point_type), intent(inout) :: point
      type(error_type), allocatable :: failure
      type(newton_type) :: newton
      type(special_point_type) :: side
      real(wp) :: parameter(2), rate(2)
      integer :: i

      if (allocated(point%growth)) deallocate (point%growth)
      side%kind = point%kind
      do i = 1, 2
         call test_at(settings, segment, at + merge(-beside, beside, i == 1), side, newton, &
                      rate(i), failure)
         if (allocated(failure)) return
         rate(i) = log(1.0_wp + rate(i))/side%orbit%period
         parameter(i) = side%orbit%parameters(settings%family%free(1))
      end do
      point%growth = (rate(2) - rate(1))/(parameter(2) - parameter(1))
   end subroutine set_growth

   !> The orbit at a place on a segment, and the test function of the point there.
   subroutine test_at(settings, segment, place, point, newton, g, error)
      type(follow_settings_type), intent(in) :: settings
      type(segment_type), intent(in) :: segment
      real(wp), intent(in) :: place
      !> The point, of known kind; its orbit is the one at the place
      type(special_point_type), intent(inout) :: point
      !> What corrected the orbit
      type(newton_type), intent(out) :: newton
      real(wp), intent(out) :: g
      type(error_type), allocatable, intent(out) :: error
      type(orbit_change_type) :: tangent

      g = 0.0_wp
      call find_orbit_at(settings%family, segment, place, point%orbit, newton, error)
      if (allocated(error)) return
      if (point%kind == fold) then
         tangent = segment%along(1)
         call turn_to_tangent(point%orbit, newton%linear, tangent, error)
         g = tangent%parameters(1)
      else
         call judge_point(settings, point, newton%linear, g, error)
      end if
   end subroutine test_at

   !> The segment between two orbits, on the mesh of the first.
   type(segment_type) function segment_between(first, second, family) result(segment)
      type(periodic_orbit_type), intent(in) :: first, second
      type(family_type), intent(in) :: family

      segment%ends(1) = first
      segment%ends(2) = second%on_mesh(first%mesh)
      segment%along(1) = difference_of(segment%ends(2), first, family)
      associate (d => segment%along(1))
         segment%length = sqrt(inner_product(first, d, d))
         d%nodes = d%nodes/segment%length
         d%period = d%period/segment%length
         d%parameters = d%parameters/segment%length
      end associate
   end function segment_between

   !> The orbit at a place on a segment.
   subroutine find_orbit_at(family, segment, place, orbit, newton, error)
      type(family_type), intent(in) :: family
      type(segment_type), intent(in) :: segment
      real(wp), intent(in) :: place
      type(periodic_orbit_type), intent(out) :: orbit
      !> What corrected the orbit
      type(newton_type), intent(out) :: newton
      type(error_type), allocatable, intent(out) :: error

      associate (first => segment%ends(1), second => segment%ends(2))
         orbit = first
         orbit%nodes = (1.0_wp - place)*first%nodes + place*second%nodes
         orbit%period = (1.0_wp - place)*first%period + place*second%period
         orbit%parameters = (1.0_wp - place)*first%parameters + place*second%parameters
         call correct_orbit(family, first, segment%along, [place*segment%length], &
                            orbit, newton, error)
      end associate
   end subroutine find_orbit_at
end module orbit_points
