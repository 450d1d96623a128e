!> A scene: one parameter set of the delayed block, from the namelist group &scene.
module scene_input
   use block_parameters, only: block_history_type, block_parameters_type, check_quantity
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use namelist_input, only: close_namelist, not_given, open_namelist, word_length
   use solver_checks, only: check_method, check_tolerance
   use value_checks, only: check_choice, check_number
   implicit none (type, external)
   private
   public :: read_scene, scene_type, variable_names

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
      type(block_parameters_type) :: parameters
      !> Values for t <= 0
      type(block_history_type) :: history
      !> Last time
      real(wp) :: t_end
      !> Time up to which spectra and portraits leave the trajectory out
      real(wp) :: t_transient
      !> Time between stored samples
      real(wp) :: sample_interval
      !> Relative and absolute tolerance of one step
      real(wp) :: tolerance
      !> One of the solver's methods
      character(len=word_length) :: method = ""
      !> Variables to store, blank where there are fewer
      character(len=word_length) :: variables(3) = ""
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

      call read_group(path, scene, error)
      if (allocated(error)) return
      call check_scene(path//": scene '"//trim(scene%name)//"'", scene, error)
   end subroutine read_scene

   !> Read the group &scene, whose keys are those of the config.
   subroutine read_group(path, filled, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The scene
      type(scene_type), intent(out) :: filled
      !> Error if the file cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length) :: name, method, variables(3)
      type(block_history_type) :: history
      real(wp) :: tau, epsilon, xi, gamma, t_end, t_transient, sample_interval, tolerance
      character(len=256) :: reason
      integer :: status, unit
      namelist /scene/ name, tau, epsilon, xi, gamma, history, t_end, t_transient, &
         sample_interval, tolerance, method, variables

      name = ""
      method = ""
      variables = ""
      tau = not_given()
      epsilon = tau
      xi = tau
      gamma = tau
      history = block_history_type(tau, tau, tau)
      t_end = tau
      t_transient = tau
      sample_interval = tau
      tolerance = tau
      call open_namelist(path, "scene", unit, error)
      if (allocated(error)) return
      read (unit, nml=scene, iostat=status, iomsg=reason)
      call close_namelist(path, "scene", unit, status, reason, error)
      filled = scene_type(name=name, history=history, t_end=t_end, t_transient=t_transient, &
                          parameters=block_parameters_type(tau=tau, epsilon=epsilon, xi=xi, &
                                                           gamma=gamma), &
                          sample_interval=sample_interval, tolerance=tolerance, method=method, &
                          variables=variables)
   end subroutine read_group

   !> Refuse what the config schema refuses.
   pure subroutine check_scene(place, scene, error)
      !> File and scene, for messages
      character(len=*), intent(in) :: place
      !> The scene
      type(scene_type), intent(in) :: scene
      !> A value is out of range
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      if (len_trim(scene%name) == 0 .or. len_trim(scene%name) > longest_name) then
         call raise(error, place//": name of "//text(len_trim(scene%name)) &
                    //" letters; expected 1 to "//text(longest_name))
      end if
      call scene%parameters%check(place, error)
      call check_quantity(error, place, "theta", scene%history%theta, key="history%theta")
      call check_quantity(error, place, "u", scene%history%u, key="history%u")
      call check_quantity(error, place, "v", scene%history%v, key="history%v")
      call check_number(error, place, "t_end", scene%t_end, above=0.0_wp)
      call check_number(error, place, "t_transient", scene%t_transient, at_least=0.0_wp, &
                        below=scene%t_end)
      call check_number(error, place, "sample_interval", scene%sample_interval, above=0.0_wp, &
                        at_most=scene%t_end)
      call check_tolerance(error, place, "tolerance", scene%tolerance)
      if (.not. allocated(error)) then
         call check_number(error, place, "number of samples t_end/sample_interval", &
                           scene%t_end/scene%sample_interval, at_most=most_samples)
      end if
      call check_method(error, place, scene%method)
      call check_choice(error, place, "variables", scene%variables(1), variable_names)
      do i = 2, size(scene%variables)
         if (allocated(error) .or. scene%variables(i) == "") cycle
         call check_choice(error, place, "variables", scene%variables(i), variable_names)
         if (any(scene%variables(:i - 1) == scene%variables(i))) then
            call raise(error, place//": variables = '"//trim(scene%variables(i)) &
                       //"' twice; expected each once")
         end if
      end do
   end subroutine check_scene
end module scene_input
