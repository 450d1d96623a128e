!> How attractors are found and judged, from the namelist group &observation.
module observation_input
   use attractors, only: attractor_settings_type
   use dde, only: integration_options
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: int64, wp
   use exponents_input, only: check_growth
   use namelist_input, only: close_namelist, not_given, open_namelist, word_length
   use solver_checks, only: check_method, check_tolerance
   use spectrum_input, only: check_spectrum
   use value_checks, only: check_count, check_number
   implicit none (type, external)
   private
   public :: read_observation

   !> Most doublings of the time that exponents take.
   integer, parameter :: most_doublings = 10
   !> Most samples at a point.
   real(wp), parameter :: most_samples = 1.0e8_wp
   !> Longest path kept of a point.
   real(wp), parameter :: longest_path = 1.0e5_wp

contains

   !> Read and check the group.
   subroutine read_observation(path, settings, options, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> How attractors are judged
      type(attractor_settings_type), intent(out) :: settings
      !> Method, tolerances and limits
      type(integration_options), intent(out) :: options
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length) :: method, window

      call read_group(path, settings, options, method, window, error)
      call check_number(error, path, "t_transient", settings%t_transient, above=0.0_wp)
      call check_number(error, path, "t_observed", settings%t_observed, above=0.0_wp)
      call check_number(error, path, "t_lasting", settings%t_lasting, at_least=0.0_wp)
      call check_number(error, path, "t_path", settings%t_path, at_least=0.0_wp, &
                        at_most=longest_path)
      call check_growth(error, path, "exponents", settings%exponents, settings%t_turning, &
                        settings%interval, settings%zero_level)
      call check_number(error, path, "longest_bar", settings%longest_bar, above=0.0_wp)
      call check_count(error, path, "doublings", settings%doublings, at_least=0, &
                       at_most=most_doublings)
      call check_number(error, path, "sample_interval", settings%sample_interval, above=0.0_wp, &
                        at_most=settings%t_observed)
      call check_spectrum(error, path, window, settings%segments, settings%overlap, &
                          settings%peak_floor, settings%peak_prominence)
      call check_tolerance(error, path, "tolerance", options%relative)
      call check_method(error, path, method)
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
      type(attractor_settings_type), intent(out) :: settings
      !> Tolerances and limits
      type(integration_options), intent(out) :: options
      !> Method
      character(len=word_length), intent(out) :: method
      !> Window
      character(len=word_length), intent(out) :: window
      !> They cannot be read
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: interval, longest_bar, overlap, peak_floor, peak_prominence, sample_interval
      real(wp) :: t_lasting, t_observed, t_path, t_transient, t_turning, tolerance, zero_level
      character(len=256) :: reason
      integer :: doublings, exponents, segments, status, unit
      integer(int64) :: most_steps
      namelist /observation/ t_transient, t_observed, t_lasting, t_turning, t_path, interval, &
         exponents, zero_level, longest_bar, doublings, sample_interval, window, segments, &
         overlap, peak_floor, peak_prominence, tolerance, method, most_steps

      t_transient = not_given()
      t_observed = t_transient
      t_lasting = t_transient
      t_turning = t_transient
      t_path = t_transient
      interval = t_transient
      zero_level = t_transient
      longest_bar = t_transient
      sample_interval = t_transient
      overlap = t_transient
      peak_floor = t_transient
      peak_prominence = t_transient
      tolerance = t_transient
      doublings = -1
      exponents = 0
      segments = 0
      most_steps = 0
      method = ""
      window = ""
      call open_namelist(path, "observation", unit, error)
      if (allocated(error)) return
      read (unit, nml=observation, iostat=status, iomsg=reason)
      call close_namelist(path, "observation", unit, status, reason, error)
      settings = attractor_settings_type( &
                 t_transient=t_transient, t_observed=t_observed, t_lasting=t_lasting, &
                 t_turning=t_turning, t_path=t_path, interval=interval, exponents=exponents, &
                 zero_level=zero_level, longest_bar=longest_bar, doublings=doublings, &
                 sample_interval=sample_interval, &
                 segments=segments, overlap=overlap, peak_floor=peak_floor, &
                 peak_prominence=peak_prominence)
      options = integration_options(relative=tolerance, absolute=tolerance, most_steps=most_steps)
   end subroutine read_group
end module observation_input
