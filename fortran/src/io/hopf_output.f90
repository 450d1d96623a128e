!> Files of Hopf curves.
module hopf_output
   use block_parameters, only: parameter_meanings
   use dde_errors, only: error_type
   use double_hopf, only: word_length
   use hopf_curves, only: curve_point_type
   use hopf_input, only: hopf_settings_type
   use hopf_points, only: hopf_point_type
   use dde_kinds, only: wp
   use netcdf_output, only: output_file_type
   use stability_map, only: middles
   implicit none (type, external)
   private
   public :: write_curves

contains

   !> Write all points of all curves, piece by piece, the special points and the map.
   subroutine write_curves(path, settings, points, special, pairs, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The plane
      type(hopf_settings_type), intent(in) :: settings
      !> Points
      type(curve_point_type), intent(in) :: points(:)
      !> Special points
      type(hopf_point_type), intent(in) :: special(:)
      !> Number of unstable pairs in cells of the window, epsilon first
      integer, intent(in) :: pairs(:, :)
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: rows

      call file%create(path, "Hopf curves: where a pair of characteristic roots is imaginary")
      rows = file%dimension("point", size(points), coordinates="epsilon tau xi")
      associate (place => points%parameters)
         call file%column(rows, "epsilon", place%epsilon, trim(parameter_meanings(2)))
         call file%column(rows, "tau", place%tau, trim(parameter_meanings(1)))
         call file%column(rows, "xi", place%xi, trim(parameter_meanings(3)))
      end associate
      call file%column(rows, "omega", points%omega, "angular frequency of the pair")
      call file%column(rows, "branch", points%branch, "branch k of equation (10)")
      call file%column(rows, "piece", points%piece, "number of the unbroken piece of curve")
      call file%column(rows, "residual", points%residual, "residual of (5) over its largest term")
      call file%column(rows, "crossing", points%crossing, "sign of d Re(lambda)/d tau")
      call file%column(rows, "printed_tau", points%printed_tau, "delay by (10) as printed")
      call file%column(rows, "printed_residual", points%printed_residual, &
                       "residual of (5) there over its largest term")
      call file%column(rows, "l1", points%l1, "first Lyapunov coefficient")
      call file%column(rows, "unstable_pairs", points%unstable_pairs, &
                       "unstable pairs beside this one")
      call file%attribute("ordinate", trim(settings%ordinate))
      call file%attribute("gamma", settings%gamma)
      call file%attribute(settings%other(), settings%fixed)
      rows = file%dimension("special", size(special), &
                            coordinates="special_epsilon special_tau special_xi")
      call put_special(file, rows, special)
      call put_unfoldings(file, settings, rows, special)
      call put_map(file, settings, pairs)
      call file%finish(error)
   end subroutine write_curves

   !> The special points.
   subroutine put_special(file, rows, special)
      type(output_file_type), intent(inout) :: file
      integer, intent(in) :: rows
      type(hopf_point_type), intent(in) :: special(:)
      character(len=1), parameter :: number(2) = ["1", "2"]
      integer :: i

      call file%words(rows, "special_kind", special%kind, "kind of the special point")
      associate (place => special%parameters)
         call file%column(rows, "special_epsilon", place%epsilon, "its epsilon")
         call file%column(rows, "special_tau", place%tau, "its tau")
         call file%column(rows, "special_xi", place%xi, "its xi")
      end associate
      call file%column(rows, "special_unstable_pairs", special%unstable_pairs, &
                       "unstable pairs beside those on the axis")
      do i = 1, 2
         call file%column(rows, "special_omega_"//number(i), special%omega(i), &
                          "frequency of pair "//number(i)//", 0 where there is none")
         call file%column(rows, "special_branch_"//number(i), special%branch(i), &
                          "its branch, or -1")
         call file%column(rows, "special_l1_"//number(i), special%l1(i), &
                          "its first Lyapunov coefficient")
      end do
   end subroutine put_special

   !> Their normal forms, and the curves of folds and tori that start there; 0 or an empty word
   !> where a point has none.
   subroutine put_unfoldings(file, settings, rows, special)
      type(output_file_type), intent(inout) :: file
      type(hopf_settings_type), intent(in) :: settings
      integer, intent(in) :: rows
      type(hopf_point_type), intent(in) :: special(:)
      character(len=*), parameter :: number(2) = ["1", "2"]
      character(len=*), parameter :: name(2, 2) = reshape(["g2100", "g1110", "g1011", "g0021"], &
                                                          [2, 2])
      character(len=word_length), dimension(size(special), 2) :: criticality, torus
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
      call put("l2", real(special%unfolding%c2)/special%omega(1), "second Lyapunov coefficient")
      do k = 1, 2
         do j = 1, 2
            call put(name(j, k), real(special%unfolding%form%g(j, k)), &
                     "real part of the coefficient "//name(j, k))
            call put(name(j, k)//"_imaginary", aimag(special%unfolding%form%g(j, k)), &
                     "imaginary part of the coefficient "//name(j, k))
         end do
      end do
      call put("theta", ratios(:, 1), "Re g1011/Re g0021")
      call put("delta", ratios(:, 2), "Re g1110/Re g2100")
      call file%words(rows, "special_unfolding", unfolding, &
                      "case of Guckenheimer and Holmes, table 7.5.1")
      do j = 1, 2
         call put("start_epsilon_"//number(j), special%unfolding%start(1, j), &
                  "direction of curve "//number(j)//" of folds or tori, epsilon")
         call put("start_"//trim(settings%ordinate)//"_"//number(j), &
                  special%unfolding%start(2, j), &
                  "direction of curve "//number(j)//" of folds or tori, "//trim(settings%ordinate))
         call put("angle_"//number(j), angle(:, j), &
                  "angle of the multipliers where tori of cycle "//number(j)//" start")
         call file%words(rows, "special_criticality_"//number(j), criticality(:, j), &
                         "kind of this torus bifurcation")
         call file%words(rows, "special_torus_"//number(j), torus(:, j), &
                         "stability of its torus on the centre manifold")
      end do

   contains

      !> One number of each point.
      subroutine put(key, values, long_name)
         !> Name without special_
         character(len=*), intent(in) :: key
         real(wp), intent(in) :: values(:)
         character(len=*), intent(in) :: long_name

         call file%column(rows, "special_"//key, values, long_name)
      end subroutine put
   end subroutine put_unfoldings

   !> The number of unstable pairs over the window.
   subroutine put_map(file, settings, pairs)
      type(output_file_type), intent(inout) :: file
      type(hopf_settings_type), intent(in) :: settings
      !> Number of unstable pairs, epsilon first
      integer, intent(in) :: pairs(:, :)
      integer :: cells(2)

      cells(1) = file%dimension("map_epsilon", size(pairs, 1))
      cells(2) = file%dimension("map_ordinate", size(pairs, 2))
      call file%column(cells(1), "map_epsilon", middles(settings%epsilon_window, size(pairs, 1)), &
                       "epsilon in the middle of a cell")
      call file%column(cells(2), "map_ordinate", &
                       middles(settings%ordinate_window, size(pairs, 2)), &
                       "ordinate in the middle of a cell")
      call file%table(cells, "map_unstable_pairs", real(pairs, wp), "number of unstable pairs")
   end subroutine put_map
end module hopf_output
