! SPDX-License-Identifier: BSD-3-Clause
!> Attractors of a model on a grid of its parameters, from one history or several, or along a sweep,
!> with their classes.
module attractors_command
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use attractor_points, only: find_attractors, finding_type, point_type, sweep_attractors
   use attractors, only: attractor_settings_type, most_with_zeros
   use dde, only: integration_options
   use dde_errors, only: error_type, text
   use dde_kinds, only: int64, wp
   use exponent_averages, only: sign_of
   use model_attributes, only: put_model, put_places
   use model_history, only: history_type, shown_name, signal_name
   use model_problem, only: model_type
   use motion_classes, only: class_names, cycle_motion, fixed_point, reason_names
   use points_request, only: points_settings_type
   use request, only: request_type, word_length
   use results, only: results_type
   use value_checks, only: check_count, check_number, missing, missing_count, most_samples
   implicit none (type, external)
   private
   public :: run_attractors

   !> How the solver takes steps.
   type :: solver_settings_type
      !> One of the solver's methods
      character(len=word_length) :: method = ""
      !> Relative and absolute tolerance of one step
      real(wp) :: tolerance = missing
      !> Most steps of one integration
      integer(int64) :: most_steps = missing_count
   end type solver_settings_type

   !> Letters of the longest reason why no attractor was found.
   integer, parameter :: longest_problem = 1000

contains

   !> Run the command.
   subroutine run_attractors(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(attractor_settings_type) :: settings
      type(finding_type), allocatable :: findings(:)
      type(integration_options) :: options
      type(points_settings_type) :: points
      type(history_type) :: history
      type(model_type) :: model
      type(point_type), allocatable :: list(:)

      call read_attractors(given, settings, options, points, model, history, error)
      if (allocated(error)) return
      list = points%list(model, history)
      call given%progress%begin("attractors of "//trim(points%name))
      if (points%sweep == "none") then
         call find_attractors(model, list, settings, options, findings, given%progress, &
                              points%columns(), points%refinements)
      else
         call sweep_attractors(model, list, settings, options, findings, given%progress)
      end if
      call put_attractors(data, points, model, history, list, settings, options, findings)
   end subroutine run_attractors

   !> Read and check all sections.
   subroutine read_attractors(given, observation, options, points, model, history, error)
      class(request_type), intent(inout) :: given
      !> How attractors are judged
      type(attractor_settings_type), intent(out) :: observation
      !> Method, tolerances and limits
      type(integration_options), intent(out) :: options
      !> Where they are looked for
      type(points_settings_type), intent(out) :: points
      type(model_type), intent(out) :: model
      !> Histories from which they are reached
      type(history_type), intent(out) :: history
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(solver_settings_type) :: solver
      character(len=:), allocatable :: place
      namelist /settings/ observation, solver, points

      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      write (given%copy, nml=settings, delim="quote")
      call given%check(error)
      place = given%place//"observation: "
      options = integration_options(method=trim(solver%method), relative=solver%tolerance, &
                                    absolute=solver%tolerance, most_steps=solver%most_steps)
      call check_count(error, place, "exponents", observation%exponents, &
                       at_least=2, at_most=1000)
      call check_number(error, place, "interval", observation%interval, &
                        above=0.0_wp)
      call check_number(error, place, "t_path", observation%t_path, &
                        at_least=0.0_wp)
      call check_number(error, place, "sample_interval", &
                        observation%sample_interval, above=0.0_wp, &
                        at_least=max(0.0_wp, observation%t_path, &
                                                  observation%t_observed)/most_samples)
      call points%open(given, model, error)
      call given%read_histories(model, history, error)
   end subroutine read_attractors

   !> What was found at each point.
   subroutine put_attractors(data, points, model, history, list, settings, options, findings)
      class(results_type), intent(inout) :: data
      !> Where attractors were looked for, and what is kept of each
      type(points_settings_type), intent(in) :: points
      type(model_type), intent(in) :: model
      type(history_type), intent(in) :: history
      type(point_type), intent(in) :: list(:)
      type(attractor_settings_type), intent(in) :: settings
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      type(finding_type), intent(in) :: findings(:)
      character(len=*), parameter :: ordinals(3) = ["first ", "second", "third "]
      real(wp), dimension(size(findings)) :: least, mean_time, most, variation
      character(len=:), allocatable :: name
      integer :: i, k, rows

      name = signal_name(model)
      call data%attribute("title", "Attractors of a model")
      call data%attribute("name", trim(points%name))
      call put_model(data, model, points%axes%along)
      call data%attribute("axes", trim(points%axes(1)%along)//" "//trim(points%axes(2)%along))
      call data%attribute("sweep", trim(points%sweep))
      call data%attribute("refinements", int(points%refinements, int64))
      call data%attribute("method", trim(options%method))
      call data%attribute("tolerance", options%relative)
      call data%attribute("t_transient", settings%t_transient)
      call data%attribute("t_observed", settings%t_observed)
      call data%attribute("t_lasting", settings%t_lasting)
      call data%attribute("t_turning", settings%t_turning)
      call data%attribute("interval", settings%interval)
      call data%attribute("zero_level", settings%zero_level)
      call data%attribute("longest_bar", settings%longest_bar)
      call data%attribute("sample_interval", settings%sample_interval)
      rows = data%dimension("point", size(findings))
      call put_places(data, rows, model, [(list(i)%numbers, i=1, size(list))])
      associate (found => findings%attractor)
         if (model%shape%blocks > 1) then
            call data%column(rows, "history", list%history, "number of the history")
         else if (allocated(history%values)) then
            do k = 1, size(history%names)
               call data%column(rows, "history_"//trim(history%names(k)), &
                                history%values(k, 1, list%history), &
                                trim(history%names(k))//" for t <= 0")
            end do
         end if
         call data%answers(rows, "computed", findings%computed, "whether the motion was " &
                           //"computed; if not, class and period are those of the neighbours")
         call data%flags(rows, "class", found%class, class_names, "class of the motion")
         call data%flags(rows, "reason", found%reason, reason_names, "why the class is undecided")
         call put_found("time", found%time, "time until the class was certain, or the limit")
         call data%flags(rows, "by_exponents", found%by_exponents, class_names, &
                         "class by Lyapunov exponents")
         call data%flags(rows, "by_section", found%by_section, class_names, &
                         "class by the section")
         call data%flags(rows, "by_spectrum", found%by_spectrum, class_names, &
                         "class by the spectrum of "//name)
         call put_exponents()
         call data%column(rows, "period", found%period, "points of a cycle in the section, 0: none")
         call put_found("roughness", found%roughness, &
                        "of the section as a function of two phases, of three on a 3-torus, "// &
                        "0: smooth, 1: random")
         do i = 1, 3
            call data%column(rows, "base_"//text(i), found%bases(i), &
                             trim(ordinals(i))//" fundamental frequency of "//name//", 0: none")
         end do
         call put_found("line_share", found%line_share, &
                        "share of the power of "//name//" in the lines of the first two")
         do i = 1, size(findings)
            call reach(findings(i), least(i), most(i))
            call recur(findings(i), mean_time(i), variation(i))
         end do
         call data%column(rows, "smallest_maximum", least, "smallest maximum of "//name)
         call data%column(rows, "largest_maximum", most, "largest maximum of "//name)
         call data%column(rows, "recurrence_time", mean_time, &
                          "mean time between passages of the section")
         call data%column(rows, "recurrence_variation", variation, &
                          "standard deviation of this time over its mean")
      end associate
      call put_kept(data, model, points%kept, findings, rows)
      if (settings%t_path > 0.0_wp) call put_paths(data, model, settings%t_path, findings, rows)
      call put_problems(data, findings, rows)

   contains

      !> A number at each point where it was measured, NaN at the others.
      subroutine put_found(name, values, long_name)
         character(len=*), intent(in) :: name
         !> Values of the variable, negative where it was not measured
         real(wp), intent(in) :: values(:)
         character(len=*), intent(in) :: long_name

         call data%column(rows, name, merge(values, ieee_value(1.0_wp, ieee_quiet_nan), &
                                            findings%computed .and. values >= 0.0_wp), long_name)
      end subroutine put_found

      !> Exponents and their errors.
      subroutine put_exponents()
         real(wp), dimension(max(most_with_zeros, settings%exponents), size(findings)) :: &
            bars, signs, values
         integer :: dimensions(2), k, n

         values = ieee_value(1.0_wp, ieee_quiet_nan)
         bars = values
         signs = values
         do k = 1, size(findings)
            if (.not. allocated(findings(k)%attractor%exponents)) cycle
            n = size(findings(k)%attractor%exponents)
            values(:n, k) = findings(k)%attractor%exponents%value
            bars(:n, k) = findings(k)%attractor%exponents%error
            signs(:n, k) = sign_of(findings(k)%attractor%exponents, settings%zero_level, &
                                   settings%longest_bar)
         end do
         dimensions = [data%dimension("exponent", size(values, 1)), rows]
         call data%table(dimensions, "lyapunov_exponent", values, "Lyapunov exponents, descending")
         call data%table(dimensions, "lyapunov_error", bars, "standard errors of the exponents")
         call data%table(dimensions, "sign", signs, "sign of the exponent, 2: unclear")
      end subroutine put_exponents
   end subroutine put_attractors

   !> Smallest and largest maximum of the signal, of a cycle the last quarter: the others may belong
   !> to the approach; NaN where there is none.
   pure subroutine reach(finding, least, most)
      type(finding_type), intent(in) :: finding
      real(wp), intent(out) :: least
      real(wp), intent(out) :: most
      integer :: first

      least = ieee_value(1.0_wp, ieee_quiet_nan)
      most = least
      if (.not. allocated(finding%attractor%motion%maxima)) return
      associate (maxima => finding%attractor%motion%maxima)
         if (size(maxima) == 0) return
         first = 1
         if (finding%attractor%class == cycle_motion) first = size(maxima) - size(maxima)/4
         least = minval(maxima(first:))
         most = maxval(maxima(first:))
      end associate
   end subroutine reach

   !> Mean of the times between passages of the section and their standard deviation over it; of a
   !> cycle those of its last period, if the section has one. NaN at rest or with too few passages.
   pure subroutine recur(finding, mean, variation)
      type(finding_type), intent(in) :: finding
      real(wp), intent(out) :: mean
      real(wp), intent(out) :: variation
      integer :: first, last

      mean = ieee_value(1.0_wp, ieee_quiet_nan)
      variation = mean
      if (.not. allocated(finding%attractor%motion%section_time)) return
      associate (found => finding%attractor, time => finding%attractor%motion%section_time)
         last = size(time)
         first = 1
         if (found%class == cycle_motion .and. found%period > 0) first = max(1, last - found%period)
         if (found%class == fixed_point .or. last == first) return
         associate (between => time(first + 1:) - time(first:last - 1))
            mean = sum(between)/size(between)
            variation = norm2(between - mean)/sqrt(real(size(between), wp))/mean
         end associate
      end associate
   end subroutine recur

   !> The last maxima and points of the section, if any are wanted; NaN where there are fewer.
   subroutine put_kept(data, model, kept, findings, rows)
      class(results_type), intent(inout) :: data
      type(model_type), intent(in) :: model
      integer, intent(in) :: kept
      type(finding_type), intent(in) :: findings(:)
      integer, intent(in) :: rows
      real(wp), dimension(kept, size(findings)) :: first_coordinate, maxima, second_coordinate
      integer :: dimensions(2), first, i, n

      if (kept == 0) return
      maxima = ieee_value(1.0_wp, ieee_quiet_nan)
      first_coordinate = maxima
      second_coordinate = maxima
      do i = 1, size(findings)
         associate (found => findings(i)%attractor)
            if (.not. allocated(found%motion%maxima)) cycle
            n = min(kept, size(found%motion%maxima))
            first = size(found%motion%maxima) - n + 1
            maxima(:n, i) = found%motion%maxima(first:)
            n = min(kept, size(found%motion%section, 2))
            first = size(found%motion%section, 2) - n + 1
            first_coordinate(:n, i) = found%motion%section(1, first:)
            second_coordinate(:n, i) = found%motion%section(2, first:)
         end associate
      end do
      dimensions = [data%dimension("kept", kept), rows]
      call data%table(dimensions, "maximum", maxima, &
                      "maxima of "//signal_name(model)//", in order of time")
      call put_coordinate(1, first_coordinate)
      call put_coordinate(2, second_coordinate)

   contains

      !> A coordinate of points of the section.
      subroutine put_coordinate(number, values)
         integer, intent(in) :: number
         real(wp), intent(in) :: values(:, :)
         character(len=:), allocatable :: name

         associate (given => model%sizes%observed%coordinates)
            if (given(number) > 0) then
               name = shown_name(model, given(number))
            else if (number == 1 + count(given > 0)) then
               name = "time"
            else
               name = "peak"
            end if
         end associate
         call data%table(dimensions, "section_"//name, values, name//" in the section")
      end subroutine put_coordinate
   end subroutine put_kept

   !> Paths one after another, and how many points each has; 0 at rest.
   subroutine put_paths(data, model, t_path, findings, rows)
      class(results_type), intent(inout) :: data
      type(model_type), intent(in) :: model
      real(wp), intent(in) :: t_path
      type(finding_type), intent(in) :: findings(:)
      integer, intent(in) :: rows
      real(wp), allocatable :: line(:, :)
      character(len=:), allocatable :: name
      integer :: dimension, i, lengths(size(findings)), shown(2)

      call data%attribute("t_path", t_path)
      lengths = 0
      do i = 1, size(findings)
         associate (found => findings(i)%attractor)
            if (allocated(found%path)) lengths(i) = size(found%path, 2)
         end associate
      end do
      allocate (line(3, sum(lengths)))
      do i = 1, size(findings)
         if (lengths(i) == 0) cycle
         associate (before => sum(lengths(:i - 1)))
            line(:, before + 1:before + lengths(i)) = findings(i)%attractor%path
         end associate
      end do
      call data%column(rows, "path_length", lengths, "number of points of the path", &
                       lengths_along="path_point")
      ! a dimension of length zero would be an unlimited one
      if (sum(lengths) == 0) return
      dimension = data%dimension("path_point", sum(lengths), prefix="path_")
      call data%column(dimension, "time", line(1, :), "time from the beginning of the path")
      associate (observed => model%sizes%observed)
         shown = [maxval(observed%coordinates), observed%component]
      end associate
      do i = 1, 2
         if (shown(i) == 0) cycle
         name = shown_name(model, shown(i))
         call data%column(dimension, name, line(i + 1, :), name//" along the path")
      end do
   end subroutine put_paths

   !> Why no attractor was found, blank where one was.
   subroutine put_problems(data, findings, rows)
      class(results_type), intent(inout) :: data
      type(finding_type), intent(in) :: findings(:)
      integer, intent(in) :: rows
      character(len=longest_problem) :: words(size(findings))
      integer :: i

      words = ""
      do i = 1, size(findings)
         if (allocated(findings(i)%problem)) words(i) = findings(i)%problem%message
      end do
      call data%words(rows, "problem", words, "why no attractor was found")
   end subroutine put_problems
end module attractors_command
