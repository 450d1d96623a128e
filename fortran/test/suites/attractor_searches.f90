! SPDX-License-Identifier: BSD-3-Clause
!> Searches for attractors in tests: blocks near steady sliding, and settings as in the
!> configuration or coarser.
module attractor_searches
   use attractors, only: attractor_settings_type, attractor_type, find_attractor
   use block_builder, only: build_block
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect_success
   use mctc_env_testing, only: error_type
   use model_problem, only: model_type
   use solving, only: at_tolerance
   implicit none (type, external)
   private
   public :: coarse_settings, disturbed_block, fine_settings, search

contains

   !> Settings as in the configuration, with times of a scene.
   pure type(attractor_settings_type) function fine_settings(t_transient, t_observed) &
      result(settings)
      real(wp), intent(in) :: t_transient, t_observed

      settings = attractor_settings_type(t_transient=t_transient, t_observed=t_observed, &
                                         t_lasting=0.0_wp, t_turning=0.5_wp*t_observed, &
                                         t_path=0.0_wp, interval=5.0_wp, exponents=4, &
                                         zero_level=3.0e-5_wp, longest_bar=1.0e-3_wp, doublings=0, &
                                         sample_interval=0.1_wp, window="hann", segments=8, &
                                         overlap=0.5_wp, peak_floor=1.0e-6_wp, &
                                         peak_prominence=10.0_wp)
   end function fine_settings

   !> Settings for searches whose exponents are of no interest.
   pure type(attractor_settings_type) function coarse_settings(t_transient) result(settings)
      real(wp), intent(in) :: t_transient

      settings = fine_settings(t_transient, 500.0_wp)
      settings%t_turning = 50.0_wp
      settings%exponents = 2
      settings%zero_level = 1.0e-3_wp
      settings%longest_bar = 1.0e-2_wp
      settings%segments = 2
   end function coarse_settings

   !> A block that starts near steady sliding, gamma = 0.8.
   type(model_type) function disturbed_block(tau, epsilon, xi) result(block)
      real(wp), intent(in) :: tau, epsilon, xi

      block = build_block(tau=tau, epsilon=epsilon, xi=xi, gamma=0.8_wp, v=1.1_wp)
   end function disturbed_block

   !> The attractor of a model, at the tolerance 1e-8.
   subroutine search(model, settings, found, error)
      class(model_type), intent(in) :: model
      type(attractor_settings_type), intent(in) :: settings
      type(attractor_type), intent(out) :: found
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure

      call find_attractor(model, settings, at_tolerance(1.0e-8_wp, "auto"), found, failure)
      call expect_success(error, failure)
   end subroutine search
end module attractor_searches
