!> Layers: dense output where a component decays within a step, and the unit of the state.
module test_dde_layers
   use dde, only: integration_options, integration_result
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use layer_problems, only: layer, measure_errors, relaxation
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use published_problems, only: enzyme
   use solving, only: at_tolerance, run
   implicit none (type, external)
   private
   public :: collect_dde_layers

   !> Methods, and the largest rate at which each is tried: explicit steps are as long as one over
   !> the rate.
   character(len=8), parameter :: methods(6) = &
      [character(len=8) :: "auto", "dop853", "bs5", "radau5", "radau9", "radau13"]
   real(wp), parameter :: largest_rate(6) = [1.0e6_wp, 1.0e3_wp, 1.0e3_wp, 1.0e6_wp, 1.0e6_wp, &
                                             1.0e6_wp]

contains

   subroutine collect_dde_layers(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("a pulse, and one that returns", test_pulses), &
                   new_unittest("a decay without delay", test_decay), &
                   new_unittest("the unit of the state", test_unit), &
                   new_unittest("one loose component", test_loose)]
   end subroutine collect_dde_layers

   !> The pulse that y1 leaves behind is in y2 a delay later, at rates over six decades. An error of
   !> y1 counts for y2 as often as the rate says: both have the same absolute tolerance,
   !> then one over the rate.
   subroutine test_pulses(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(layer) :: problem
      real(wp), parameter :: t_end(2) = [2.5_wp, 3.7_wp]
      real(wp) :: rate, tolerance
      type(integration_options) :: options
      integer :: digits, i, j, k, strict

      do i = 1, size(methods)
         do digits = 3, 12, 3
            tolerance = 10.0_wp**(-digits)
            do j = 0, 18
               rate = 1.01_wp*10.0_wp**(j/3.0_wp)
               if (rate > largest_rate(i)) exit
               do k = 1, 2
                  problem = layer(rate, merge(0.0_wp, 0.5_wp, k == 1))
                  problem%analytic = modulo(j, 2) == 0
                  do strict = 0, 1
                     options = at_tolerance(tolerance, methods(i))
                     if (strict == 1) options%absolute = tolerance/rate
                     call run(error, problem, 0.0_wp, t_end(k), options, outcome)
                     if (allocated(error)) return
                     call expect_close(error, outcome%y, problem%exact(t_end(k)), &
                                       tolerance*merge(100.0_wp + rate, 10.0_wp, strict == 0), &
                                       trim(methods(i))//" at "//text(tolerance)//", rate " &
                                       //text(rate))
                  end do
               end do
            end do
         end do
      end do
      ! here the embedded error was small by chance in a step over the layer at t = 3
      options = at_tolerance(1.0e-6_wp, "radau13")
      problem = layer(10.0_wp**(34.0_wp/15.0_wp)*1.01_wp, 0.5_wp)
      options%absolute = options%relative/problem%rate
      call run(error, problem, 0.0_wp, 3.7_wp, options, outcome)
      if (allocated(error)) return
      call expect_close(error, outcome%y, problem%exact(3.7_wp), 1.0e-5_wp, "by chance")
   end subroutine test_pulses

   !> Samples between the ends of steps; `dop853` was wrong by up to 471 tolerances.
   subroutine test_decay(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp), allocatable :: largest(:)
      real(wp) :: rate, tolerance
      integer :: digits, i, j

      do i = 1, size(methods)
         do digits = 3, 12, 3
            tolerance = 10.0_wp**(-digits)
            do j = 0, 72, 2
               rate = 1.01_wp*10.0_wp**(j/12.0_wp)
               if (rate > largest_rate(i)) exit
               call measure_errors(relaxation(rate), 3.7_wp, at_tolerance(tolerance, methods(i)), &
                                   1.0_wp/16, largest, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect_between(error, largest(1)/tolerance, 0.0_wp, 100.0_wp, &
                                   trim(methods(i))//" at "//text(tolerance)//", rate "//text(rate))
            end do
         end do
      end do
   end subroutine test_decay

   !> With state and absolute tolerance in another unit the results are the same: bit by bit if it
   !> is a power of two.
   subroutine test_unit(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: known, outcome
      type(integration_options) :: options
      type(layer) :: problem
      character(len=8), parameter :: tried(7) = [methods, "taylor  "]
      integer, parameter :: powers(4) = [-40, -7, 13, 40]
      integer :: i, j
      real(wp) :: unit

      do i = 1, size(tried)
         do j = 0, size(powers) + 1
            unit = 1.0_wp
            if (j > 0) unit = 1000.0_wp
            if (j > 0 .and. j <= size(powers)) unit = 2.0_wp**powers(j)
            problem = layer(30.0_wp, 0.5_wp)
            problem%first = unit*problem%first
            options = at_tolerance(1.0e-9_wp, tried(i))
            options%absolute = 1.0e-3_wp*unit
            call run(error, problem, 0.0_wp, 3.7_wp, options, outcome)
            if (allocated(error)) return
            if (j == 0) known = outcome
            call expect_close(error, outcome%y/unit, known%y, &
                              merge(0.0_wp, 1.0e-9_wp, j <= size(powers)), &
                              trim(tried(i))//" in units of "//text(unit)//": y")
            call expect(error, j > size(powers) .or. outcome%accepted == known%accepted, &
                        "the same steps")
         end do
      end do
   end subroutine test_unit

   !> A component of which nothing is asked changes nothing of the others.
   subroutine test_loose(error)
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: loose, outcome
      type(integration_options) :: options
      integer :: i

      do i = 1, size(methods)
         options = at_tolerance(1.0e-9_wp, methods(i))
         call run(error, enzyme(), 0.0_wp, 20.0_wp, options, outcome)
         options%each_absolute = [1.0e-9_wp, 1.0e-9_wp, 1.0e-9_wp, 1.0e6_wp]
         call run(error, enzyme(), 0.0_wp, 20.0_wp, options, loose)
         if (allocated(error)) return
         call expect_between(error, loose%accepted/real(outcome%accepted, wp), 0.8_wp, 1.2_wp, &
                             methods(i))
      end do
   end subroutine test_loose
end module test_dde_layers
