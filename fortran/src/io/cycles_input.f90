!> The line on which cycles are followed, from the namelist group &cycles.
module cycles_input
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use block_cycles, only: cycle_settings_type
   use block_family, only: parameters_of, vector_of
   use block_parameters, only: check_quantity
   use cycle_lines, only: along_epsilon
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use namelist_input, only: close_namelist, not_given, open_namelist, word_length
   use value_checks, only: check_choice, check_count, check_number
   implicit none (type, external)
   private
   public :: names_along, read_cycles

   !> Parameters along which a line may run, in the order of their numbers.
   character(len=7), parameter :: names_along(4) = ["tau    ", "epsilon", "xi     ", "gamma  "]
   !> Most trajectories
   integer, parameter :: most_starts = 100

contains

   !> Read and check what is asked.
   subroutine read_cycles(path, settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> What is asked
      type(cycle_settings_type), intent(out) :: settings
      !> Error if the file cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: along
      real(wp) :: v, vector(4)
      integer :: i

      call read_group(path, settings, along, v, error)
      call check_choice(error, path, "along", along, names_along)
      if (allocated(error)) return
      associate (line => settings%line, p => settings%line%parameters)
         line%along = findloc(names_along == along, .true., dim=1)
         ! the value of the parameter along the line is not used
         vector = vector_of(p)
         vector(line%along) = line%window(1)
         p = parameters_of(vector)
         call p%check(path, error)
         call check_quantity(error, path, along, line%window(1), "window(1)")
         call check_number(error, path, "window(2)", line%window(2), above=line%window(1))
         do i = 1, size(settings%starts)
            call check_number(error, path, "starts", settings%starts(i), at_least=line%window(1), &
                              at_most=line%window(2))
         end do
      end associate
      call check_quantity(error, path, "v", v)
      call check_number(error, path, "t_transient", settings%t_transient, above=0.0_wp)
      call check_count(error, path, "degree", settings%degree, 3, at_most=9)
      call check_count(error, path, "intervals", settings%intervals, 10, at_most=1000)
      call check_number(error, path, "longest_period", settings%longest_period, above=0.0_wp)
      call check_count(error, path, "most_orbits", settings%most_orbits, 2, at_most=100000)
      if (allocated(settings%curve_window)) then
         if (settings%line%along > along_epsilon .and. .not. allocated(error)) then
            call raise(error, path//": epsilon_window and tau_window; expected only where along " &
                       //"is tau or epsilon")
         end if
         associate (window => settings%curve_window)
            call check_quantity(error, path, "epsilon", window(1, 1), "epsilon_window(1)")
            call check_number(error, path, "epsilon_window(2)", window(2, 1), above=window(1, 1))
            call check_quantity(error, path, "tau", window(1, 2), "tau_window(1)")
            call check_number(error, path, "tau_window(2)", window(2, 2), above=window(1, 2))
         end associate
      end if
      allocate (settings%start_v(size(settings%starts)), source=v)
   end subroutine read_cycles

   !> Read the group &cycles.
   subroutine read_group(path, settings, along_read, v_read, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> What is asked
      type(cycle_settings_type), intent(out) :: settings
      !> Name of the parameter along the line
      character(len=:), allocatable, intent(out) :: along_read
      !> Velocity before the trajectories
      real(wp), intent(out) :: v_read
      !> Error if the file cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length) :: along
      character(len=256) :: reason
      real(wp) :: tau, epsilon, xi, gamma, v, window(2), starts(most_starts), t_transient
      real(wp) :: longest_period, epsilon_window(2), tau_window(2)
      integer :: degree, intervals, most_orbits, status, unit
      namelist /cycles/ along, window, tau, epsilon, xi, gamma, starts, v, t_transient, degree, &
         intervals, longest_period, most_orbits, epsilon_window, tau_window

      along = ""
      tau = not_given()
      epsilon = tau
      xi = tau
      gamma = tau
      v = tau
      window = tau
      starts = tau
      t_transient = tau
      longest_period = tau
      epsilon_window = tau
      tau_window = tau
      degree = 0
      intervals = 0
      most_orbits = 0
      call open_namelist(path, "cycles", unit, error)
      if (.not. allocated(error)) then
         read (unit, nml=cycles, iostat=status, iomsg=reason)
         call close_namelist(path, "cycles", unit, status, reason, error)
      end if
      along_read = trim(along)
      v_read = v
      settings%line%window = window
      settings%line%parameters%tau = tau
      settings%line%parameters%epsilon = epsilon
      settings%line%parameters%xi = xi
      settings%line%parameters%gamma = gamma
      settings%starts = pack(starts, .not. ieee_is_nan(starts))
      settings%t_transient = t_transient
      settings%longest_period = longest_period
      settings%degree = degree
      settings%intervals = intervals
      settings%most_orbits = most_orbits
      if (.not. all(ieee_is_nan([epsilon_window, tau_window]))) then
         settings%curve_window = reshape([epsilon_window, tau_window], [2, 2])
      end if
   end subroutine read_group
end module cycles_input
