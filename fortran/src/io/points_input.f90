!> Points at which attractors are looked for: a rectangle of a grid in (epsilon, tau) and a list of
!> histories, from the namelist group &points.
module points_input
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use attractor_points, only: point_type
   use block_parameters, only: block_history_type, block_parameters_type, check_quantity
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use namelist_input, only: close_namelist, not_given, open_namelist, word_length
   use value_checks, only: check_count, check_number
   implicit none (type, external)
   private
   public :: points_settings_type, read_points

   !> Most histories.
   integer, parameter :: most_histories = 1000
   !> Most points along a side of the grid, and most in all.
   integer, parameter :: most_places = 100000, most_points = 1000000
   !> Most maxima and points of the section kept of each.
   integer, parameter :: most_kept = 100000
   !> Longest name.
   integer, parameter :: longest_name = 128

   !> Evenly spaced values of one parameter, and which of them are wanted.
   type :: axis_type
      !> First and last value
      real(wp) :: window(2) = 0.0_wp
      !> Number of values; the first alone when 1
      integer :: places = 0
      !> First and last that are wanted, from 1
      integer :: wanted(2) = 0
   end type axis_type

   !> What is looked for, and what is kept of it.
   type :: points_settings_type
      !> Name of what the points belong to
      character(len=word_length) :: name = ""
      !> The points, of which epsilon runs fastest, histories slowest
      type(point_type), allocatable :: points(:)
      !> Most maxima and points of the section kept of each
      integer :: kept = 0
   end type points_settings_type

contains

   !> Read and check the points.
   subroutine read_points(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The points
      type(points_settings_type), intent(out) :: settings
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(axis_type) :: epsilon_axis, tau_axis
      real(wp) :: gamma, theta(most_histories), u(most_histories), v(most_histories), xi
      integer :: histories, i, j, k

      call read_group(path, settings, xi, gamma, epsilon_axis, tau_axis, theta, u, v, error)
      call check_count(error, path, "letters of name", len_trim(settings%name), at_least=1, &
                       at_most=longest_name)
      call check_quantity(error, path, "xi", xi)
      call check_quantity(error, path, "gamma", gamma)
      call check_count(error, path, "kept", settings%kept, at_least=0, at_most=most_kept)
      call check_axis(error, path, "epsilon", epsilon_axis)
      call check_axis(error, path, "tau", tau_axis)
      do i = 1, 2
         call check_quantity(error, path, "epsilon", epsilon_axis%window(i), "epsilon_window")
         call check_quantity(error, path, "tau", tau_axis%window(i), "tau_window")
      end do
      histories = maxval([(i, i=1, most_histories)], &
                         mask=.not. (ieee_is_nan(theta) .and. ieee_is_nan(u) .and. ieee_is_nan(v)))
      call check_count(error, path, "number of histories", max(0, histories), at_least=1)
      do i = 1, histories
         call check_quantity(error, path, "theta", theta(i), "theta("//text(i)//")")
         call check_quantity(error, path, "u", u(i), "u("//text(i)//")")
         call check_quantity(error, path, "v", v(i), "v("//text(i)//")")
      end do
      if (allocated(error)) return
      associate (columns => epsilon_axis%wanted, rows => tau_axis%wanted)
         call check_number(error, path, "number of points", &
                           real(histories, wp)*(columns(2) - columns(1) + 1) &
                           *(rows(2) - rows(1) + 1), at_most=real(most_points, wp))
         if (allocated(error)) return
         settings%points = [(((point_type( &
                               block_parameters_type(tau=value_at(tau_axis, j), xi=xi, &
                                                     epsilon=value_at(epsilon_axis, i), &
                                                     gamma=gamma), &
                               block_history_type(theta=theta(k), u=u(k), v=v(k))), &
                               i=columns(1), columns(2)), j=rows(1), rows(2)), k=1, histories)]
      end associate
   end subroutine read_points

   !> A value on an axis.
   pure real(wp) function value_at(axis, i) result(value)
      !> The axis
      type(axis_type), intent(in) :: axis
      !> Which, from 1
      integer, intent(in) :: i

      associate (share => real(i - 1, wp)/max(1, axis%places - 1))
         value = (1.0_wp - share)*axis%window(1) + share*axis%window(2)
      end associate
   end function value_at

   !> Refuse a part of the grid that is not in it.
   pure subroutine check_axis(error, path, name, axis)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> Name of the parameter
      character(len=*), intent(in) :: name
      !> The axis
      type(axis_type), intent(in) :: axis

      call check_count(error, path, name//"_count", axis%places, at_least=1, at_most=most_places)
      if (allocated(error)) return
      if (1 <= axis%wanted(1) .and. axis%wanted(1) <= axis%wanted(2) &
          .and. axis%wanted(2) <= axis%places) return
      call raise(error, path//": "//name//"_part = "//text(axis%wanted(1))//", " &
                 //text(axis%wanted(2))//"; expected first and last, 1 <= first <= last <= " &
                 //text(axis%places))
   end subroutine check_axis

   !> Read the group &points.
   subroutine read_group(path, settings, xi, gamma, epsilon_axis, tau_axis, theta, u, v, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> Name and what is kept
      type(points_settings_type), intent(out) :: settings
      !> Spring constant
      real(wp), intent(out) :: xi
      !> Frequency
      real(wp), intent(out) :: gamma
      !> Values of epsilon and tau
      type(axis_type), intent(out) :: epsilon_axis, tau_axis
      !> Histories, NaN beyond the last
      real(wp), intent(out) :: theta(:), u(:), v(:)
      !> They cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=len(settings%name)) :: name
      real(wp) :: epsilon_window(2), tau_window(2)
      integer :: epsilon_count, epsilon_part(2), kept, status, tau_count, tau_part(2), unit
      character(len=256) :: reason
      namelist /points/ name, xi, gamma, epsilon_window, epsilon_count, epsilon_part, tau_window, &
         tau_count, tau_part, theta, u, v, kept

      name = ""
      xi = not_given()
      gamma = xi
      epsilon_window = xi
      tau_window = xi
      theta = xi
      u = xi
      v = xi
      epsilon_count = 0
      tau_count = 0
      epsilon_part = 0
      tau_part = 0
      kept = -1
      call open_namelist(path, unit, error)
      if (allocated(error)) return
      read (unit, nml=points, iostat=status, iomsg=reason)
      call close_namelist(path, "points", unit, status, reason, error)
      settings%name = name
      settings%kept = kept
      epsilon_axis = axis_type(epsilon_window, epsilon_count, epsilon_part)
      tau_axis = axis_type(tau_window, tau_count, tau_part)
   end subroutine read_group
end module points_input
