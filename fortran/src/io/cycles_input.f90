!> The line on which cycles are followed, from a namelist.
module cycles_input
   use block_cycles, only: cycle_settings_type
   use block_parameters, only: block_parameters_type, missing_parameters, parameter_names, &
                               parameters_of, vector_of
   use cycle_lines, only: cycle_line_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use namelist_input, only: elements, namelist_file_type, word_length
   use value_checks, only: absent, check_count, missing, missing_count
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
      ! the value of the parameter along the line is not used
      vector = vector_of(cycles%parameters)
      where (parameter_names == cycles%along) vector = cycles%window(1)
      cycles%parameters = parameters_of(vector)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call cycles%parameters%check(path, error)
      call check_count(error, path, "degree", cycles%degree, at_least=3)
      along = findloc(parameter_names == cycles%along, .true., dim=1)
      line_settings = cycle_settings_type(line=cycle_line_type(along, cycles%parameters, &
                                                               cycles%window), &
                                     starts=elements(cycles%starts), &
                                     t_transient=cycles%t_transient, degree=cycles%degree, &
                                     intervals=cycles%intervals, &
                                     longest_period=cycles%longest_period, &
                                     most_orbits=cycles%most_orbits)
      allocate (line_settings%start_v(size(line_settings%starts)), source=cycles%v)
      if (any([cycles%epsilon_window, cycles%tau_window] < absent)) then
         line_settings%curve_window = reshape([cycles%epsilon_window, cycles%tau_window], [2, 2])
      end if
   end subroutine read_cycles
end module cycles_input
