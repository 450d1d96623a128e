!> Trajectory files: samples go to disk in blocks while the integration runs, only the variables
!> that the scene lists. For gamma > 1 samples follow the motion.
module trajectory_output
   use block_attributes, only: put_history, put_parameters
   use dde, only: event_watcher_type, instant, integration_result, sampler_type
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use netcdf_output, only: output_file_type
   use program_arguments, only: stop_on
   use progress, only: progress_type
   use scene_input, only: scene_type
   use spring_block, only: index_of_ln_v, index_of_theta, index_of_u
   implicit none (type, external)
   private
   public :: motion_watcher_type, trajectory_writer_type

   !> Samples held before they are written.
   integer, parameter :: block_length = 8192

   !> At these values of ln v samples begin to follow a rise, however fast it is.
   real(wp), parameter :: levels(*) = [0.0_wp, 2.0_wp, 4.0_wp, 6.0_wp, 8.0_wp, 10.0_wp, 12.0_wp, &
                                       14.0_wp, 16.0_wp, 18.0_wp, 20.0_wp, 22.0_wp, 24.0_wp, &
                                       26.0_wp, 28.0_wp, 30.0_wp]

   !> Sampler that writes a trajectory file.
   type, extends(sampler_type) :: trajectory_writer_type
      private
      !> The file
      type(output_file_type), public :: file
      !> Report of the samples received
      type(progress_type) :: progress
      !> The scene
      type(scene_type) :: scene
      !> Ids of time and of the variables, in the order of `wanted`, which ends with ln v
      integer, allocatable :: ids(:)
      !> Samples not written yet: time and variables, shape (block_length, 1 + variables)
      real(wp), allocatable :: block(:, :)
      !> Number of samples in the file, and in the block
      integer :: written = 0, held = 0
      !> Number of even times reached, and of all
      integer :: reached = 0, times = 0
      !> The next even time
      real(wp) :: even = 0.0_wp
      !> Whether there are samples between even times
      logical, public :: refined = .false.
      !> Times of events that are to be sampled
      real(wp), allocatable :: awaited(:)
   contains
      procedure :: take
      !> Complete the file with what the integration did
      procedure :: finish
      !> Give the file up
      procedure :: discard
      procedure, private :: flush => flush_block
   end type trajectory_writer_type

   !> Watcher that lets a writer sample maxima of v, and follow each rise to one.
   type, extends(event_watcher_type) :: motion_watcher_type
      !> The writer
      type(trajectory_writer_type), pointer :: writer => null()
   contains
      procedure :: values
      procedure :: take => await
   end type motion_watcher_type

   interface trajectory_writer_type
      module procedure :: new_writer
   end interface trajectory_writer_type

   interface motion_watcher_type
      module procedure :: new_watcher
   end interface motion_watcher_type

contains

   !> Begin the file of a scene.
   function new_writer(path, scene) result(writer)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The scene
      type(scene_type), intent(in) :: scene
      type(trajectory_writer_type) :: writer
      integer :: dimension, i, variables

      writer%scene = scene
      variables = count(scene%variables /= "")
      ! the quotient may be one rounding below a whole number
      writer%times = floor(scene%t_end/scene%sample_interval*(1.0_wp + epsilon(1.0_wp))) + 1
      writer%refined = scene%parameters%gamma > 1.0_wp
      allocate (writer%awaited(0))
      allocate (writer%wanted(variables + 1), source=index_of_ln_v)
      allocate (writer%ids(0:variables), writer%block(block_length, 0:variables))
      call writer%file%create(path, "Trajectory of the spring block with delayed friction")
      ! length 0 is NetCDF's unlimited dimension
      dimension = writer%file%dimension("t", merge(0, writer%times, writer%refined))
      writer%ids(0) = writer%file%real_variable("t", dimension, "time", "1")
      do i = 1, variables
         select case (scene%variables(i))
         case ("theta")
            writer%wanted(i) = index_of_theta
            writer%ids(i) = writer%file%real_variable("theta", dimension, "friction state", "1")
         case ("u")
            writer%wanted(i) = index_of_u
            writer%ids(i) = writer%file%real_variable("u", dimension, "displacement", "1")
         case default
            writer%wanted(i) = index_of_ln_v
            writer%ids(i) = writer%file%real_variable("v", dimension, "velocity", "1")
         end select
      end do
      writer%next = 0.0_wp
      writer%progress = progress_type("trajectory of "//trim(scene%name))
   end function new_writer

   !> Take one sample. Between even times samples follow the motion: friction changes over a slip of
   !> 1, inertia changes v over a time of 1/gamma, and the longer of both counts.
   subroutine take(self, y)
      !> The writer
      class(trajectory_writer_type), intent(inout) :: self
      !> theta, u, ln v as wanted, and ln v
      real(wp), intent(in) :: y(:)
      real(wp) :: time

      if (self%held == block_length) call self%flush()
      if (allocated(self%file%error)) then
         ! a sampler cannot end the integration
         call self%progress%finish()
         call stop_on(self%file%error)
      end if
      time = self%next
      self%held = self%held + 1
      associate (n => size(y) - 1, ln_v => y(size(y)), scene => self%scene)
         self%block(self%held, 0) = time
         self%block(self%held, 1:) = merge(exp(y(:n)), y(:n), self%wanted(:n) == index_of_ln_v)
         if (time >= self%even) then
            self%reached = self%reached + 1
            self%even = min(self%reached*scene%sample_interval, scene%t_end)
            call self%progress%advance(self%reached, self%times)
         end if
         self%next = huge(1.0_wp)
         if (self%reached == self%times) return
         self%next = self%even
         if (.not. self%refined) return
         ! the last term lets time go on however fast the block is
         self%next = min(self%next, time + max(spacing(time), scene%sample_interval &
                                               *max(exp(-ln_v), 1.0_wp/scene%parameters%gamma)))
         self%awaited = pack(self%awaited, self%awaited > time)
         if (size(self%awaited) > 0) self%next = min(self%next, self%awaited(1))
      end associate
   end subroutine take

   !> A watcher for a writer.
   function new_watcher(writer) result(watcher)
      !> The writer
      type(trajectory_writer_type), intent(inout), target :: writer
      type(motion_watcher_type) :: watcher
      integer :: i

      watcher%writer => writer
      watcher%direction = [-1, [(1, i=1, size(levels))]]
      watcher%terminal = [(.false., i=0, size(levels))]
   end function new_watcher

   !> The slope of ln v, zero at maxima, and ln v less each of the levels.
   pure subroutine values(self, t, y, slope, g)
      !> The watcher
      class(motion_watcher_type), intent(in) :: self
      !> Time, without influence
      real(wp), intent(in) :: t
      !> State
      real(wp), intent(in) :: y(:)
      !> Its time derivative
      real(wp), intent(in) :: slope(:)
      !> The functions
      real(wp), intent(out) :: g(:)

      g = [slope(index_of_ln_v), y(index_of_ln_v) - levels]
   end subroutine values

   !> Let the writer sample an event.
   subroutine await(self, which, t, y, slope)
      !> The watcher
      class(motion_watcher_type), intent(inout) :: self
      !> Number of the function
      integer, intent(in) :: which
      !> When
      type(instant), intent(in) :: t
      !> State there, which the writer receives later
      real(wp), intent(in) :: y(:)
      !> Its time derivative
      real(wp), intent(in) :: slope(:)

      real(wp) :: time

      ! the first number that is not before the event: dense output begins there at the earliest
      time = t%hi
      if (t%lo > 0.0_wp) time = nearest(time, 1.0_wp)
      associate (writer => self%writer)
         if (writer%reached == writer%times .or. time <= writer%block(writer%held, 0)) return
         writer%awaited = [writer%awaited, time]
         writer%next = min(writer%next, time)
      end associate
   end subroutine await

   !> Write the block.
   subroutine flush_block(self)
      !> The writer
      class(trajectory_writer_type), intent(inout) :: self
      integer :: i

      do i = 0, ubound(self%block, 2)
         call self%file%put(self%ids(i), self%block(:self%held, i), first=self%written + 1)
      end do
      self%written = self%written + self%held
      self%held = 0
   end subroutine flush_block

   !> Write what is left, the scene and what the integration did, and complete the file.
   subroutine finish(self, outcome, error)
      !> The writer
      class(trajectory_writer_type), intent(inout) :: self
      !> What the integration did
      type(integration_result), intent(in) :: outcome
      !> It could not be written
      type(error_type), allocatable, intent(out) :: error

      call self%progress%finish()
      call self%flush()
      associate (file => self%file, scene => self%scene)
         call file%attribute("scene", trim(scene%name))
         call put_parameters(file, scene%parameters)
         call put_history(file, scene%history)
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

   !> Leave nothing behind.
   subroutine discard(self)
      !> The writer
      class(trajectory_writer_type), intent(inout) :: self

      call self%progress%finish()
      call self%file%discard()
   end subroutine discard
end module trajectory_output
