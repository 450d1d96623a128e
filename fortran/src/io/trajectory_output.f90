!> Trajectory files: samples go to disk in blocks while the integration runs, only the variables
!> that the scene lists. For gamma > 1 they also follow the steps of the solver, so that slip events
!> shorter than the sample interval are resolved.
module trajectory_output
   use block_attributes, only: put_scene
   use dde, only: integration_result, sampler_type
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use netcdf_output, only: output_file_type
   use program_arguments, only: stop_on
   use progress, only: progress_type
   use scene_input, only: scene_type
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u
   implicit none (type, external)
   private
   public :: trajectory_writer_type

   !> Samples held before they are written.
   integer, parameter :: block_length = 8192

   !> Longest time between samples as a share of the step, for gamma > 1. The largest sample of a
   !> slip event is within 0.2 % of its maximum, measured for gamma from 100 to 1e10.
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
      !> Ids of time and of the variables, in the order of `wanted`
      integer, allocatable :: ids(:)
      !> Samples not written yet: time and variables, shape (block_length, 1 + variables)
      real(wp), allocatable :: block(:, :)
      !> Number of samples in the file, and in the block
      integer :: written = 0, held = 0
      !> Number of even times reached, and of all
      integer :: reached = 0, times = 0
      !> The next even time
      real(wp) :: even = 0.0_wp
   contains
      procedure :: take, finish
      procedure, private :: flush => flush_block
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
      integer :: dimension, i, variables
      logical :: refined

      writer%scene = scene
      variables = count(scene%variables /= "")
      ! the quotient may be one rounding below a whole number
      writer%times = floor(scene%t_end/scene%sample_interval*(1.0_wp + epsilon(1.0_wp))) + 1
      refined = scene%parameters%gamma > 1.0_wp
      if (refined) writer%share_of_step = largest_share
      allocate (writer%wanted(variables), writer%ids(0:variables))
      allocate (writer%block(block_length, 0:variables))
      call writer%file%create(path, "Trajectory of the spring block with delayed friction")
      ! length 0 is NetCDF's unlimited dimension
      dimension = writer%file%dimension("t", merge(0, writer%times, refined))
      writer%ids(0) = writer%file%real_variable("t", dimension, "time")
      do i = 1, variables
         select case (scene%variables(i))
         case ("theta")
            writer%wanted(i) = index_of_theta
            writer%ids(i) = writer%file%real_variable("theta", dimension, "friction state")
         case ("u")
            writer%wanted(i) = index_of_u
            writer%ids(i) = writer%file%real_variable("u", dimension, "displacement")
         case default
            writer%wanted(i) = index_of_ln_v
            writer%ids(i) = writer%file%real_variable("v", dimension, "velocity")
         end select
      end do
      writer%next = 0.0_wp
      writer%progress = progress_type("trajectory of "//trim(scene%name))
   end function new_writer

   !> Take one sample; the next one is at the next even time, unless the solver brings it forward.
   subroutine take(self, y)
      class(trajectory_writer_type), intent(inout) :: self
      !> theta, u, ln v as wanted
      real(wp), intent(in) :: y(:)

      if (self%held == block_length) call self%flush()
      if (allocated(self%file%error)) then
         ! a sampler cannot end the integration
         call stop_on(self%file%error)
      end if
      self%held = self%held + 1
      self%block(self%held, 0) = self%next
      self%block(self%held, 1:) = merge(exp(y), y, self%wanted == index_of_ln_v)
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

   !> Write the block.
   subroutine flush_block(self)
      class(trajectory_writer_type), intent(inout) :: self
      integer :: i

      do i = 0, size(self%wanted)
         call self%file%put(self%ids(i), self%block(:self%held, i), first=[self%written + 1])
      end do
      self%written = self%written + self%held
      self%held = 0
   end subroutine flush_block

   !> Write what is left, the scene and what the integration did, and complete the file.
   subroutine finish(self, outcome, error)
      class(trajectory_writer_type), intent(inout) :: self
      type(integration_result), intent(in) :: outcome
      type(error_type), allocatable, intent(out) :: error

      call self%flush()
      associate (file => self%file, scene => self%scene)
         call put_scene(file, scene)
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
         call file%finish(error)
      end associate
   end subroutine finish
end module trajectory_output
