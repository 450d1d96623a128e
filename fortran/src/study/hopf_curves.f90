!> Hopf curves in a plane of two parameters, drawn over the frequency omega, or over the ordinate,
!> which then stands for omega below: the pieces inside a window are found by a scan, their ends by
!> root finding, and points are set where the line bends.
module hopf_curves
   use block_family, only: along_tau
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: characteristic_type
   use dde_errors, only: error_type
   use gsl_roots, only: find_root, scalar_function_type
   use hopf_planes, only: curve_plane_type
   use dde_kinds, only: wp
   use printed_delay, only: printed_tau
   use spring_block, only: block_characteristic
   implicit none (type, external)
   private
   public :: curve_point_type, trace_curves

   !> Omegas of the scan for pieces inside the window, or ordinates, which are dearer.
   integer, parameter :: scan_omegas = 20000, scan_ordinates = 500
   !> Farthest a chord may lie from the curve, and longest chord, in units of the window.
   real(wp), parameter :: chord_deviation = 1.0e-4_wp, chord_length = 0.02_wp
   !> Most halvings of one piece.
   integer, parameter :: most_halvings = 14

   !> One point of a Hopf curve.
   type :: curve_point_type
      !> Parameters, nondimensional
      type(block_parameters_type) :: parameters
      !> Frequency of the pair
      real(wp) :: omega = 0.0_wp
      !> Branch k of equation (10)
      integer :: branch = 0
      !> Number of the unbroken piece of curve it belongs to, from 1
      integer :: piece = 0
      !> |Delta(i omega)| over its largest term
      real(wp) :: residual = 0.0_wp
      !> +1 where a growing tau makes the pair unstable, -1 where it makes it stable
      integer :: crossing = 0
      !> First Lyapunov coefficient, once judged: negative, supercritical
      real(wp) :: l1 = 0.0_wp
      !> Unstable pairs beside this one, once judged
      integer :: unstable_pairs = 0
      !> Delay by equation (10) as printed
      real(wp) :: printed_tau = 0.0_wp
      !> Residual there
      real(wp) :: printed_residual = 0.0_wp
   end type curve_point_type

   !> How far inside the window branch k is at omega, -1..1 (negative: outside).
   type, extends(scalar_function_type) :: margin_function_type
      !> The plane
      type(curve_plane_type) :: plane
      !> Branch
      integer :: k = 0
   contains
      procedure :: value => window_margin
   end type margin_function_type

contains

   !> All points of all branches in the window of `plane`, piece by piece, omega ascending.
   subroutine trace_curves(plane, points, error)
      !> The plane and its window
      type(curve_plane_type), intent(in) :: plane
      !> Points
      type(curve_point_type), allocatable, intent(out) :: points(:)
      !> A root was not found
      type(error_type), allocatable, intent(out) :: error
      type(margin_function_type) :: margin
      real(wp), allocatable :: omega(:)
      logical, allocatable :: inside(:)
      real(wp) :: ends(2), omega_least, omega_most
      integer :: first, i, k, k_most, last, piece, scan_points

      scan_points = merge(scan_omegas, scan_ordinates, plane%by_frequency())
      allocate (points(0), omega(0:scan_points), inside(0:scan_points))
      margin%plane = plane
      call plane%bounds(omega_least, omega_most, k_most)
      omega(:) = [(omega_least + (omega_most - omega_least)*i/scan_points, i=0, scan_points)]
      piece = 0
      do k = 0, k_most
         margin%k = k
         do i = 0, scan_points
            inside(i) = margin%value(omega(i)) >= 0.0_wp
         end do
         last = -1
         do
            first = findloc(inside(last + 1:), .true., dim=1) + last
            if (first == last) exit
            last = findloc(inside(first:), .false., dim=1) + first - 2
            if (last < first) last = scan_points
            call refine_end(margin, omega, first, first - 1, ends(1), error)
            if (allocated(error)) return
            call refine_end(margin, omega, last, last + 1, ends(2), error)
            if (allocated(error)) return
            piece = piece + 1
            points = [points, piece_of_curve(plane, k, ends, piece)]
            if (last == scan_points) exit
         end do
      end do
   end subroutine trace_curves

   !> Where a piece leaves the window, between scan points `inner` and `outer`.
   subroutine refine_end(margin, omega, inner, outer, end_of_piece, error)
      type(margin_function_type), intent(in) :: margin
      real(wp), intent(in) :: omega(0:)
      integer, intent(in) :: inner
      !> First one outside, beyond the scan if there is none
      integer, intent(in) :: outer
      !> The omega between them at which the window ends
      real(wp), intent(out) :: end_of_piece
      type(error_type), allocatable, intent(out) :: error

      end_of_piece = omega(inner)
      if (outer < 0 .or. outer > ubound(omega, 1)) return
      call find_root(margin, min(omega(inner), omega(outer)), max(omega(inner), omega(outer)), &
                     end_of_piece, error)
   end subroutine refine_end

   !> Distance of branch k at omega to the nearest edge of the window, in units of the window.
   real(wp) function window_margin(self, x) result(margin)
      class(margin_function_type), intent(in) :: self
      real(wp), intent(in) :: x
      type(block_parameters_type) :: p
      real(wp) :: place(2)

      margin = -1.0_wp
      p = self%plane%at(x, self%k)
      if (.not. p%xi > 0.0_wp) return
      place = place_in_window(self%plane, p)
      margin = max(-1.0_wp, min(minval(place), minval(1.0_wp - place)))
   end function window_margin

   !> (epsilon, ordinate) in units of the window, 0..1 inside.
   pure function place_in_window(plane, p) result(place)
      type(curve_plane_type), intent(in) :: plane
      type(block_parameters_type), intent(in) :: p
      real(wp) :: place(2)

      associate (x => plane%epsilon_window, y => plane%ordinate_window)
         place = [(p%epsilon - x(1))/(x(2) - x(1)), (plane%ordinate(p) - y(1))/(y(2) - y(1))]
      end associate
   end function place_in_window

   !> Points of branch k between two omegas, set so close that the chords look like the curve.
   function piece_of_curve(plane, k, ends, piece) result(points)
      type(curve_plane_type), intent(in) :: plane
      integer, intent(in) :: k
      real(wp), intent(in) :: ends(2)
      integer, intent(in) :: piece
      type(curve_point_type), allocatable :: points(:)
      real(wp), allocatable :: omega(:)
      logical, allocatable :: bent(:)
      integer :: halving, i

      allocate (omega, source=[(ends(1) + (ends(2) - ends(1))*i/16.0_wp, i=0, 16)])
      do halving = 1, most_halvings
         bent = [(chord_is_bad(plane, k, omega(i), omega(i + 1)), i=1, size(omega) - 1)]
         if (.not. any(bent)) exit
         omega = [omega(1), (pack([0.5_wp*(omega(i) + omega(i + 1)), omega(i + 1)], &
                                  [bent(i), .true.]), i=1, size(bent))]
      end do
      points = [(point_of_curve(plane, k, omega(i), piece), i=1, size(omega))]
   end function piece_of_curve

   !> Whether the chord between two omegas misses the curve's middle or is too long.
   logical function chord_is_bad(plane, k, omega_1, omega_2) result(value)
      type(curve_plane_type), intent(in) :: plane
      integer, intent(in) :: k
      real(wp), intent(in) :: omega_1, omega_2
      real(wp), dimension(2) :: chord, middle, start

      start = place_in_window(plane, plane%at(omega_1, k))
      chord = place_in_window(plane, plane%at(omega_2, k)) - start
      middle = place_in_window(plane, plane%at(0.5_wp*(omega_1 + omega_2), k)) - start
      value = norm2(chord) > chord_length
      if (norm2(chord) > 0.0_wp) then
         value = value .or. abs(chord(1)*middle(2) - chord(2)*middle(1)) &
                 > chord_deviation*norm2(chord)
      end if
   end function chord_is_bad

   !> The point of branch k at a frequency or an ordinate, with its residuals and crossing.
   type(curve_point_type) function point_of_curve(plane, k, x, piece) result(point)
      type(curve_plane_type), intent(in) :: plane
      integer, intent(in) :: k
      real(wp), intent(in) :: x
      integer, intent(in) :: piece
      type(block_parameters_type) :: printed
      type(characteristic_type) :: c
      complex(wp) :: s

      point%branch = k
      point%piece = piece
      point%parameters = plane%at(x, k, point%omega)
      s = cmplx(0.0_wp, point%omega, kind=wp)
      associate (p => point%parameters)
         c = block_characteristic(p)
         point%residual = c%relative_residual(s)
         point%crossing = nint(sign(1.0_wp, real(c%root_by(along_tau, s))))
         printed = p
         printed%tau = printed_tau(point%omega, p%xi, p%gamma, k)
      end associate
      point%printed_tau = printed%tau
      c = block_characteristic(printed)
      point%printed_residual = c%relative_residual(s)
   end function point_of_curve
end module hopf_curves
