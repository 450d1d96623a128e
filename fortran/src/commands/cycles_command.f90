! SPDX-License-Identifier: BSD-3-Clause
!> Cycles along a line of parameters: stable and unstable branches, their special points, and curves
!> of these over two parameters.
module cycles_command
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use cycle_branches, only: cycle_line_type, cycle_settings_type, cycles_type, find_cycles, &
                             left_out_type
   use cycle_curves, only: cycle_curve_type, find_curves
   use dde, only: stop_requested
   use dde_errors, only: error_type, raise
   use dde_kinds, only: int64, wp
   use floquet_multipliers, only: multipliers_type
   use hopf_lines, only: hopf_on_line_type
   use model_attributes, only: put_model, put_places
   use model_description, only: description_type
   use model_history, only: history_type, signal_name
   use model_problem, only: model_type
   use model_settings, only: model_settings_type
   use request, only: elements, request_type, word_length
   use results, only: results_type
   use periodic_orbit, only: periodic_orbit_type
   use special_points, only: kind_length, nearest_resonance, special_point_type
   use value_checks, only: absent, check_choice, check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: run_cycles

   !> The section `cycles`; all nondimensional.
   type :: cycles_section_type
      !> Parameter along the line
      character(len=word_length) :: along = ""
      !> First and last value of this parameter
      real(wp) :: window(2) = missing
      !> The model with its parameters; that along the line may be left out
      type(model_settings_type) :: model
      !> Parameter values from which trajectories are followed to a cycle
      real(wp) :: starts(100) = absent
      !> Time of these trajectories
      real(wp) :: t_transient = missing
      !> Degree and intervals of the first mesh
      integer :: degree = missing_count, intervals = missing_count
      !> Longest period of a branch
      real(wp) :: longest_period = missing
      !> Most orbits of a branch
      integer :: most_orbits = missing_count
      !> Two parameters over which curves of special points are followed, and windows on them; none
      !> are if these are left out
      character(len=word_length) :: curves_along(2) = ""
      real(wp) :: curves_windows(2, 2) = 0.0_wp
   end type cycles_section_type

   !> Multipliers written for each orbit
   integer, parameter :: multipliers = 4
   !> What errors of multipliers are
   character(len=*), parameter :: trivial_error = "distance of the trivial multiplier from 1"

contains

   !> Run the command.
   subroutine run_cycles(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(cycle_settings_type) :: settings
      type(cycle_curve_type), allocatable :: curves(:)
      type(cycles_type), allocatable :: found(:)
      type(hopf_on_line_type), allocatable :: hopf(:)
      type(left_out_type), allocatable :: left_out(:)

      call read_cycles(given, settings, error)
      if (allocated(error)) return
      call given%progress%begin("branches of cycles")
      call find_cycles(settings, hopf, found, left_out, error, given%progress)
      if (allocated(error)) return
      call given%progress%begin("curves of their special points")
      call find_curves(settings, found, curves, error, given%progress)
      if (allocated(error)) return
      if (stop_requested /= 0) call raise(error, "cycles: interrupted")
      if (.not. allocated(error)) call put_cycles(data, settings, hopf, found, left_out, curves)
   end subroutine run_cycles

   !> Read and check what is computed.
   subroutine read_cycles(given, line_settings, error)
      class(request_type), intent(inout) :: given
      type(cycle_settings_type), intent(out) :: line_settings
      !> Error if the file cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(cycles_section_type) :: cycles
      type(cycle_line_type) :: line
      type(history_type) :: history
      integer :: i
      namelist /settings/ cycles

      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      ! the value of the parameter along the line is not used
      call cycles%model%put(trim(cycles%along), cycles%window(1))
      write (given%copy, nml=settings, delim="quote")
      call given%check(error)
      if (allocated(error)) return
      call cycles%model%open(given%place, line%model, error, at_rest=.true., &
                             opened=given%model)
      if (line%model%moving > 0 .and. .not. allocated(error)) then
         call raise(error, "cycles: delays depend on t or the states; expected constant ones")
      end if
      call given%read_histories(line%model, history, error)
      if (allocated(error)) return
      call check_choice(error, given%place, "along", cycles%along, line%model%names)
      call check_count(error, given%place, "degree", cycles%degree, at_least=3, at_most=9)
      call check_count(error, given%place, "intervals", cycles%intervals, at_least=1, at_most=1000)
      call check_count(error, given%place, "most_orbits", cycles%most_orbits, at_least=2, &
                       at_most=100000)
      line%along = line%model%number_of(cycles%along)
      line%window = cycles%window
      line_settings = cycle_settings_type(line=line, starts=elements(cycles%starts), &
                                          t_transient=cycles%t_transient, degree=cycles%degree, &
                                          intervals=cycles%intervals, &
                                          longest_period=cycles%longest_period, &
                                          most_orbits=cycles%most_orbits)
      if (all(cycles%curves_along == "")) return
      do i = 1, 2
         call check_choice(error, given%place, "curves_along", cycles%curves_along(i), &
                           line%model%names)
      end do
      if (.not. any(cycles%curves_along == cycles%along)) return
      line_settings%curve_along = [(line%model%number_of(cycles%curves_along(i)), i=1, 2)]
      line_settings%curve_window = cycles%curves_windows
   end subroutine read_cycles

   !> The orbits of all branches one after another, the branches, the starts left out, the special
   !> points, the Hopf points, the points of all curves one after another, and their cusps.
   subroutine put_cycles(data, settings, hopf, found, left_out, curves)
      class(results_type), intent(inout) :: data
      !> What was asked
      type(cycle_settings_type), intent(in) :: settings
      type(hopf_on_line_type), intent(in) :: hopf(:)
      type(cycles_type), intent(in) :: found(:)
      !> Starts without a branch of their own
      type(left_out_type), intent(in) :: left_out(:)
      !> Curves of special points
      type(cycle_curve_type), intent(in) :: curves(:)
      type(description_type) :: about
      character(len=:), allocatable :: along
      integer :: i, rows

      about = settings%line%model%describe()
      along = trim(settings%line%model%names(settings%line%along))
      call data%attribute("title", "Cycles along a line of parameters: stable and unstable " &
                          //"branches")
      call data%attribute("along", along)
      call put_model(data, settings%line%model, but=[along])
      call data%attribute("degree", int(settings%degree, int64))
      call put_orbits(data, settings%line%model, settings%line%along, along, &
                      trim(about%parameters(settings%line%along)%meaning), found)
      rows = data%dimension("left_out", size(left_out), prefix="left_out_")
      call data%words(rows, "origin", left_out%origin, "where it starts, or special point")
      call data%column(rows, along, left_out%at, "parameter along the line")
      call data%words(rows, "reason", left_out%reason, "why no branch or point")
      call put_points(data, settings%line%model, found)
      rows = data%dimension("hopf", size(hopf), prefix="hopf_")
      call put_places(data, rows, settings%line%model, [(hopf(i)%numbers, i=1, size(hopf))])
      call data%column(rows, "omega", hopf%omega, "angular frequency of its pair")
      call put_curves(data, settings, curves)
      call put_cusps(data, settings%line%model, curves)
   end subroutine put_cycles

   !> Orbits, and the branches they are on.
   subroutine put_orbits(data, model, along, name, meaning, found)
      class(results_type), intent(inout) :: data
      type(model_type), intent(in) :: model
      !> Number of the parameter along the line, its key and what it is
      integer, intent(in) :: along
      character(len=*), intent(in) :: name, meaning
      type(cycles_type), intent(in) :: found(:)
      type(multipliers_type), allocatable :: mu(:)
      type(periodic_orbit_type), allocatable :: orbits(:)
      character(len=:), allocatable :: signal
      character(len=len(found%origin)) :: endings(size(found))
      complex(wp), allocatable :: values(:, :)
      real(wp), allocatable :: range(:, :)
      integer, allocatable :: branch(:)
      integer :: i, k, rows, several

      allocate (mu(0), orbits(0), branch(0))
      do i = 1, size(found)
         orbits = [orbits, found(i)%branch%orbits]
         mu = [mu, found(i)%branch%multipliers(:size(found(i)%branch%orbits))]
         branch = [branch, spread(i, 1, size(found(i)%branch%orbits))]
         endings(i) = found(i)%branch%ending
      end do
      allocate (values(multipliers, size(mu)), source=(0.0_wp, 0.0_wp))
      allocate (range(2, size(orbits)))
      do i = 1, size(orbits)
         range(:, i) = signal_range(model, orbits(i))
         k = min(multipliers, size(mu(i)%values))
         values(:k, i) = mu(i)%values(:k)
      end do
      rows = data%dimension("orbit", size(orbits), coordinates=name//" branch")
      call data%column(rows, name, [(orbits(i)%parameters(along), i=1, size(orbits))], meaning)
      call data%column(rows, "period", orbits%period, "period")
      signal = signal_name(model)
      call data%column(rows, signal//"_least", range(1, :), "least "//signal)
      call data%column(rows, signal//"_most", range(2, :), "greatest "//signal)
      call data%column(rows, "multiplier_error", mu%trivial_error, trivial_error)
      call data%column(rows, "branch", branch, "number of the branch, from 1")
      call data%column(rows, "intervals", [(orbits(i)%intervals(), i=1, size(orbits))], &
                       "intervals of the mesh")
      call data%column(rows, "unstable", [(mu(i)%unstable(), i=1, size(mu))], &
                       "multipliers outside of the unit circle")
      several = data%dimension("multiplier", multipliers)
      call data%table([several, rows], "multiplier_real", real(values), &
                      "real part of the multipliers of greatest modulus")
      call data%table([several, rows], "multiplier_imaginary", aimag(values), &
                      "their imaginary part")
      rows = data%dimension("branches", size(found), prefix="branch_")
      call data%words(rows, "origin", found%origin, "where the branch starts")
      call data%words(rows, "ending", endings, "why it ends")
   end subroutine put_orbits

   !> Least and greatest signal on an orbit.
   pure function signal_range(model, orbit) result(range)
      type(model_type), intent(in) :: model
      type(periodic_orbit_type), intent(in) :: orbit
      real(wp) :: range(2)

      range = orbit%range_of(model%sizes%observed%component)
      if (model%sizes%observed%is_exponential) range = exp(range)
   end function signal_range

   !> A number, NaN where it is not allocated.
   pure real(wp) function known(number) result(value)
      real(wp), intent(in), optional :: number

      value = ieee_value(1.0_wp, ieee_quiet_nan)
      if (present(number)) value = number
   end function known

   !> Special points.
   subroutine put_points(data, model, found)
      class(results_type), intent(inout) :: data
      type(model_type), intent(in) :: model
      type(cycles_type), intent(in) :: found(:)
      type(special_point_type), allocatable :: points(:)
      real(wp), allocatable :: amplitude(:)
      integer, allocatable :: branch(:), resonance(:, :)
      integer :: i, n, rows

      allocate (points(0), branch(0))
      do i = 1, size(found)
         points = [points, found(i)%points]
         branch = [branch, spread(i, 1, size(found(i)%points))]
      end do
      n = size(points)
      allocate (amplitude(n), source=ieee_value(1.0_wp, ieee_quiet_nan))
      allocate (resonance(2, n))
      do i = 1, n
         resonance(:, i) = nearest_resonance(abs(points(i)%angle()))
         if (allocated(points(i)%coefficient) .and. allocated(points(i)%growth)) then
            amplitude(i) = points(i)%torus_amplitude(model%sizes%observed%component)
         end if
      end do
      rows = data%dimension("special", n, prefix="special_")
      call data%words(rows, "kind", points%kind, "kind of the special point")
      call data%words(rows, "criticality", [(points(i)%criticality(), i=1, n)], &
                      "criticality of a torus point")
      call put_places(data, rows, model, [(points(i)%orbit%parameters, i=1, n)])
      call put_size(data, rows, model, points)
      call data%column(rows, "multiplier_real", real(points%multiplier), &
                       "real part of the critical multiplier")
      call data%column(rows, "multiplier_imaginary", aimag(points%multiplier), &
                       "imaginary part of it")
      call data%column(rows, "angle", [(points(i)%angle(), i=1, n)], "angle of it over a full turn")
      call data%column(rows, "multiplier_error", points%trivial_error, trivial_error)
      call data%column(rows, "mesh_error", points%mesh_error, &
                       "difference of the parameter on two meshes")
      call data%column(rows, "coefficient", [(known(points(i)%coefficient), i=1, n)], &
                       "cubic coefficient of a torus point")
      call data%column(rows, "coefficient_error", [(known(points(i)%coefficient_error), i=1, n)], &
                       "difference of it on two meshes")
      call data%column(rows, "amplitude", amplitude, &
                       "half range of maxima of the signal of tori, over root of distance")
      call data%column(rows, "branch", branch, "its branch, from 1")
      call data%column(rows, "unstable_before", points%unstable(1), &
                       "unstable multipliers before it")
      call data%column(rows, "unstable_behind", points%unstable(2), &
                       "unstable multipliers behind it")
      call data%column(rows, "resonance_turns", resonance(1, :), &
                       "p of the fraction p/q nearest to the angle")
      call data%column(rows, "resonance_periods", resonance(2, :), "q of it, at most 10")
   end subroutine put_points

   !> Period and greatest signal of the orbits of special points.
   subroutine put_size(data, rows, model, points)
      class(results_type), intent(inout) :: data
      integer, intent(in) :: rows
      type(model_type), intent(in) :: model
      type(special_point_type), intent(in) :: points(:)
      integer :: i

      call data%column(rows, "period", points%orbit%period, "its period")
      call data%column(rows, signal_name(model)//"_most", &
                       [(maxval(signal_range(model, points(i)%orbit)), i=1, size(points))], &
                       "its greatest "//signal_name(model))
   end subroutine put_size

   !> Curves, each from one end to the other.
   subroutine put_curves(data, settings, curves)
      class(results_type), intent(inout) :: data
      type(cycle_settings_type), intent(in) :: settings
      type(cycle_curve_type), intent(in) :: curves(:)
      type(special_point_type), allocatable :: points(:)
      character(len=:), allocatable :: name
      character(len=kind_length) :: words(size(curves), 3)
      integer, allocatable :: number(:)
      integer :: i, k, n, rows

      allocate (points(0), number(0))
      do i = 1, size(curves)
         associate (first => curves(i)%parts(1)%points, second => curves(i)%parts(2)%points)
            ! both directions have the first point
            points = [points, first(size(first):1:-1), second(2:)]
            number = [number, spread(i, 1, size(first) + size(second) - 1)]
            words(i, 1) = first(1)%kind
         end associate
         words(i, 2) = curves(i)%parts(1)%ending
         words(i, 3) = curves(i)%parts(2)%ending
      end do
      n = size(points)
      rows = data%dimension("curve_point", n)
      if (allocated(settings%curve_along)) then
         do k = 1, 2
            name = trim(settings%line%model%names(settings%curve_along(k)))
            call data%column(rows, "curve_"//name, &
                             [(points(i)%orbit%parameters(settings%curve_along(k)), i=1, n)], &
                             name//" of a point of a curve")
         end do
      end if
      call data%column(rows, "curve_period", points%orbit%period, "its period")
      call data%column(rows, "curve_angle", [(abs(points(i)%angle()), i=1, n)], &
                       "angle of the critical multiplier over a full turn")
      call data%column(rows, "curve_multiplier_error", points%trivial_error, trivial_error)
      call data%column(rows, "curve", number, "number of the curve, from 1")
      rows = data%dimension("curves", size(curves), prefix="curve_")
      call data%words(rows, "kind", words(:, 1), "kind of its points")
      call data%words(rows, "first_end", words(:, 2), "why it ends at its first point")
      call data%words(rows, "last_end", words(:, 3), "why it ends at its last point")
   end subroutine put_curves

   !> Cusps of curves of folds.
   subroutine put_cusps(data, model, curves)
      class(results_type), intent(inout) :: data
      type(model_type), intent(in) :: model
      type(cycle_curve_type), intent(in) :: curves(:)
      type(special_point_type), allocatable :: cusps(:)
      integer, allocatable :: number(:)
      integer :: i, j, k, rows

      allocate (cusps(0), number(0))
      do i = 1, size(curves)
         do k = 1, 2
            associate (more => curves(i)%parts(k)%cusps)
               cusps = [cusps, more]
               number = [number, spread(i, 1, size(more))]
            end associate
         end do
      end do
      rows = data%dimension("cusp", size(cusps), prefix="cusp_")
      call put_places(data, rows, model, [(cusps(j)%orbit%parameters, j=1, size(cusps))])
      call put_size(data, rows, model, cusps)
      call data%column(rows, "multiplier_error", cusps%trivial_error, trivial_error)
      call data%column(rows, "mesh_error", cusps%mesh_error, &
                       "difference of the parameters on two meshes")
      call data%column(rows, "curve", number, "its curve, from 1")
   end subroutine put_cusps
end module cycles_command
