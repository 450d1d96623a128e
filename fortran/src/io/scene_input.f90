!> A scene: one parameter set of the delayed block, from the section `scene` of a namelist.
module scene_input
   use block_parameters, only: block_history_type, block_parameters_type, missing_history, &
                               missing_parameters
   use dde, only: integration_options, methods
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use namelist_input, only: element_length, namelist_file_type, word_length
   use value_checks, only: check_choice, check_number, missing
   implicit none (type, external)
   private
   public :: check_scene, read_scene, scene_type

   !> Variables that a scene can store.
   character(len=5), parameter :: variable_names(3) = ["theta", "u    ", "v    "]
   !> Longest name of a scene.
   integer, parameter :: longest_name = 64

   !> Most samples: indices in NetCDF's Fortran interface have 32 bits.
   real(wp), parameter :: most_samples = 2.0e9_wp

   !> One parameter set; all nondimensional.
   type :: scene_type
      !> Name of the scene
      character(len=word_length) :: name = ""
      !> Parameters
      type(block_parameters_type) :: parameters = missing_parameters
      !> Values for t <= 0
      type(block_history_type) :: history = missing_history
      !> Last time
      real(wp) :: t_end = missing
      !> Time up to which spectra and portraits leave the trajectory out
      real(wp) :: t_transient = missing
      !> Time between stored samples
      real(wp) :: sample_interval = missing
      !> Relative and absolute tolerance of one step
      real(wp) :: tolerance = missing
      !> One of the solver's methods
      character(len=word_length) :: method = ""
      !> Variables to store, blank where there are fewer
      character(len=element_length) :: variables(3) = ""
   contains
      !> Method and tolerances for the solver
      procedure :: options => options_of_scene
   end type scene_type

contains

   !> Read and check a scene.
   subroutine read_scene(path, scene, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The scene
      type(scene_type), intent(out) :: scene
      !> Error if the file cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      namelist /settings/ scene

      call file%open(path, error)
      if (allocated(error)) return
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call check_scene(path, scene, error)
   end subroutine read_scene

   !> Refuse a scene that cannot be computed or stored; keep an earlier error.
   pure subroutine check_scene(path, scene, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The scene
      type(scene_type), intent(in) :: scene
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: place
      integer :: i

      if (allocated(error)) return
      place = path//": scene '"//trim(scene%name)//"'"
      if (len_trim(scene%name) == 0 .or. len_trim(scene%name) > longest_name) then
         call raise(error, place//": name of "//text(len_trim(scene%name)) &
                    //" letters; expected 1 to "//text(longest_name))
      end if
      call scene%parameters%check(place, error)
      call scene%history%check(place, error)
      call check_number(error, place, "t_end", scene%t_end, above=0.0_wp)
      call check_number(error, place, "t_transient", scene%t_transient, at_least=0.0_wp, &
                        below=scene%t_end)
      call check_number(error, place, "sample_interval", scene%sample_interval, above=0.0_wp, &
                        at_most=scene%t_end)
      if (allocated(error)) return
      call check_number(error, place, "number of samples t_end/sample_interval", &
                        scene%t_end/scene%sample_interval, at_most=most_samples)
      call check_choice(error, place, "method", scene%method, methods)
      do i = 1, max(1, findloc(scene%variables /= "", .true., dim=1, back=.true.))
         call check_choice(error, place, "variables", scene%variables(i), variable_names)
         if (allocated(error)) return
         if (any(scene%variables(:i - 1) == scene%variables(i))) then
            call raise(error, place//": variables = '"//trim(scene%variables(i)) &
                       //"' twice; expected each once")
         end if
      end do
   end subroutine check_scene

   !> Method and tolerances for the solver.
   pure type(integration_options) function options_of_scene(self) result(options)
      class(scene_type), intent(in) :: self

      options = integration_options(method=trim(self%method), relative=self%tolerance, &
                                    absolute=self%tolerance)
   end function options_of_scene
end module scene_input
