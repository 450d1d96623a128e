! SPDX-License-Identifier: BSD-3-Clause
!> Attractors of the delayed block: those of the scenes, and what cannot be told.
module test_attractors
   use block_builder, only: build_block, made
   use attractor_verdict, only: judge
   use attractor_searches, only: disturbed => disturbed_block, after => fine_settings, search
   use attractors, only: attractor_settings_type, attractor_type, find_attractor
   use dde, only: integration_options, integration_result
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_between, expect_close, expect_failure, expect_success
   use dde_kinds, only: wp
   use lyapunov_spectrum, only: growth_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use motion_classes, only: chaos, class_names, cycle_motion, fixed_point, none, three_torus, &
                             torus, undecided
   use observed_motion, only: observed_motion_type
   use solving, only: at_tolerance, run
   implicit none (type, external)
   private
   public :: collect_attractors

contains

   subroutine collect_attractors(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("scenes of the paper", test_scenes), &
                   new_unittest("chaos that becomes clear", test_clear_chaos), &
                   new_unittest("another torus, time doubled", test_doublings), &
                   new_unittest("a 3-torus", test_three_torus), &
                   new_unittest("tori after another motion", test_late_tori), &
                   new_unittest("no motion and few samples", test_nothing), &
                   new_unittest("models of one state", test_one_state), &
                   new_unittest("maxima of a stuck block", test_stuck)]
   end subroutine collect_attractors

   !> The attractor of a model and its four classes.
   subroutine find(model, settings, class, found, error)
      class(model_type), intent(in) :: model
      type(attractor_settings_type), intent(in) :: settings
      !> Its class, that none of its indicators contradicts
      integer, intent(in) :: class
      type(attractor_type), intent(out) :: found
      type(error_type), allocatable, intent(inout) :: error

      call search(model, settings, found, error)
      if (allocated(error)) return
      associate (classes => [found%class, found%by_exponents, found%by_section, found%by_spectrum])
         call expect(error, all(classes(:2) == class) .and. &
                     all(classes(3:) == class .or. classes(3:) == undecided), &
                     "none denies "//trim(class_names(class))//" (" &
                     //trim(class_names(classes(1)))//": "//trim(class_names(classes(2)))//", " &
                     //trim(class_names(classes(3)))//", "//trim(class_names(classes(4)))//")")
      end associate
   end subroutine find

   !> Fig. 4a, a fixed point; 4b, a cycle; 5a and 6b, where another computation (see the README)
   !> found a cycle; a cycle without delay, with three exponents, however many are wanted; chaos of
   !> Fig. 5b and 7. A fixed point that is undecided at first, since the oscillation decays slowly.
   subroutine test_scenes(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: classes(5) = [fixed_point, spread(cycle_motion, 1, 3), chaos]
      real(wp), parameter :: numbers(5, 5) = reshape( &
         [0.0_wp, 0.3_wp, 0.8_wp, 600.0_wp, 1000.0_wp, 10.0_wp, 0.35_wp, 0.8_wp, 7000.0_wp, &
          3000.0_wp, 10.0_wp, 0.5_wp, 0.8_wp, 2000.0_wp, 3000.0_wp, 0.0_wp, 0.6_wp, 0.8_wp, &
          500.0_wp, 2000.0_wp, 7.0_wp, 0.7_wp, 0.5_wp, 1000.0_wp, 4000.0_wp], [5, 5])
      type(attractor_settings_type) :: settings
      type(attractor_type) :: found
      integer :: i

      do i = 1, size(classes)
         associate (x => numbers(:, i))
            call find(disturbed(x(1), x(2), x(3)), after(x(4), x(5)), classes(i), found, error)
            if (allocated(error)) return
            if (classes(i) == cycle_motion) call expect_simple_cycle(error, found)
            if (x(1) <= 0.0_wp) call expect(error, size(found%exponents) == 3, "three exponents")
         end associate
      end do
      call expect(error, found%exponents(1)%value > 3.0_wp*found%exponents(1)%error &
                  .and. found%period == 0, "leading exponent in error bars, and no period")
      settings = after(200.0_wp, 100.0_wp)
      settings%doublings = 3
      call find(disturbed(1.6_wp, 0.63_wp, 0.5_wp), settings, fixed_point, found, error)
      if (allocated(error)) return
      call expect_between(error, found%time, 350.0_wp, 1000.0_wp, "time")
      call expect(error, found%reason == none, "no reason to be undecided")
   end subroutine test_scenes

   !> A cycle that meets the section once a turn: its maxima are one, and its frequency is that at
   !> which the section is met.
   subroutine expect_simple_cycle(error, found)
      type(error_type), allocatable, intent(inout) :: error
      type(attractor_type), intent(in) :: found

      associate (time => found%motion%section_time, maxima => found%motion%maxima)
         associate (n => size(time))
            call expect(error, found%period == 1 .and. size(found%motion%section, 2) == n &
                        .and. .not. found%bases(2) > 0.0_wp, "period 1, times, one base")
            call expect_close(error, found%bases(1)*(time(n) - time(1)), n - 1.0_wp, 1.0e-2_wp, &
                              "turns by frequency and by passages")
         end associate
         call expect_between(error, maxval(maxima)/minval(maxima), 1.0_wp, 1.001_wp, &
                             "largest over smallest maximum")
         call expect_between(error, minval(maxima), 1.0_wp, 100.0_wp, "smallest maximum")
      end associate
   end subroutine expect_simple_cycle

   !> Chaos is clear by exponents in a second judgement: nothing is left of section and spectrum of
   !> the first.
   subroutine test_clear_chaos(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: intervals = 50
      type(failure_type), allocatable :: failure
      type(attractor_settings_type) :: settings
      type(attractor_type) :: found
      type(growth_type) :: measured

      settings = after(0.0_wp, 500.0_wp)
      call found%motion%begin(disturbed(7.0_wp, 0.7_wp, 0.5_wp), settings%sample_interval)
      call found%motion%observe(disturbed(7.0_wp, 0.7_wp, 0.5_wp), settings%t_observed, &
                                at_tolerance(1.0e-8_wp, "auto"), failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      measured%length = spread(10.0_wp, 1, intervals)
      allocate (measured%growth(3, intervals), source=0.0_wp)
      call judge(settings, measured, .true., .true., found, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, found%roughness >= 0.0_wp .and. found%line_share >= 0.0_wp &
                  .and. found%bases(1) > 0.0_wp, "section and spectrum at first")
      measured%growth = spread([1.0_wp, -1.0_wp, -2.0_wp], 2, intervals)
      call judge(settings, measured, .true., .true., found, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, found%class == chaos .and. found%by_section == undecided &
                  .and. found%by_spectrum == undecided, "chaos by exponents alone")
      call expect(error, found%roughness < 0.0_wp .and. found%line_share < 0.0_wp &
                  .and. all(found%bases <= 0.0_wp), "nothing of the first judgement")
   end subroutine test_clear_chaos

   !> In 1500 units of time the exponents of a torus cannot be told from zero closely enough, in
   !> four times that they can.
   subroutine test_doublings(error)
      type(error_type), allocatable, intent(out) :: error
      type(attractor_settings_type) :: settings
      type(attractor_type) :: found, longer

      settings = after(3000.0_wp, 1500.0_wp)
      settings%segments = 4
      call search(disturbed(15.0_wp, 0.8_wp, 0.8_wp), settings, found, error)
      call expect(error, all([found%by_exponents, found%class, found%by_section, &
                              found%by_spectrum] == [undecided, undecided, torus, torus]), &
                  "undecided at first, while the others are sure")
      settings%doublings = 2
      call find(disturbed(15.0_wp, 0.8_wp, 0.8_wp), settings, torus, longer, error)
      if (allocated(error)) return
      call expect(error, all((longer%bases > 0.0_wp) .eqv. [.true., .true., .false.]) &
                  .and. longer%period == 0, "two bases and no period")
      call expect_between(error, longer%roughness, 0.0_wp, 0.05_wp, "roughness")
      call expect_between(error, longer%line_share, 0.99_wp, 1.0_wp, "share of the lines")
      call expect_close(error, longer%exponents(:2)%value, [0.0_wp, 0.0_wp], 1.0e-3_wp, &
                        "leading exponents")
      call expect_between(error, longer%exponents(3)%value, -1.0_wp, -1.0e-4_wp, "the third")
      call expect_between(error, maxval(longer%exponents(:2)%error), 0.0_wp, &
                          maxval(found%exponents(:2)%error), "error bars of the longer time")
   end subroutine test_doublings

   !> Three exponents are wanted and all are zero, so that a fourth is measured. The expected values
   !> are those of another integrator, a Runge-Kutta method of fixed step, over 1.5e5 units of time,
   !> and the highest lines of its Fourier transform: with three frequencies |m| + |n| + |k| <= 12
   !> explains all but 6e-6 of the power, with two at most 93 %.
   subroutine test_three_torus(error)
      type(error_type), allocatable, intent(out) :: error
      type(attractor_settings_type) :: settings
      type(attractor_type) :: found
      real(wp), parameter :: known(3) = [0.05638604_wp, 0.10164914_wp, 0.00139409_wp]
      integer, parameter :: most = 4
      real(wp) :: misfit
      integer :: i, k, m, n

      settings = after(4000.0_wp, 4000.0_wp)
      settings%exponents = 3
      settings%interval = 20.0_wp
      settings%doublings = 1
      settings%segments = 1
      call find(build_block(tau=115.0_wp/6.0_wp, epsilon=0.05_wp + 1.45_wp*28.0_wp/36.0_wp, &
                            xi=0.8_wp, gamma=0.8_wp, v=1.5_wp), settings, three_torus, found, error)
      if (allocated(error)) return
      call expect_close(error, found%exponents%value, [0.0_wp, 0.0_wp, 0.0_wp, -1.88e-3_wp], &
                        3.0e-5_wp, "four exponents")
      do i = 1, size(found%bases)
         misfit = minval([(((abs(sum([k, m, n]*known) - found%bases(i)), k=-most, most), &
                            m=-most, most), n=-most, most)])
         call expect_between(error, misfit, 0.0_wp, 3.0e-6_wp, "a combination of three frequencies")
      end do
   end subroutine test_three_torus

   !> Tori that are reached after another motion, with the settings of the atlas. The approach to
   !> the first is certain chaos for a while by exponents and spectrum. The second is a torus also
   !> after 4e5 units of time; while the motion leaves an unstable cycle, two equal positive
   !> exponents and the spectrum would call it chaos.
   subroutine test_late_tori(error)
      type(error_type), allocatable, intent(out) :: error
      type(attractor_settings_type) :: settings
      type(attractor_type) :: found
      integer :: i

      settings = after(2000.0_wp, 800.0_wp)
      settings%t_lasting = 4000.0_wp
      settings%t_turning = 500.0_wp
      settings%interval = 20.0_wp
      settings%exponents = 3
      settings%doublings = 6
      do i = 1, 2
         if (i == 1) then
            call search(disturbed(12.75_wp, 0.5_wp, 0.8_wp), settings, found, error)
         else
            call search(build_block(tau=0.4_wp + 19.6_wp*19.0_wp/24.0_wp, xi=0.5_wp, &
                                    epsilon=0.05_wp + 1.45_wp/3.0_wp, gamma=1.0e8_wp, v=1.5_wp), &
                        settings, found, error)
         end if
         call expect(error, found%class == torus, "a torus")
         call expect_between(error, found%time, 1.5e4_wp, 2.0e4_wp + 1.0e4_wp*i, &
                             "time: another motion came before")
      end do
   end subroutine test_late_tori

   !> A block that slides steadily without end, though unstably, comes to no class and to no points.
   !> No spectrum: an error, no class.
   subroutine test_nothing(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(attractor_settings_type) :: settings
      type(attractor_type) :: found

      call find(build_block(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp), &
                after(100.0_wp, 500.0_wp), undecided, found, error)
      if (allocated(error)) return
      call expect(error, size(found%motion%maxima) == 0 .and. &
                  size(found%motion%section_time) == 0, "no events")
      settings = after(200.0_wp, 500.0_wp)
      settings%sample_interval = 500.0_wp
      call find_attractor(disturbed(12.5_wp, 0.5_wp, 0.8_wp), settings, &
                          at_tolerance(1.0e-6_wp, "auto"), found, failure)
      call expect_failure(error, failure, "samples")
      call expect(error, found%class == undecided, "undecided")
   end subroutine test_nothing

   !> A model without coordinates of its section, which is met where the state rises through rest.
   !> The exponents at rest are the real parts of the roots of s + exp(-s) = 0. The points of the
   !> section of the cycle that follows the Hopf point of Mackey and Glass's equation are the time
   !> since the passage before and the greatest value since.
   subroutine test_one_state(error)
      type(error_type), allocatable, intent(out) :: error
      type(attractor_settings_type) :: settings
      type(attractor_type) :: found
      integer :: n

      call find(made("made_decay", [1.0_wp, 1.0_wp, 0.0_wp], [0.5_wp]), after(100.0_wp, 100.0_wp), &
                fixed_point, found, error)
      if (allocated(error)) return
      call expect_close(error, found%exponents%value, &
                        [-0.3181315052047642_wp, -0.3181315052047642_wp, &
                         -2.0622777295982839_wp, -2.0622777295982839_wp], 1.0e-12_wp, "exponents")
      settings = after(1000.0_wp, 1000.0_wp)
      settings%t_path = 50.0_wp
      call find(made("made_mackey_glass", [6.0_wp], [1.2_wp]), settings, cycle_motion, found, error)
      if (allocated(error)) return
      call expect(error, found%period == 1, "period 1")
      if (allocated(error)) return
      n = size(found%motion%section_time)
      call expect_close(error, found%motion%section(:, n), &
                        [1.0_wp/found%bases(1), found%motion%maxima(size(found%motion%maxima))], &
                        1.0e-6_wp, "the last point of the section")
      call expect(error, allocated(found%path), "a path")
      if (allocated(error)) return
      call expect_close(error, found%path(2, :), found%path(3, :), 0.0_wp, "state and signal")
   end subroutine test_one_state

   !> A loose tolerance makes no maxima while v of a stuck block is 1e-6 and less. All maxima of
   !> these cycles are larger than 0.04 at the tolerance 1e-10.
   subroutine test_stuck(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(observed_motion_type) :: motion(5)
      real(wp), parameter :: epsilons(5) = [1.5_wp, 1.0_wp, 1.25_wp, 1.16_wp, 1.4_wp]
      real(wp), parameter :: delays(5) = [9.3_wp, 13.3_wp, 14.7_wp, 18.7_wp, 18.7_wp]
      type(model_type) :: stuck
      integer :: i

      options = at_tolerance(1.0e-6_wp, "auto")
      do i = 1, size(motion)
         stuck = disturbed(delays(i), epsilons(i), 0.5_wp)
         call run(error, stuck, 0.0_wp, 1000.0_wp, options, outcome, &
                  continuation=motion(i)%continuation)
         if (allocated(error)) return
         call motion(i)%begin(stuck, 0.1_wp)
         call motion(i)%observe(stuck, 1000.0_wp, options, failure)
         call expect_success(error, failure)
         if (allocated(error)) return
         call expect_between(error, minval(motion(i)%maxima), 1.0e-3_wp, 10.0_wp, "maximum")
      end do
   end subroutine test_stuck
end module test_attractors
