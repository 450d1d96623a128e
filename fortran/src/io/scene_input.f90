!> A scene: one parameter set of the delayed block, from the section `scene` of a namelist.
module scene_input
   use block_parameters, only: block_history_type, block_parameters_type, missing_history, &
                               missing_parameters
   use dde, only: integration_options
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use namelist_input, only: element_length, elements, namelist_file_type, word_length
   use value_checks, only: absent, check_number, missing, most_samples
   implicit none (type, external)
   private
   public :: check_scene, read_histories, read_scene, scene_type

   !> One parameter set; all nondimensional.
   type :: scene_type
      !> Name of the scene
      character(len=word_length) :: name = ""
      !> Parameters
      type(block_parameters_type) :: parameters = missing_parameters
      !> Values for t <= 0; of a chain those of its first block
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
      !> Variables to store, of theta, u and v; blank where there are fewer
      character(len=element_length) :: variables(3) = ""
      !> Velocities above which a block slips, for slip events
      real(wp) :: thresholds(4) = [1.0_wp, absent, absent, absent]
   contains
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
      call check_number(error, path//": scene '"//trim(scene%name)//"'", "sample_interval", &
                        scene%sample_interval, &
                        at_least=scene%t_end/most_samples*scene%parameters%blocks)
      call check_number(error, path//": scene '"//trim(scene%name)//"'", "thresholds", &
                        minval(elements(scene%thresholds)), above=0.0_wp)
   end subroutine read_scene

   !> Read and check the values for t <= 0 of each block: of a chain they are lists in the group
   !> `blocks`.
   subroutine read_histories(path, scene, histories, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The scene, which was read without an error
      type(scene_type), intent(in) :: scene
      !> Values of each block
      type(block_history_type), allocatable, intent(out) :: histories(:)
      !> Error if the group cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable, dimension(:) :: theta, u, v
      character(len=256) :: reason
      integer :: i, status, unit
      namelist /blocks/ theta, u, v

      if (.not. scene%parameters%is_chain()) then
         histories = [scene%history]
         return
      end if
      allocate (theta(scene%parameters%blocks), source=missing)
      allocate (u, v, source=theta)
      open (newunit=unit, file=path, status="old", action="read", iostat=status, iomsg=reason)
      if (status == 0) read (unit, nml=blocks, iostat=status, iomsg=reason)
      close (unit)
      if (status /= 0) then
         call raise(error, path//": namelist group &blocks: "//trim(reason) &
                    //"; expected theta, u and v of "//text(scene%parameters%blocks)//" blocks")
         return
      end if
      histories = [(block_history_type(theta(i), u(i), v(i)), i=1, size(v))]
      do i = 1, size(histories)
         call histories(i)%check(path//": block "//text(i)//" of scene '"//trim(scene%name)//"'", &
                                 error)
         if (allocated(error)) return
      end do
   end subroutine read_histories

   !> Refuse parameters and a history without a meaning; keep an earlier error.
   subroutine check_scene(path, scene, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The scene
      type(scene_type), intent(inout) :: scene
      !> First error met
      type(error_type), allocatable, intent(inout) :: error

      call scene%parameters%check(path//": scene '"//trim(scene%name)//"'", error)
      if (scene%parameters%is_chain()) return
      call scene%history%check(path//": scene '"//trim(scene%name)//"'", error)
   end subroutine check_scene

   !> Method and tolerances for the solver.
   pure type(integration_options) function options_of_scene(self) result(options)
      class(scene_type), intent(in) :: self

      options = integration_options(method=trim(self%method), relative=self%tolerance, &
                                    absolute=self%tolerance)
   end function options_of_scene
end module scene_input
