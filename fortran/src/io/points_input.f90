!> Points at which attractors are looked for, from the namelist group &points: a grid in the four
!> parameters of the block and a list of histories, or a sweep along one parameter.
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
   !> Most values of a parameter, and most points in all.
   integer, parameter :: most_places = 100000, most_points = 1000000
   !> Most maxima and points of the section kept of each.
   integer, parameter :: most_kept = 100000
   !> Most refinements: every 16th line is computed first.
   integer, parameter :: most_refinements = 4
   !> Longest name.
   integer, parameter :: longest_name = 128
   !> Directions of a sweep.
   character(len=*), parameter :: directions(3) = ["none", "up  ", "down"]

   !> Names of the axes in the order of the grid, the first runs fastest, and their numbers.
   character(len=*), parameter :: names(4) = ["epsilon", "tau    ", "xi     ", "gamma  "]
   enum, bind(c)
      enumerator :: of_epsilon = 1, of_tau, of_xi, of_gamma
   end enum

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
      !> The points, of which epsilon runs fastest, then tau, xi, gamma, and histories slowest; of a
      !> sweep in its order
      type(point_type), allocatable :: points(:)
      !> Whether each point starts where the one before ended: "none", "up" or "down"
      character(len=word_length) :: sweep = "none"
      !> Points in a line of the grid
      integer :: columns = 0
      !> Every 2**refinements-th line in epsilon and tau is computed in full
      integer :: refinements = 0
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
      type(axis_type) :: axes(size(names))
      real(wp) :: theta(most_histories), u(most_histories), v(most_histories)
      integer :: histories, i

      call read_group(path, settings, axes, theta, u, v, error)
      call check_count(error, path, "letters of name", len_trim(settings%name), at_least=1, &
                       at_most=longest_name)
      call check_count(error, path, "kept", settings%kept, at_least=0, at_most=most_kept)
      do i = 1, size(axes)
         call check_axis(error, path, trim(names(i)), axes(i))
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
      call check_number(error, path, "number of points", &
                        product([real(histories, wp), real(wanted(axes), wp)]), &
                        at_most=real(most_points, wp))
      call check_sweep(error, path, settings%sweep, axes, histories)
      call check_refinements(error, path, settings, axes, histories)
      if (allocated(error)) return
      settings%columns = wanted(axes(of_epsilon))
      settings%points = grid_of(axes, [(block_history_type(theta=theta(i), u=u(i), v=v(i)), &
                                        i=1, histories)])
      if (settings%sweep == "down") then
         settings%points = settings%points(size(settings%points):1:-1)
      end if
   end subroutine read_points

   !> All points of a grid.
   pure function grid_of(axes, histories) result(points)
      !> The axes
      type(axis_type), intent(in) :: axes(:)
      !> The histories
      type(block_history_type), intent(in) :: histories(:)
      type(point_type), allocatable :: points(:)
      integer :: from(size(axes)), g, i, j, k, to(size(axes)), x

      from = [(axes(i)%wanted(1), i=1, size(axes))]
      to = [(axes(i)%wanted(2), i=1, size(axes))]
      points = [(((((point_type( &
                     block_parameters_type(epsilon=value_at(axes(of_epsilon), i), &
                                           tau=value_at(axes(of_tau), j), &
                                           xi=value_at(axes(of_xi), x), &
                                           gamma=value_at(axes(of_gamma), g)), &
                     histories(k)), &
                     i=from(of_epsilon), to(of_epsilon)), j=from(of_tau), to(of_tau)), &
                  x=from(of_xi), to(of_xi)), g=from(of_gamma), to(of_gamma)), &
                 k=1, size(histories))]
   end function grid_of

   !> How many values of an axis are wanted.
   elemental integer function wanted(axis) result(values)
      !> The axis
      type(axis_type), intent(in) :: axis

      values = axis%wanted(2) - axis%wanted(1) + 1
   end function wanted

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

   !> Refuse values out of range, and a part of the axis that is not in it.
   pure subroutine check_axis(error, path, name, axis)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> Name of the parameter
      character(len=*), intent(in) :: name
      !> The axis
      type(axis_type), intent(in) :: axis
      integer :: i

      do i = 1, 2
         call check_quantity(error, path, name, axis%window(i), name//"_window")
      end do
      call check_count(error, path, name//"_count", axis%places, at_least=1, at_most=most_places)
      if (allocated(error)) return
      if (1 <= axis%wanted(1) .and. axis%wanted(1) <= axis%wanted(2) &
          .and. axis%wanted(2) <= axis%places) return
      call raise(error, path//": "//name//"_part = "//text(axis%wanted(1))//", " &
                 //text(axis%wanted(2))//"; expected first and last, 1 <= first <= last <= " &
                 //text(axis%places))
   end subroutine check_axis

   !> Refuse an unknown direction, and a sweep along two parameters or from two histories.
   pure subroutine check_sweep(error, path, sweep, axes, histories)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The direction
      character(len=*), intent(in) :: sweep
      !> The axes
      type(axis_type), intent(in) :: axes(:)
      !> Number of histories
      integer, intent(in) :: histories

      if (allocated(error)) return
      if (all(sweep /= directions)) then
         call raise(error, path//": sweep = '"//trim(sweep) &
                    //"'; expected one of 'none' 'up' 'down'")
      else if (sweep /= "none" .and. count(wanted(axes) > 1) > 1) then
         call raise(error, path//": sweep = '"//trim(sweep)//"' along " &
                    //text(count(wanted(axes) > 1))//" parameters; expected at most one")
      else if (sweep /= "none" .and. histories > 1) then
         call raise(error, path//": sweep = '"//trim(sweep)//"' from "//text(histories) &
                    //" histories; expected one")
      end if
   end subroutine check_sweep

   !> Refuse refinements of what is no plane of epsilon and tau from one history.
   pure subroutine check_refinements(error, path, settings, axes, histories)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> Refinements and sweep
      type(points_settings_type), intent(in) :: settings
      !> The axes
      type(axis_type), intent(in) :: axes(:)
      !> Number of histories
      integer, intent(in) :: histories
      character(len=:), allocatable :: place

      call check_count(error, path, "refinements", settings%refinements, at_least=0, &
                       at_most=most_refinements)
      if (allocated(error) .or. settings%refinements == 0) return
      if (settings%sweep /= "none") then
         place = "in a sweep"
      else if (histories > 1) then
         place = "from "//text(histories)//" histories"
      else if (any(axes([of_epsilon, of_tau])%places == 1)) then
         place = "along one line"
      else if (any(wanted(axes([of_xi, of_gamma])) > 1)) then
         place = "along xi or gamma"
      else
         return
      end if
      call raise(error, path//": refinements = "//text(settings%refinements)//" "//place &
                 //"; expected 0, or a plane of epsilon and tau from one history")
   end subroutine check_refinements

   !> Read the group &points.
   subroutine read_group(path, settings, axes, theta, u, v, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> Name, sweep, refinements and what is kept
      type(points_settings_type), intent(out) :: settings
      !> Values of the parameters, in the order of `names`
      type(axis_type), intent(out) :: axes(:)
      !> Histories, NaN beyond the last
      real(wp), intent(out) :: theta(:), u(:), v(:)
      !> They cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=len(settings%name)) :: name, sweep
      real(wp), dimension(2) :: epsilon_window, gamma_window, tau_window, xi_window
      integer, dimension(2) :: epsilon_part, gamma_part, tau_part, xi_part
      integer :: epsilon_count, gamma_count, kept, refinements, status, tau_count, unit, xi_count
      character(len=256) :: reason
      namelist /points/ name, epsilon_window, epsilon_count, epsilon_part, tau_window, tau_count, &
         tau_part, xi_window, xi_count, xi_part, gamma_window, gamma_count, gamma_part, theta, u, &
         v, sweep, refinements, kept

      name = ""
      sweep = ""
      theta = not_given()
      u = theta
      v = theta
      epsilon_window = not_given()
      tau_window = epsilon_window
      xi_window = epsilon_window
      gamma_window = epsilon_window
      epsilon_count = 0
      tau_count = 0
      xi_count = 0
      gamma_count = 0
      epsilon_part = 0
      tau_part = 0
      xi_part = 0
      gamma_part = 0
      refinements = -1
      kept = -1
      call open_namelist(path, "points", unit, error)
      if (allocated(error)) return
      read (unit, nml=points, iostat=status, iomsg=reason)
      call close_namelist(path, "points", unit, status, reason, error)
      settings%name = name
      settings%sweep = sweep
      settings%refinements = refinements
      settings%kept = kept
      axes = [axis_type(epsilon_window, epsilon_count, epsilon_part), &
              axis_type(tau_window, tau_count, tau_part), &
              axis_type(xi_window, xi_count, xi_part), &
              axis_type(gamma_window, gamma_count, gamma_part)]
   end subroutine read_group
end module points_input
