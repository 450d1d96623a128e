!> What the program `linear_stability` reads and writes: a state; its roots and stability changes.
module linear_stability_files
   use block_attributes, only: put_parameters
   use block_parameters, only: block_parameters_type, missing_parameters
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use namelist_input, only: namelist_file_type
   use netcdf_output, only: output_file_type
   use stability_changes, only: stability_change_type
   use value_checks, only: missing
   implicit none (type, external)
   private
   public :: linear_stability_settings_type, read_linear_stability, write_linear_stability

   !> State and bounds; all nondimensional.
   type :: linear_stability_settings_type
      !> Parameters of the block
      type(block_parameters_type) :: parameters = missing_parameters
      !> Roots with a real part above this are kept
      real(wp) :: root_bound = missing
      !> Longest delay and largest epsilon at which a change of stability is looked for
      real(wp) :: tau_most = missing, epsilon_most = missing
   end type linear_stability_settings_type

contains

   !> Read and check state and bounds.
   subroutine read_linear_stability(path, linear_stability, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The settings
      type(linear_stability_settings_type), intent(out) :: linear_stability
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      namelist /settings/ linear_stability

      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call linear_stability%parameters%check(path, error)
   end subroutine read_linear_stability

   !> Write roots and changes of stability.
   subroutine write_linear_stability(path, settings, roots, pairs, with_tau, with_epsilon, &
                                     unknown, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> What was asked for
      type(linear_stability_settings_type), intent(in) :: settings
      !> Roots, the rightmost first
      complex(wp), intent(in) :: roots(:)
      !> Number of unstable pairs, and the same without delay
      integer, intent(in) :: pairs(2)
      !> Changes as the delay grows
      type(stability_change_type), intent(in) :: with_tau(:)
      !> Changes as epsilon grows
      type(stability_change_type), intent(in) :: with_epsilon(:)
      !> Why changes are not known, if they are not
      type(error_type), allocatable, intent(in) :: unknown
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: rows

      call file%create(path, "Linear stability of steady sliding")
      call put_parameters(file, settings%parameters)
      call file%attribute("root_bound", settings%root_bound)
      call file%attribute("tau_most", settings%tau_most)
      call file%attribute("epsilon_most", settings%epsilon_most)
      call file%attribute("unstable_pairs", int(pairs(1), int64))
      call file%attribute("unstable_pairs_without_delay", int(pairs(2), int64))
      if (allocated(unknown)) call file%attribute("changes", "not computed: "//unknown%message)
      rows = file%dimension("root", size(roots))
      call file%column(rows, "root_real", real(roots), "real part of a characteristic root")
      call file%column(rows, "root_imag", aimag(roots), "its imaginary part")
      call put_changes(file, "tau", with_tau%parameters%tau, with_tau)
      call put_changes(file, "epsilon", with_epsilon%parameters%epsilon, with_epsilon)
      call file%finish(error)
   end subroutine write_linear_stability

   !> Changes of stability with one parameter.
   subroutine put_changes(file, parameter_name, values, changes)
      type(output_file_type), intent(inout) :: file
      character(len=*), intent(in) :: parameter_name
      real(wp), intent(in) :: values(:)
      type(stability_change_type), intent(in) :: changes(:)
      integer :: rows

      rows = file%dimension("change_with_"//parameter_name, size(changes))
      call file%column(rows, parameter_name//"_of_change", values, &
                       parameter_name//" at which a pair crosses the axis")
      call file%column(rows, parameter_name//"_change_omega", changes%omega, "its frequency")
      call file%column(rows, parameter_name//"_change_pairs_before", changes%pairs_before, &
                       "unstable pairs below")
      call file%column(rows, parameter_name//"_change_pairs_after", changes%pairs_after, &
                       "unstable pairs above")
   end subroutine put_changes
end module linear_stability_files
