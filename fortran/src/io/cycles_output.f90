!> Files of cycles along a line of parameters.
module cycles_output
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use block_family, only: vector_of
   use block_cycles, only: cycle_settings_type, cycles_type, left_out_type
   use cycle_curves, only: cycle_curve_type
   use cycle_lines, only: hopf_start_type
   use cycles_input, only: names_along
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use netcdf_output, only: output_file_type
   use special_points, only: kind_length, nearest_resonance, special_point_type
   use spring_block, only: index_of_ln_v
   implicit none (type, external)
   private
   public :: write_cycles

   !> Multipliers written for each orbit
   integer, parameter :: multipliers = 4
   !> Letters of the origin and of the ending of a branch
   integer, parameter :: word_length = 16

contains

   !> Write the orbits of all branches one after another, the branches, the starts left out, the
   !> special points, the Hopf points, the points of all curves one after another, and their cusps.
   subroutine write_cycles(path, settings, hopf, found, left_out, curves, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> What was asked
      type(cycle_settings_type), intent(in) :: settings
      !> Hopf points
      type(hopf_start_type), intent(in) :: hopf(:)
      !> Branches
      type(cycles_type), intent(in) :: found(:)
      !> Starts without a branch of their own
      type(left_out_type), intent(in) :: left_out(:)
      !> Curves of special points
      type(cycle_curve_type), intent(in) :: curves(:)
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      real(wp) :: fixed(size(names_along))
      integer :: i

      call file%create(path, "Cycles along a line of parameters: stable and unstable branches")
      associate (p => settings%line%parameters, along => settings%line%along)
         call file%attribute("along", trim(names_along(along)))
         fixed = vector_of(p)
         do i = 1, size(names_along)
            if (i /= along) call file%attribute(trim(names_along(i)), fixed(i))
         end do
         call file%attribute("degree", int(settings%degree, int64))
      end associate
      call put_orbits(file, settings%line%along, found)
      call put_left_out(file, settings%line%along, left_out)
      call put_points(file, found)
      call put_hopf(file, hopf)
      call put_curves(file, curves)
      call put_cusps(file, curves)
      call file%finish(error)
   end subroutine write_cycles

   !> Orbits, and the branches they are on.
   subroutine put_orbits(file, along, found)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Number of the parameter along the line
      integer, intent(in) :: along
      !> Branches
      type(cycles_type), intent(in) :: found(:)
      real(wp), allocatable :: columns(:, :), imaginary(:, :), real_part(:, :)
      integer, allocatable :: branch(:), intervals(:), unstable(:)
      character(len=word_length) :: words(size(found), 2)
      integer :: all, i, id(5), j, k, row, rows, several

      all = 0
      do i = 1, size(found)
         all = all + size(found(i)%branch%orbits)
         words(i, 1) = found(i)%origin
         words(i, 2) = found(i)%branch%ending
      end do
      allocate (columns(all, 5), branch(all), intervals(all), unstable(all))
      allocate (real_part(multipliers, all), imaginary(multipliers, all), source=0.0_wp)
      row = 0
      do i = 1, size(found)
         do j = 1, size(found(i)%branch%orbits)
            row = row + 1
            associate (orbit => found(i)%branch%orbits(j), mu => found(i)%branch%multipliers(j))
               columns(row, 1:2) = [orbit%parameters(along), orbit%period]
               columns(row, 3:4) = exp(orbit%range_of(index_of_ln_v))
               columns(row, 5) = mu%trivial_error
               branch(row) = i
               intervals(row) = orbit%intervals()
               unstable(row) = mu%unstable()
               k = min(multipliers, size(mu%values))
               real_part(:k, row) = real(mu%values(:k))
               imaginary(:k, row) = aimag(mu%values(:k))
            end associate
         end do
      end do
      rows = file%dimension("orbit", all, coordinates=trim(names_along(along))//" branch")
      id(1) = file%real_variable(trim(names_along(along)), rows, "parameter along the line", "1")
      id(2) = file%real_variable("period", rows, "period", "1")
      id(3) = file%real_variable("v_least", rows, "least velocity", "1")
      id(4) = file%real_variable("v_most", rows, "greatest velocity", "1")
      id(5) = file%real_variable("multiplier_error", rows, &
                                 "distance of the trivial multiplier from 1", "1")
      do i = 1, size(id)
         call file%put(id(i), columns(:, i))
      end do
      call file%put(file%integer_variable("branch", rows, "number of the branch, from 1"), branch)
      call file%put(file%integer_variable("intervals", rows, "intervals of the mesh"), intervals)
      call file%put(file%integer_variable("unstable", rows, &
                                          "multipliers outside of the unit circle"), unstable)
      several = file%dimension("multiplier", multipliers)
      call file%table("multiplier_real", [several, rows], real_part, &
                      "real part of the multipliers of greatest modulus")
      call file%table("multiplier_imaginary", [several, rows], imaginary, "their imaginary part")
      rows = file%dimension("branches", size(found))
      call file%words("branch_origin", rows, words(:, 1), "where the branch starts")
      call file%words("branch_ending", rows, words(:, 2), "why it ends")
   end subroutine put_orbits

   !> Starts from which no branch was followed.
   subroutine put_left_out(file, along, left_out)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Number of the parameter along the line
      integer, intent(in) :: along
      !> These starts
      type(left_out_type), intent(in) :: left_out(:)
      integer :: rows

      rows = file%dimension("left_out", size(left_out))
      call file%words("left_out_origin", rows, left_out%origin, "where it starts")
      call file%put(file%real_variable("left_out_"//trim(names_along(along)), rows, &
                                       "parameter along the line", "1"), left_out%at)
      call file%words("left_out_reason", rows, left_out%reason, "why no branch was followed")
   end subroutine put_left_out

   !> Special points.
   subroutine put_points(file, found)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Branches
      type(cycles_type), intent(in) :: found(:)
      character(len=kind_length), allocatable :: words(:, :)
      real(wp), allocatable :: columns(:, :)
      integer, allocatable :: numbers(:, :)
      integer :: all, i, id, j, row, rows
      character(len=*), parameter :: names(14) = [character(len=24) :: &
                                                  "tau", "epsilon", "xi", "gamma", "period", &
                                                  "v_most", "multiplier_real", &
                                                  "multiplier_imaginary", "angle", &
                                                  "multiplier_error", "mesh_error", &
                                                  "coefficient", "coefficient_error", "amplitude"]
      character(len=*), parameter :: meanings(14) = [character(len=60) :: &
                                                     "its tau", "its epsilon", "its xi", &
                                                     "its gamma", "its period", &
                                                     "its greatest velocity", &
                                                     "real part of the critical multiplier", &
                                                     "imaginary part of it", &
                                                     "angle of it over a full turn", &
                                                     "distance of the trivial multiplier from 1", &
                                                     "difference of the parameter on two meshes", &
                                                     "cubic coefficient of a torus point", &
                                                     "difference of it on two meshes", &
                                                     "half range of maxima of ln v of tori, &
                                                     &over root of distance"]
      character(len=*), parameter :: counts(5) = [character(len=24) :: &
                                                  "branch", "unstable_before", "unstable_behind", &
                                                  "resonance_turns", "resonance_periods"]
      character(len=*), parameter :: count_meanings(5) = [character(len=60) :: &
                                                          "its branch, from 1", &
                                                          "unstable multipliers before it", &
                                                          "unstable multipliers behind it", &
                                                          "p of the fraction p/q nearest to the &
                                                          &angle", "q of it, at most 10"]

      all = sum([(size(found(i)%points), i=1, size(found))])
      allocate (words(all, 2), columns(all, size(names)), numbers(all, size(counts)))
      columns = ieee_value(1.0_wp, ieee_quiet_nan)
      row = 0
      do i = 1, size(found)
         do j = 1, size(found(i)%points)
            row = row + 1
            associate (point => found(i)%points(j))
               words(row, :) = [point%kind, point%criticality()]
               columns(row, :4) = point%orbit%parameters
               columns(row, 5) = point%orbit%period
               columns(row, 6) = exp(maxval(point%orbit%range_of(index_of_ln_v)))
               columns(row, 7:11) = [real(point%multiplier), aimag(point%multiplier), &
                                     point%angle(), point%trivial_error, point%mesh_error]
               if (allocated(point%coefficient)) columns(row, 12) = point%coefficient
               if (allocated(point%coefficient_error)) columns(row, 13) = point%coefficient_error
               if (allocated(point%coefficient) .and. allocated(point%growth)) then
                  columns(row, 14) = point%torus_amplitude(index_of_ln_v)
               end if
               numbers(row, :) = [i, point%unstable, nearest_resonance(abs(point%angle()))]
            end associate
         end do
      end do
      rows = file%dimension("special", all, coordinates="special_tau special_epsilon")
      call file%words("special_kind", rows, words(:, 1), "kind of the special point")
      call file%words("special_criticality", rows, words(:, 2), "criticality of a torus point")
      do i = 1, size(names)
         id = file%real_variable("special_"//trim(names(i)), rows, trim(meanings(i)), "1")
         call file%put(id, columns(:, i))
      end do
      do i = 1, size(counts)
         id = file%integer_variable("special_"//trim(counts(i)), rows, trim(count_meanings(i)))
         call file%put(id, numbers(:, i))
      end do
   end subroutine put_points

   !> Curves, each from one end to the other.
   subroutine put_curves(file, curves)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> The curves
      type(cycle_curve_type), intent(in) :: curves(:)
      character(len=kind_length) :: words(size(curves), 3)
      real(wp), allocatable :: columns(:, :)
      integer, allocatable :: number(:)
      integer :: all, i, id(5), j, k, row, rows

      all = 0
      do i = 1, size(curves)
         words(i, 1) = curves(i)%parts(1)%points(1)%kind
         do k = 1, 2
            words(i, 1 + k) = curves(i)%parts(k)%ending
            all = all + size(curves(i)%parts(k)%points)
         end do
         ! both directions have the first point
         all = all - 1
      end do
      allocate (columns(all, 5), number(all))
      row = 0
      do i = 1, size(curves)
         do j = size(curves(i)%parts(1)%points), 2 - size(curves(i)%parts(2)%points), -1
            row = row + 1
            number(row) = i
            associate (point => curves(i)%parts(merge(1, 2, j > 0))%points(merge(j, 2 - j, j > 0)))
               columns(row, :) = [point%orbit%parameters(2), point%orbit%parameters(1), &
                                  point%orbit%period, abs(point%angle()), point%trivial_error]
            end associate
         end do
      end do
      rows = file%dimension("curve_point", all, coordinates="curve_tau curve_epsilon")
      id(1) = file%real_variable("curve_epsilon", rows, "epsilon of a point of a curve", "1")
      id(2) = file%real_variable("curve_tau", rows, "its tau", "1")
      id(3) = file%real_variable("curve_period", rows, "its period", "1")
      id(4) = file%real_variable("curve_angle", rows, &
                                 "angle of the critical multiplier over a full turn", "1")
      id(5) = file%real_variable("curve_multiplier_error", rows, &
                                 "distance of the trivial multiplier from 1", "1")
      do i = 1, size(id)
         call file%put(id(i), columns(:, i))
      end do
      call file%put(file%integer_variable("curve", rows, "number of the curve, from 1"), number)
      rows = file%dimension("curves", size(curves))
      call file%words("curve_kind", rows, words(:, 1), "kind of its points")
      call file%words("curve_first_end", rows, words(:, 2), "why it ends at its first point")
      call file%words("curve_last_end", rows, words(:, 3), "why it ends at its last point")
   end subroutine put_curves

   !> Cusps of curves of folds.
   subroutine put_cusps(file, curves)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> The curves
      type(cycle_curve_type), intent(in) :: curves(:)
      integer :: i, id(8), k, rows
      integer, allocatable :: number(:)
      real(wp) :: columns(8, sum([((size(curves(i)%parts(k)%cusps), k=1, 2), i=1, size(curves))]))

      allocate (number(0))
      do i = 1, size(curves)
         do k = 1, 2
            call add_cusps(curves(i)%parts(k)%cusps)
         end do
      end do
      rows = file%dimension("cusp", size(number), coordinates="cusp_tau cusp_epsilon")
      do i = 1, 4
         id(i) = file%real_variable("cusp_"//trim(names_along(i)), rows, &
                                    trim(names_along(i))//" of a cusp of a curve of folds", "1")
      end do
      id(5) = file%real_variable("cusp_period", rows, "its period", "1")
      id(6) = file%real_variable("cusp_v_most", rows, "its greatest velocity", "1")
      id(7) = file%real_variable("cusp_multiplier_error", rows, &
                                 "distance of the trivial multiplier from 1", "1")
      id(8) = file%real_variable("cusp_mesh_error", rows, &
                                 "difference of tau or epsilon on two meshes", "1")
      do i = 1, size(id)
         call file%put(id(i), columns(i, :))
      end do
      call file%put(file%integer_variable("cusp_curve", rows, "its curve, from 1"), number)

   contains

      !> Columns of more cusps.
      subroutine add_cusps(cusps)
         !> The cusps
         type(special_point_type), intent(in) :: cusps(:)
         integer :: j

         do j = 1, size(cusps)
            number = [number, i]
            associate (orbit => cusps(j)%orbit, column => columns(:, size(number)))
               column(:4) = orbit%parameters
               column(5:) = [orbit%period, exp(maxval(orbit%range_of(index_of_ln_v))), &
                             cusps(j)%trivial_error, cusps(j)%mesh_error]
            end associate
         end do
      end subroutine add_cusps
   end subroutine put_cusps

   !> Hopf points.
   subroutine put_hopf(file, hopf)
      !> The file
      type(output_file_type), intent(inout) :: file
      !> Hopf points
      type(hopf_start_type), intent(in) :: hopf(:)
      real(wp) :: places(4, size(hopf))
      integer :: i, id(5), rows

      do i = 1, size(hopf)
         places(:, i) = vector_of(hopf(i)%parameters)
      end do
      rows = file%dimension("hopf", size(hopf), coordinates="hopf_tau hopf_epsilon")
      do i = 1, 4
         id(i) = file%real_variable("hopf_"//trim(names_along(i)), rows, &
                                    trim(names_along(i))//" of the Hopf point", "1")
      end do
      id(5) = file%real_variable("hopf_omega", rows, "angular frequency of its pair", "1")
      do i = 1, 4
         call file%put(id(i), places(i, :))
      end do
      call file%put(id(5), hopf%omega)
   end subroutine put_hopf
end module cycles_output
