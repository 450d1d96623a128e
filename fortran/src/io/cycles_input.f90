!> The line on which cycles are followed, from a namelist.
module cycles_input
   use block_cycles, only: cycle_settings_type
   use block_parameters, only: block_parameters_type, check_quantity, missing_parameters, &
                               parameter_names, parameters_of, vector_of
   use cycle_lines, only: along_epsilon, cycle_line_type
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use namelist_input, only: elements, namelist_file_type, word_length
   use value_checks, only: absent, check_choice, check_count, check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: read_cycles

   !> The section `cycles`; all nondimensional.
   type :: cycles_section_type
      !> Parameter along the line
      character(len=word_length) :: along = ""
      !> Its first and last value
      real(wp) :: window(2) = missing
      !> The other parameters; that along the line may be left out
      type(block_parameters_type) :: parameters = missing_parameters
      !> Parameter values from which trajectories are followed to a cycle
      real(wp) :: starts(100) = absent
      !> Velocity before these trajectories, and their time
      real(wp) :: v = missing, t_transient = missing
      !> Degree and intervals of the first mesh
      integer :: degree = missing_count, intervals = missing_count
      !> Longest period of a branch
      real(wp) :: longest_period = missing
      !> Most orbits of a branch
      integer :: most_orbits = missing_count
      !> Window in which curves of special points are followed; none are if it is left out
      real(wp) :: epsilon_window(2) = absent, tau_window(2) = absent
   end type cycles_section_type

contains

   !> Read and check what is computed.
   subroutine read_cycles(path, line_settings, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> What is computed
      type(cycle_settings_type), intent(out) :: line_settings
      !> Error if the file cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(cycles_section_type) :: cycles
      type(namelist_file_type) :: file
      integer :: along
      real(wp) :: vector(size(parameter_names))
      namelist /settings/ cycles

      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      along = findloc(parameter_names == cycles%along, .true., dim=1)
      if (along > 0) then
         ! the value of the parameter along the line is not used
         vector = vector_of(cycles%parameters)
         vector(along) = cycles%window(1)
         cycles%parameters = parameters_of(vector)
      end if
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call check_choice(error, path, "along", cycles%along, parameter_names)
      if (allocated(error)) return
      call check_cycles(path, cycles, along, error)
      line_settings = cycle_settings_type(line=cycle_line_type(along, cycles%parameters, &
                                                               cycles%window), &
                                     starts=elements(cycles%starts), &
                                     t_transient=cycles%t_transient, degree=cycles%degree, &
                                     intervals=cycles%intervals, &
                                     longest_period=cycles%longest_period, &
                                     most_orbits=cycles%most_orbits)
      allocate (line_settings%start_v(size(line_settings%starts)), source=cycles%v)
      if (has_curves(cycles)) then
         line_settings%curve_window = reshape([cycles%epsilon_window, cycles%tau_window], [2, 2])
      end if
   end subroutine read_cycles

   !> Whether curves of special points are followed.
   pure logical function has_curves(cycles) result(value)
      type(cycles_section_type), intent(in) :: cycles

      value = any([cycles%epsilon_window, cycles%tau_window] < absent)
   end function has_curves

   !> Refuse a line, a mesh or windows with which nothing can be computed; keep an earlier error.
   pure subroutine check_cycles(path, cycles, along, error)
      character(len=*), intent(in) :: path
      type(cycles_section_type), intent(in) :: cycles
      integer, intent(in) :: along
      type(error_type), allocatable, intent(inout) :: error
      integer :: i

      call cycles%parameters%check(path, error)
      associate (window => cycles%window, starts => elements(cycles%starts))
         call check_number(error, path, "window(2)", window(2), above=window(1))
         do i = 1, size(starts)
            call check_number(error, path, "starts", starts(i), at_least=window(1), &
                              at_most=window(2))
         end do
      end associate
      call check_quantity(error, path, "v", cycles%v)
      call check_number(error, path, "t_transient", cycles%t_transient, above=0.0_wp)
      call check_count(error, path, "degree", cycles%degree, 3, at_most=9)
      call check_count(error, path, "intervals", cycles%intervals, 10)
      call check_number(error, path, "longest_period", cycles%longest_period, above=0.0_wp)
      call check_count(error, path, "most_orbits", cycles%most_orbits, 2)
      if (allocated(error) .or. .not. has_curves(cycles)) return
      if (along > along_epsilon) then
         call raise(error, path//": epsilon_window and tau_window; expected only where along " &
                    //"is tau or epsilon")
      end if
      associate (epsilon => cycles%epsilon_window, tau => cycles%tau_window)
         call check_quantity(error, path, "epsilon", epsilon(1), "epsilon_window(1)")
         call check_number(error, path, "epsilon_window(2)", epsilon(2), above=epsilon(1))
         call check_quantity(error, path, "tau", tau(1), "tau_window(1)")
         call check_number(error, path, "tau_window(2)", tau(2), above=tau(1))
      end associate
   end subroutine check_cycles
end module cycles_input
