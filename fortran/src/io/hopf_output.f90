!> Files of Hopf curves.
module hopf_output
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
      integer :: branch, crossing, epsilon, l1, omega, others, piece, printed_residual
      integer :: printed_tau, residual, rows, tau, xi

      call file%create(path, "Hopf curves: where a pair of characteristic roots is imaginary")
      rows = file%dimension("point", size(points), coordinates="epsilon tau xi")
      epsilon = file%real_variable("epsilon", rows, "sensitivity of the velocity relaxation", "1")
      tau = file%real_variable("tau", rows, "delay", "1")
      xi = file%real_variable("xi", rows, "spring constant", "1")
      omega = file%real_variable("omega", rows, "angular frequency of the pair", "1")
      branch = file%integer_variable("branch", rows, "branch k of equation (10)")
      piece = file%integer_variable("piece", rows, "number of the unbroken piece of curve")
      residual = file%real_variable("residual", rows, "residual of (5) over its largest term", "1")
      crossing = file%integer_variable("crossing", rows, "sign of d Re(lambda)/d tau")
      printed_tau = file%real_variable("printed_tau", rows, "delay by (10) as printed", "1")
      printed_residual = file%real_variable("printed_residual", rows, &
                                            "residual of (5) there over its largest term", "1")
      l1 = file%real_variable("l1", rows, "first Lyapunov coefficient", "1")
      others = file%integer_variable("unstable_pairs", rows, "unstable pairs beside this one")
      call file%attribute("ordinate", trim(settings%ordinate))
      call file%attribute("gamma", settings%gamma)
      call file%attribute(trim(merge("xi ", "tau", settings%ordinate == "tau")), settings%fixed)
      call file%put(epsilon, points%parameters%epsilon)
      call file%put(tau, points%parameters%tau)
      call file%put(xi, points%parameters%xi)
      call file%put(omega, points%omega)
      call file%put(branch, points%branch)
      call file%put(piece, points%piece)
      call file%put(residual, points%residual)
      call file%put(crossing, points%crossing)
      call file%put(printed_tau, points%printed_tau)
      call file%put(printed_residual, points%printed_residual)
      call file%put(l1, points%l1)
      call file%put(others, points%unstable_pairs)
      rows = file%dimension("special", size(special), &
                            coordinates="special_epsilon special_tau special_xi")
      call put_special(file, rows, special)
      call put_unfoldings(file, settings, rows, special)
      call put_map(file, settings, pairs)
      call file%finish(error)
   end subroutine write_curves

   !> The special points.
   subroutine put_special(file, rows, special)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Dimension of the special points
      integer, intent(in) :: rows
      !> Special points
      type(hopf_point_type), intent(in) :: special(:)
      character(len=1), parameter :: number(2) = ["1", "2"]
      integer :: branch, i, l1, omega, place(3), pairs

      call file%words("special_kind", rows, special%kind, "kind of the special point")
      place(1) = file%real_variable("special_epsilon", rows, "its epsilon", "1")
      place(2) = file%real_variable("special_tau", rows, "its tau", "1")
      place(3) = file%real_variable("special_xi", rows, "its xi", "1")
      pairs = file%integer_variable("special_unstable_pairs", rows, &
                                    "unstable pairs beside those on the axis")
      call file%put(place(1), special%parameters%epsilon)
      call file%put(place(2), special%parameters%tau)
      call file%put(place(3), special%parameters%xi)
      call file%put(pairs, special%unstable_pairs)
      do i = 1, 2
         omega = file%real_variable("special_omega_"//number(i), rows, &
                                    "frequency of pair "//number(i)//", 0 where there is none", "1")
         branch = file%integer_variable("special_branch_"//number(i), rows, "its branch, or -1")
         l1 = file%real_variable("special_l1_"//number(i), rows, &
                                 "its first Lyapunov coefficient", "1")
         call file%put(omega, special%omega(i))
         call file%put(branch, special%branch(i))
         call file%put(l1, special%l1(i))
      end do
   end subroutine put_special

   !> Their normal forms, and the curves of folds and tori that start there; 0 or an empty word
   !> where a point has none.
   subroutine put_unfoldings(file, settings, rows, special)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> The plane
      type(hopf_settings_type), intent(in) :: settings
      !> Dimension of the special points
      integer, intent(in) :: rows
      !> Special points
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
      call file%words("special_unfolding", rows, unfolding, &
                      "case of Guckenheimer and Holmes, table 7.5.1")
      do j = 1, 2
         call put("start_epsilon_"//number(j), special%unfolding%start(1, j), &
                  "direction of curve "//number(j)//" of folds or tori, epsilon")
         call put("start_"//trim(settings%ordinate)//"_"//number(j), &
                  special%unfolding%start(2, j), &
                  "direction of curve "//number(j)//" of folds or tori, "//trim(settings%ordinate))
         call put("angle_"//number(j), angle(:, j), &
                  "angle of the multipliers where tori of cycle "//number(j)//" start")
         call file%words("special_criticality_"//number(j), rows, criticality(:, j), &
                         "kind of this torus bifurcation")
         call file%words("special_torus_"//number(j), rows, torus(:, j), &
                         "stability of its torus on the centre manifold")
      end do

   contains

      !> One number of each point.
      subroutine put(key, values, long_name)
         !> Name without special_
         character(len=*), intent(in) :: key
         !> The numbers
         real(wp), intent(in) :: values(:)
         !> What they are
         character(len=*), intent(in) :: long_name

         call file%put(file%real_variable("special_"//key, rows, long_name, "1"), values)
      end subroutine put
   end subroutine put_unfoldings

   !> The number of unstable pairs over the window.
   subroutine put_map(file, settings, pairs)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> The plane
      type(hopf_settings_type), intent(in) :: settings
      !> Number of unstable pairs, epsilon first
      integer, intent(in) :: pairs(:, :)
      integer :: cells(2), x, y

      cells(1) = file%dimension("map_epsilon", size(pairs, 1))
      cells(2) = file%dimension("map_ordinate", size(pairs, 2))
      x = file%real_variable("map_epsilon", cells(1), "epsilon in the middle of a cell", "1")
      y = file%real_variable("map_ordinate", cells(2), "ordinate in the middle of a cell", "1")
      call file%put(x, middles(settings%epsilon_window, size(pairs, 1)))
      call file%put(y, middles(settings%ordinate_window, size(pairs, 2)))
      call file%table("map_unstable_pairs", cells, real(pairs, wp), "number of unstable pairs")
   end subroutine put_map
end module hopf_output
