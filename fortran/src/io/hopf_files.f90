!> What the program `hopf` reads and writes: the plane and window of Hopf curves; these curves.
module hopf_files
   use block_attributes, only: key_of, put_law
   use block_parameters, only: block_parameters_type, meaning_of, missing_parameters, paper_law, &
                               parameter_meanings, parameter_names, vector_of
   use dde_errors, only: error_type, text
   use hopf_condition, only: find_hopf_condition
   use dde_kinds, only: wp
   use double_hopf, only: letters => word_length
   use hopf_curves, only: curve_point_type
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: hopf_point_type
   use namelist_input, only: namelist_file_type
   use model_description, only: law_length => word_length
   use netcdf_output, only: output_file_type
   use stability_map, only: middles
   use value_checks, only: check_choice, missing, missing_count
   implicit none (type, external)
   private
   public :: hopf_settings_type, read_plane, write_curves

   !> A plane as the namelist gives it; all nondimensional.
   type :: hopf_settings_type
      !> Name of the parameter over epsilon
      character(len=law_length) :: ordinate = ""
      !> The other parameters; epsilon and the ordinate may be left out
      type(block_parameters_type) :: parameters = missing_parameters
      !> Window on epsilon
      real(wp) :: epsilon_window(2) = missing
      !> Window on the ordinate
      real(wp) :: ordinate_window(2) = missing
      !> Cells of the map of unstable pairs along each side of the window
      integer :: cells = missing_count
   end type hopf_settings_type

contains

   !> Read and check a plane.
   subroutine read_plane(path, hopf_curves, plane, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(hopf_settings_type), intent(out) :: hopf_curves
      !> The plane they describe
      type(curve_plane_type), intent(out) :: plane
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=law_length), allocatable :: names(:)
      type(namelist_file_type) :: file
      namelist /settings/ hopf_curves

      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      associate (parameters => hopf_curves%parameters)
         call parameters%put("epsilon", hopf_curves%epsilon_window(1))
         call parameters%put(trim(hopf_curves%ordinate), hopf_curves%ordinate_window(1))
         write (file%copy, nml=settings, delim="quote")
         call file%close(error)
         call parameters%check(path, error)
         if (allocated(error)) return
         names = parameters%names()
         call check_choice(error, path, "ordinate", hopf_curves%ordinate, &
                           pack(names, names /= "epsilon"))
         plane%along = findloc(names, hopf_curves%ordinate, dim=1)
         plane%fixed = parameters
      end associate
      plane%epsilon_window = hopf_curves%epsilon_window
      plane%ordinate_window = hopf_curves%ordinate_window
      if (allocated(error)) return
      call find_hopf_condition(plane%fixed, plane%condition, error)
   end subroutine read_plane

   !> Write all points of all curves, piece by piece, the special points and the map.
   subroutine write_curves(path, settings, plane, points, special, pairs, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The plane as the namelist gives it
      type(hopf_settings_type), intent(in) :: settings
      !> The plane
      type(curve_plane_type), intent(in) :: plane
      !> Points
      type(curve_point_type), intent(in) :: points(:)
      !> Special points
      type(hopf_point_type), intent(in) :: special(:)
      !> Number of unstable pairs in cells of the window, epsilon first
      integer, intent(in) :: pairs(:, :)
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      character(len=:), allocatable :: key
      real(wp), allocatable :: vector(:)
      integer :: cells(2), i, rows

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
      call file%column(rows, "residual", points%residual, &
                       "residual of the characteristic function over its largest term")
      call file%column(rows, "crossing", points%crossing, "sign of d Re(lambda)/d tau")
      if (settings%parameters%law == paper_law) then
         call file%column(rows, "printed_tau", points%printed_tau, "delay by (10) as printed")
         call file%column(rows, "printed_residual", points%printed_residual, &
                          "residual of (5) there over its largest term")
      end if
      call file%column(rows, "l1", points%l1, "first Lyapunov coefficient")
      call file%column(rows, "unstable_pairs", points%unstable_pairs, &
                       "unstable pairs beside this one")
      key = trim(key_of(settings%ordinate))
      call put_law(file, plane%fixed, [key])
      call file%attribute("ordinate", key)
      vector = vector_of(plane%fixed)
      do i = 1, size(parameter_names)
         if (parameter_names(i) == "epsilon" .or. parameter_names(i) == settings%ordinate) cycle
         call file%attribute(trim(parameter_names(i)), vector(i))
      end do
      if (.not. plane%by_frequency()) then
         call file%column(rows, key, &
                          [(plane%ordinate(points(i)%parameters), i=1, size(points))], &
                          meaning_of(settings%parameters%law, settings%ordinate))
      end if
      rows = file%dimension("special", size(special), &
                            coordinates="special_epsilon special_tau special_xi")
      call put_special(file, rows, special)
      if (.not. plane%by_frequency()) then
         call file%column(rows, "special_"//key, &
                          [(plane%ordinate(special(i)%parameters), i=1, size(special))], &
                          "its "//key)
      end if
      call put_unfoldings(file, settings, rows, special)
      cells = [file%dimension("map_epsilon", size(pairs, 1)), &
               file%dimension("map_ordinate", size(pairs, 2))]
      call file%column(cells(1), "map_epsilon", middles(settings%epsilon_window, size(pairs, 1)), &
                       "epsilon in the middle of a cell")
      call file%column(cells(2), "map_ordinate", &
                       middles(settings%ordinate_window, size(pairs, 2)), &
                       "ordinate in the middle of a cell")
      call file%table(cells, "map_unstable_pairs", real(pairs, wp), "number of unstable pairs")
      call file%finish(error)
   end subroutine write_curves

   !> The special points.
   subroutine put_special(file, rows, special)
      type(output_file_type), intent(inout) :: file
      integer, intent(in) :: rows
      type(hopf_point_type), intent(in) :: special(:)
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
         call file%column(rows, "special_omega_"//text(i), special%omega(i), &
                          "frequency of pair "//text(i)//", 0 where there is none")
         call file%column(rows, "special_branch_"//text(i), special%branch(i), &
                          "its branch, or -1")
         call file%column(rows, "special_l1_"//text(i), special%l1(i), &
                          "its first Lyapunov coefficient")
      end do
   end subroutine put_special

   !> Normal forms of special points, and the curves of folds and tori that start there; 0 or an
   !> empty word where a point has none.
   subroutine put_unfoldings(file, settings, rows, special)
      type(output_file_type), intent(inout) :: file
      type(hopf_settings_type), intent(in) :: settings
      integer, intent(in) :: rows
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
         call put("start_epsilon_"//text(j), special%unfolding%start(1, j), &
                  "direction of curve "//text(j)//" of folds or tori, epsilon")
         call put("start_"//trim(key_of(settings%ordinate))//"_"//text(j), &
                  special%unfolding%start(2, j), &
                  "direction of curve "//text(j)//" of folds or tori, "//trim(settings%ordinate))
         call put("angle_"//text(j), angle(:, j), &
                  "angle of the multipliers where tori of cycle "//text(j)//" start")
         call file%words(rows, "special_criticality_"//text(j), criticality(:, j), &
                         "kind of this torus bifurcation")
         call file%words(rows, "special_torus_"//text(j), torus(:, j), &
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
end module hopf_files
