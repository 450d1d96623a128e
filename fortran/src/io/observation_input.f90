!> How attractors are found and judged, from the namelist group &observation.
module observation_input
   use attractors, only: attractor_settings
   use dde, only: integration_options, methods
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: int64, wp
   use namelist_input, only: check_choice, check_count, check_number, close_namelist, not_given, &
                             open_namelist, word_length
   use spectrum_input, only: windows
   implicit none (type, external)
   private
   public :: read_observation

   !> Most exponents and blocks.
   integer, parameter :: most_exponents = 64, most_blocks = 1000
   !> Most doublings of the time that exponents take.
   integer, parameter :: most_doublings = 10
   !> Most samples at a point.
   real(wp), parameter :: most_samples = 1.0e8_wp

contains

   !> Read and check the group.
   subroutine read_observation(path, settings, options, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> How attractors are judged
      type(attractor_settings), intent(out) :: settings
      !> Method, tolerances and limits
      type(integration_options), intent(out) :: options
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length) :: method, window

      call read_group(path, settings, options, method, window, error)
      call check_number(error, path, "t_transient", settings%t_transient, above=0.0_wp)
      call check_number(error, path, "t_observed", settings%t_observed, above=0.0_wp)
      call check_number(error, path, "t_turning", settings%t_turning, at_least=0.0_wp)
      call check_number(error, path, "interval", settings%interval, above=0.0_wp)
      call check_count(error, path, "blocks", settings%blocks, at_least=2, at_most=most_blocks)
      call check_count(error, path, "exponents", settings%exponents, at_least=1, &
                       at_most=most_exponents)
      call check_number(error, path, "zero_level", settings%zero_level, at_least=0.0_wp)
      call check_number(error, path, "longest_bar", settings%longest_bar, above=0.0_wp)
      call check_count(error, path, "doublings", settings%doublings, at_least=0, &
                       at_most=most_doublings)
      call check_number(error, path, "sample_interval", settings%sample_interval, above=0.0_wp, &
                        at_most=settings%t_observed)
      call check_choice(error, path, "window", window, windows)
      call check_count(error, path, "segments", settings%segments, at_least=1)
      call check_number(error, path, "overlap", settings%overlap, at_least=0.0_wp, below=1.0_wp)
      call check_number(error, path, "peak_floor", settings%peak_floor, above=0.0_wp, &
                        at_most=1.0_wp)
      call check_number(error, path, "peak_prominence", settings%peak_prominence, at_least=1.0_wp)
      call check_number(error, path, "tolerance", options%relative, at_least=1.0e-13_wp, &
                        at_most=1.0e-2_wp)
      call check_choice(error, path, "method", method, methods)
      if (allocated(error)) return
      call check_number(error, path, "number of samples t_observed/sample_interval", &
                        settings%t_observed/settings%sample_interval, at_most=most_samples)
      if (options%most_steps < 1) then
         call raise(error, path//": most_steps = "//text(options%most_steps) &
                    //"; expected a whole number >= 1")
         return
      end if
      settings%window = trim(window)
      options%method = trim(method)
   end subroutine read_observation

   !> Read the group &observation.
   subroutine read_group(path, settings, options, method, window, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> How attractors are judged
      type(attractor_settings), intent(out) :: settings
      !> Tolerances and limits
      type(integration_options), intent(out) :: options
      !> Method
      character(len=word_length), intent(out) :: method
      !> Window
      character(len=word_length), intent(out) :: window
      !> They cannot be read
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: interval, longest_bar, overlap, peak_floor, peak_prominence, sample_interval
      real(wp) :: t_observed, t_transient, t_turning, tolerance, zero_level
      character(len=256) :: reason
      integer :: blocks, doublings, exponents, segments, status, unit
      integer(int64) :: most_steps
      namelist /observation/ t_transient, t_observed, t_turning, interval, blocks, exponents, &
         zero_level, longest_bar, doublings, sample_interval, window, segments, overlap, &
         peak_floor, peak_prominence, tolerance, method, most_steps

      t_transient = not_given()
      t_observed = t_transient
      t_turning = t_transient
      interval = t_transient
      zero_level = t_transient
      longest_bar = t_transient
      sample_interval = t_transient
      overlap = t_transient
      peak_floor = t_transient
      peak_prominence = t_transient
      tolerance = t_transient
      blocks = 0
      doublings = -1
      exponents = 0
      segments = 0
      most_steps = 0
      method = ""
      window = ""
      call open_namelist(path, unit, error)
      if (allocated(error)) return
      read (unit, nml=observation, iostat=status, iomsg=reason)
      call close_namelist(path, "observation", unit, status, reason, error)
      settings = attractor_settings(t_transient, t_observed, t_turning, interval, blocks, &
                                    exponents, zero_level, longest_bar, doublings, &
                                    sample_interval, "", segments, overlap, peak_floor, &
                                    peak_prominence)
      options = integration_options(relative=tolerance, absolute=tolerance, most_steps=most_steps)
   end subroutine read_group
end module observation_input
