! SPDX-License-Identifier: BSD-3-Clause
!> Trajectory files: samples go to disk in blocks while the integration runs, only the variables
!> that the scene lists. Where the fast state of a block alone relaxes within the sample interval,
!> they also follow the steps of the solver, so that events shorter than the interval are resolved.
!> Those of a chain are over time and block.
module trajectory_output
   use dde, only: integration_result, sampler_type
   use dde_errors, only: error_type, text
   use dde_kinds, only: int64, wp
   use model_chain, only: blocks_in_order
   use model_description, only: description_type
   use model_history, only: display_names, shown_name
   use output_file, only: output_file_type
   use program_arguments, only: stop_on
   use progress, only: progress_type
   use scene_input, only: scene_type
   use value_checks, only: check_choice
   implicit none (type, external)
   private
   public :: trajectory_writer_type

   !> Samples held before they are written: of one block, and at least.
   integer, parameter :: most_held = 8192, least_held = 32

   !> Longest time between samples as a share of the step, where they follow the steps. The largest
   !> sample of a slip event is within 0.2 % of its maximum, measured for gamma from 100 to 1e10.
   real(wp), parameter :: largest_share = 0.25_wp

   !> Sampler that writes a trajectory file.
   type, extends(sampler_type) :: trajectory_writer_type
      private
      !> The file
      type(output_file_type), public :: file
      !> Report of the samples received
      type(progress_type) :: progress
      !> The scene
      type(scene_type) :: scene
      !> Which variables are exponentials of their components
      logical, allocatable :: exponential(:)
      !> Times of samples not written yet, and their values, shape (blocks, variables, samples)
      real(wp), allocatable :: time(:), values(:, :, :)
      !> Number of samples in the file, and of those not written yet
      integer :: written = 0, held = 0
      !> Number of even times reached, and of all
      integer :: reached = 0, times = 0
      !> The next even time
      real(wp) :: even = 0.0_wp
   contains
      procedure :: take, finish
      procedure, private :: flush => flush_samples
   end type trajectory_writer_type

   interface trajectory_writer_type
      module procedure :: new_writer
   end interface trajectory_writer_type

contains

   !> Begin the file of a scene.
   function new_writer(path, scene) result(writer)
      character(len=*), intent(in) :: path
      type(scene_type), intent(in) :: scene
      type(trajectory_writer_type) :: writer
      type(description_type) :: about
      character(len=:), allocatable :: meaning
      integer, allocatable :: components(:), places(:)
      integer :: block, dimension, i, length, variables
      logical :: refined

      writer%scene = scene
      about = scene%problem%describe()
      if (all(scene%variables == "")) then
         writer%scene%variables(:size(about%states)) = display_names(about)
      end if
      variables = count(writer%scene%variables /= "")
      call find_components(path, about, writer%scene%variables(:variables), components, &
                           writer%exponential, writer%file%error)
      if (allocated(writer%file%error)) return
      associate (blocks => scene%model%blocks, model => scene%problem)
         ! the quotient may be one rounding below a whole number
         writer%times = floor(scene%t_end/scene%sample_interval*(1.0_wp + epsilon(1.0_wp))) + 1
         refined = blocks == 1 .and. model%sizes%observed%integral > 0
         if (refined) refined = model%relaxation_rate(0.0_wp, model%steady_state()) &
                                *scene%sample_interval > 1.0_wp
         if (refined) writer%share_of_step = largest_share
         length = max(least_held, most_held/blocks)
         allocate (places(blocks))
         allocate (writer%time(length), writer%values(blocks, variables, length))
         call writer%file%create(path, "Trajectory of a model")
         ! length 0 is NetCDF's unlimited dimension
         dimension = writer%file%dimension("t", merge(0, writer%times, refined))
         call writer%file%column(dimension, "t", [real(wp) ::], "time")
         do i = 1, variables
            meaning = trim(about%meanings(components(i)))
            if (writer%exponential(i)) meaning = "exp("//trim(about%states(components(i)))//")"
            if (blocks > 1) then
               call writer%file%table([writer%file%dimension("block", blocks), dimension], &
                                      trim(writer%scene%variables(i)), writer%values(:, i, :0), &
                                      meaning)
            else
               call writer%file%column(dimension, trim(writer%scene%variables(i)), &
                                       writer%values(1, i, :0), meaning)
            end if
         end do
         places(blocks_in_order(blocks, trim(model%ends))) = [(block, block=1, blocks)]
         writer%wanted = [((model%states()*(places(block) - 1) + components(i), &
                            block=1, blocks), i=1, variables)]
      end associate
      writer%next = 0.0_wp
      writer%progress = progress_type("trajectory of "//trim(scene%name)//" (about "//text( &
                                      ceiling(8.0e-6_wp*writer%times*(1 + size(writer%wanted)))) &
                                      //" MB before compression)")
   end function new_writer

   !> The components of variables by their names.
   subroutine find_components(path, about, variables, components, exponential, error)
      character(len=*), intent(in) :: path
      !> What the definition says
      type(description_type), intent(in) :: about
      character(len=*), intent(in) :: variables(:)
      integer, allocatable, intent(out) :: components(:)
      !> Whether a variable is the exponential of its component
      logical, allocatable, intent(out) :: exponential(:)
      !> Error if there is no variable of a name
      type(error_type), allocatable, intent(inout) :: error
      integer :: i, number

      allocate (components(size(variables)), exponential(size(variables)))
      do i = 1, size(variables)
         call check_choice(error, path, "variable", variables(i), &
                           [about%states, about%auxiliaries%name])
         if (allocated(error)) return
         components(i) = findloc(about%states, variables(i), dim=1)
         exponential(i) = components(i) == 0
         number = findloc(about%auxiliaries%name, variables(i), dim=1)
         if (exponential(i)) components(i) = about%auxiliaries(number)%state
      end do
   end subroutine find_components

   !> Take one sample; the next one is at the next even time, unless the solver brings it forward.
   subroutine take(self, y)
      class(trajectory_writer_type), intent(inout) :: self
      !> Components as wanted
      real(wp), intent(in) :: y(:)
      integer :: i

      if (self%held == size(self%time)) call self%flush()
      if (allocated(self%file%error)) then
         ! a sampler cannot end the integration
         call stop_on(self%file%error)
      end if
      self%held = self%held + 1
      self%time(self%held) = self%next
      associate (now => self%values(:, :, self%held))
         now = reshape(y, shape(now))
         do i = 1, size(now, 2)
            if (self%exponential(i)) now(:, i) = exp(now(:, i))
         end do
      end associate
      if (self%next >= self%even) then
         self%reached = self%reached + 1
         self%even = huge(1.0_wp)
         if (self%reached < self%times) then
            self%even = min(self%reached*self%scene%sample_interval, self%scene%t_end)
         end if
         call self%progress%advance(self%reached, self%times)
      end if
      self%next = self%even
   end subroutine take

   !> Write the samples that are held.
   subroutine flush_samples(self)
      class(trajectory_writer_type), intent(inout) :: self
      integer :: i

      self%file%variables(1)%reals = self%time(:self%held)
      do i = 2, size(self%file%variables)
         self%file%variables(i)%reals = [self%values(:, i - 1, :self%held)]
      end do
      call self%file%write_values(first=self%written + 1)
      self%written = self%written + self%held
      self%held = 0
   end subroutine flush_samples

   !> Write what is left, the scene and what the integration did, and complete the file.
   subroutine finish(self, outcome, error)
      class(trajectory_writer_type), intent(inout) :: self
      type(integration_result), intent(in) :: outcome
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: switches
      integer :: i

      call self%flush()
      associate (file => self%file, scene => self%scene)
         call scene%put(file)
         associate (observed => scene%problem%sizes%observed)
            if (observed%integral > 0) then
               call file%attribute("integral", shown_name(scene%problem, observed%integral))
               call file%attribute("integral_slope", merge(1.0_wp, 0.0_wp, observed%with_time))
            end if
         end associate
         call file%attribute("t_end", scene%t_end)
         call file%attribute("t_transient", scene%t_transient)
         call file%attribute("sample_interval", scene%sample_interval)
         call file%attribute("tolerance", scene%tolerance)
         call file%attribute("method", trim(scene%method))
         call file%attribute("steps_accepted", outcome%accepted)
         call file%attribute("steps_rejected", outcome%rejected)
         call file%attribute("steps_implicit", outcome%implicit_steps)
         call file%attribute("evaluations", outcome%evaluations)
         call file%attribute("breaking_points", int(outcome%breaking_points, int64))
         switches = ""
         do i = 1, scene%problem%switches
            switches = switches//"; "//scene%problem%name_of("switching", i)//": " &
                       //text(outcome%switched(i))
         end do
         if (switches /= "") call file%attribute("switches", switches(3:))
         call file%finish(error)
      end associate
   end subroutine finish
end module trajectory_output
