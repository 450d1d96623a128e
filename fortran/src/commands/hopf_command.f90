! SPDX-License-Identifier: BSD-3-Clause
!> Hopf curves in one plane of parameters, their special points, and the number of unstable roots.
module hopf_command
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde, only: stop_requested
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use double_hopf, only: letters => word_length
   use hopf_curves, only: curve_point_type, trace_curves
   use hopf_planes, only: curve_plane_type, middles
   use hopf_points, only: find_hopf_points, hopf_point_type, judge_points
   use model_attributes, only: put_model, put_places
   use model_description, only: model_length => word_length
   use model_modes, only: mode_of
   use model_roots, only: check_rest
   use model_settings, only: model_settings_type
   use request, only: request_type
   use results, only: results_type
   use value_checks, only: check_choice, check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: run_hopf

   !> A plane as the namelist gives it; all nondimensional.
   type :: hopf_settings_type
      !> The model with its parameters; abscissa and ordinate may be left out
      type(model_settings_type) :: model
      !> Number of the mode of a chain, from 1; of one block there is none
      integer :: mode = 0
      !> Names of the parameters that are abscissa and ordinate
      character(len=model_length) :: along(2) = ""
      !> Windows on both: least and most of the abscissa, then of the ordinate
      real(wp) :: windows(2, 2) = missing
      !> Cells of the map of unstable roots along each side of the window
      integer :: cells = missing_count
   end type hopf_settings_type

contains

   !> Run the command.
   subroutine run_hopf(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(hopf_settings_type) :: settings
      type(curve_plane_type) :: plane
      type(curve_point_type), allocatable :: points(:)
      type(hopf_point_type), allocatable :: special(:)
      integer, allocatable :: roots(:, :)
      real(wp), allocatable :: grid(:)

      call read_plane(given, settings, plane, error)
      if (allocated(error)) return
      ! the edges of the window, and the middles of the cells
      grid = [0.0_wp, middles([0.0_wp, 1.0_wp], settings%cells), 1.0_wp]
      roots = plane%unstable_roots(grid, grid)
      if (all(roots < 0)) call check_rest(plane%model, error)
      if (allocated(error)) return
      call trace_curves(plane, grid, grid, roots, points, error)
      if (allocated(error)) return
      call judge_points(plane, points)
      call find_hopf_points(plane, points, special, error)
      if (stop_requested /= 0) call raise(error, "Hopf curves: interrupted")
      if (allocated(error)) return
      call put_curves(data, settings, plane, points, special, &
                      roots(2:settings%cells + 1, 2:settings%cells + 1))
   end subroutine run_hopf

   !> Read and check a plane.
   subroutine read_plane(given, hopf_curves, plane, error)
      class(request_type), intent(inout) :: given
      type(hopf_settings_type), intent(out) :: hopf_curves
      !> The plane they describe
      type(curve_plane_type), intent(out) :: plane
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      namelist /settings/ hopf_curves

      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      write (given%copy, nml=settings, delim="quote")
      call given%check(error)
      if (allocated(error)) return
      do i = 1, 2
         call hopf_curves%model%put(trim(hopf_curves%along(i)), hopf_curves%windows(1, i))
      end do
      call hopf_curves%model%open(given%place, plane%model, error, keep_delays=.true., &
                                  at_rest=.true., opened=given%model)
      call check_count(error, given%place, "cells", hopf_curves%cells, at_least=2, at_most=2000)
      do i = 1, 2
         if (allocated(error)) return
         call check_choice(error, given%place, "along", hopf_curves%along(i), plane%model%names)
         plane%along(i) = plane%model%number_of(hopf_curves%along(i))
      end do
      if (plane%along(1) == plane%along(2)) then
         call raise(error, given%place//"along = '"//trim(hopf_curves%along(2)) &
                    //"' twice; expected two parameters")
      end if
      plane%window = hopf_curves%windows
      if (allocated(error)) return
      associate (blocks => plane%model%shape%blocks, mode => hopf_curves%mode)
         if (merge(mode == 0, mode >= 1 .and. mode <= plane%model%shape%blocks, blocks == 1)) then
            if (blocks > 1) plane%model = mode_of(plane%model, mode)
         else
            call raise(error, given%place//"mode = "//text(mode)//" of blocks = "//text(blocks) &
                       //"; expected one of 1 to blocks, or 0 of one block")
         end if
      end associate
   end subroutine read_plane

   !> All points of all curves, piece by piece, the special points and the map.
   subroutine put_curves(data, settings, plane, points, special, roots)
      class(results_type), intent(inout) :: data
      !> The plane as the namelist gives it
      type(hopf_settings_type), intent(in) :: settings
      type(curve_plane_type), intent(in) :: plane
      type(curve_point_type), intent(in) :: points(:)
      type(hopf_point_type), intent(in) :: special(:)
      !> Number of unstable roots in cells of the window, the abscissa first
      integer, intent(in) :: roots(:, :)
      integer :: cells(2), i, rows
      real(wp) :: map(size(roots, 1), size(roots, 2))

      call data%attribute("title", "Hopf curves: where a pair of characteristic roots is imaginary")
      call put_model(data, plane%model, but=settings%along)
      if (plane%model%is_chain()) then
         call data%attribute("mode_eigenvalue", plane%model%shape%mode)
      end if
      call data%attribute("abscissa", trim(settings%along(1)))
      call data%attribute("ordinate", trim(settings%along(2)))
      if (any(roots < 0)) call data%attribute("left_out", text(count(roots < 0))//" of " &
         //text(size(roots))//" cells, NaN in map_unstable_roots: no state at rest with finite " &
         //"derivatives and delays >= 0 is found there, or roots are too many to count")
      rows = data%dimension("point", size(points))
      call put_places(data, rows, plane%model, [(points(i)%numbers, i=1, size(points))])
      call data%column(rows, "omega", points%at%omega, "angular frequency of the pair")
      call data%column(rows, "branch", points%branch, &
                       "turns that the pair makes in the longest delay: k of equation (10)")
      call data%column(rows, "piece", points%piece, "number of the unbroken piece of curve")
      call data%column(rows, "residual", points%residual, &
                       "residual of the characteristic function over its largest term")
      call data%column(rows, "crossing", points%crossing, "sign of d Re(lambda)/d ordinate")
      call data%column(rows, "l1", points%l1, "first Lyapunov coefficient")
      call data%column(rows, "unstable_roots", points%unstable_roots, &
                       "unstable roots beside the pair")
      rows = data%dimension("special", size(special), prefix="special_")
      call put_special(data, rows, plane, special)
      call put_unfoldings(data, rows, settings, special)
      cells = [data%dimension("map_abscissa", size(roots, 1)), &
               data%dimension("map_ordinate", size(roots, 2))]
      call data%column(cells(1), "map_abscissa", middles(settings%windows(:, 1), size(roots, 1)), &
                       "abscissa in the middle of a cell")
      call data%column(cells(2), "map_ordinate", middles(settings%windows(:, 2), size(roots, 2)), &
                       "ordinate in the middle of a cell")
      map = roots
      where (roots < 0) map = ieee_value(map, ieee_quiet_nan)
      call data%table(cells, "map_unstable_roots", map, "number of unstable roots")
   end subroutine put_curves

   !> The special points.
   subroutine put_special(data, rows, plane, special)
      class(results_type), intent(inout) :: data
      integer, intent(in) :: rows
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), intent(in) :: special(:)
      integer :: i

      call data%words(rows, "kind", special%kind, "kind of the special point")
      call put_places(data, rows, plane%model, [(special(i)%numbers, i=1, size(special))])
      call data%column(rows, "unstable_roots", special%unstable_roots, &
                       "unstable roots beside those on the axis")
      do i = 1, 2
         call data%column(rows, "omega_"//text(i), special%omega(i), &
                          "frequency of pair "//text(i)//", 0 where there is none")
         call data%column(rows, "branch_"//text(i), special%branch(i), "its branch, or -1")
         call data%column(rows, "l1_"//text(i), special%l1(i), "its first Lyapunov coefficient")
      end do
   end subroutine put_special

   !> Normal forms of special points, and the curves of folds and tori that start there; 0 or an
   !> empty word where a point has none.
   subroutine put_unfoldings(data, rows, settings, special)
      class(results_type), intent(inout) :: data
      integer, intent(in) :: rows
      type(hopf_settings_type), intent(in) :: settings
      type(hopf_point_type), intent(in) :: special(:)
      character(len=*), parameter :: name(2, 2) = reshape(["g2100", "g1110", "g1011", "g0021"], &
                                                          [2, 2])
      character(len=letters), dimension(size(special), 2) :: criticality, torus
      character(len=4) :: unfolding(size(special))
      real(wp), dimension(size(special), 2) :: angle, ratios
      integer :: i, j, k

      angle = 0.0_wp
      ratios = 0.0_wp
      criticality = ""
      torus = ""
      unfolding = ""
      do i = 1, size(special)
         if (special(i)%kind /= "double_hopf") cycle
         associate (form => special(i)%unfolding%form)
            ratios(i, :) = form%ratios()
            unfolding(i) = form%unfolding()
            do j = 1, 2
               angle(i, j) = form%torus_angle(j)
               criticality(i, j) = form%criticality(j)
               torus(i, j) = form%torus_stability(j)
            end do
         end associate
      end do
      call data%column(rows, "l2", real(special%unfolding%c2)/special%omega(1), &
                       "second Lyapunov coefficient")
      do k = 1, 2
         do j = 1, 2
            call data%column(rows, name(j, k), real(special%unfolding%form%g(j, k)), &
                             "real part of the coefficient "//name(j, k))
            call data%column(rows, name(j, k)//"_imaginary", &
                             aimag(special%unfolding%form%g(j, k)), &
                             "imaginary part of the coefficient "//name(j, k))
         end do
      end do
      call data%column(rows, "theta", ratios(:, 1), "Re g1011/Re g0021")
      call data%column(rows, "delta", ratios(:, 2), "Re g1110/Re g2100")
      call data%words(rows, "unfolding", unfolding, "case of Guckenheimer and Holmes, table 7.5.1")
      do j = 1, 2
         do k = 1, 2
            call data%column(rows, "start_"//trim(settings%along(k))//"_"//text(j), &
                             special%unfolding%start(k, j), "direction of curve "//text(j) &
                             //" of folds or tori, "//trim(settings%along(k)))
         end do
         call data%column(rows, "angle_"//text(j), angle(:, j), &
                          "angle of the multipliers where tori of cycle "//text(j)//" start")
         call data%words(rows, "criticality_"//text(j), criticality(:, j), &
                         "kind of this torus bifurcation")
         call data%words(rows, "torus_"//text(j), torus(:, j), &
                         "stability of its torus on the centre manifold")
      end do
   end subroutine put_unfoldings
end module hopf_command
