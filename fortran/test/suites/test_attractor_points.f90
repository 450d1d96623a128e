!> Attractors at many points: the same in any number of threads, and trouble at one is none of the
!> others'.
module test_attractor_points
   use attractor_points, only: find_attractors, finding_type, point_type
   use attractors, only: attractor_settings_type
   use block_parameters, only: block_history_type, block_parameters_type
   use dde, only: integration_options
   use dde_errors, only: text
   use expectations, only: expect, expect_failure, expect_success
   use dde_kinds, only: int64, wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use motion_classes, only: fixed_point, undecided
   use omp_lib, only: omp_get_max_threads, omp_get_num_threads, omp_set_num_threads
   use progress_receiver, only: progress_receiver_type
   use solving, only: at_tolerance
   implicit none (type, external)
   private
   public :: collect_attractor_points

   !> Keeps what it is told.
   type, extends(progress_receiver_type) :: memory_type
      !> Numbers of points done, and of all
      integer, allocatable :: done(:), total(:)
      !> Most threads at work at a time
      integer :: threads = 0
   contains
      procedure :: advance => keep
   end type memory_type

contains

   !> All tests of this suite.
   subroutine collect_attractor_points(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("in threads", test_threads), &
                   new_unittest("on a grid", test_grid), &
                   new_unittest("a point that cannot be run", test_problem), &
                   new_unittest("no run can be finished", test_all_problems)]
   end subroutine collect_attractor_points

   !> Keep a report.
   subroutine keep(self, done, total)
      class(memory_type), intent(inout) :: self
      integer, intent(in) :: done, total

      self%done = [self%done, done]
      self%total = [self%total, total]
      self%threads = max(self%threads, omp_get_num_threads())
   end subroutine keep

   !> Points of different cost: tau = 0 to 15, histories apart.
   pure function some_points() result(points)
      type(point_type) :: points(8)
      integer :: i

      points = [(point_type(block_parameters_type(tau=5.0_wp*modulo(i, 4), xi=0.8_wp, &
                                                  epsilon=0.3_wp + 0.05_wp*i, gamma=0.8_wp), &
                            block_history_type(theta=0.1_wp*i, v=1.5_wp)), i=1, 8)]
   end function some_points

   !> How attractors are found here.
   pure type(attractor_settings_type) function quickly() result(settings)
      settings = attractor_settings_type(t_lasting=0.0_wp, t_path=0.0_wp, &
                                         t_transient=200.0_wp, t_observed=500.0_wp, &
                                    t_turning=50.0_wp, interval=5.0_wp, exponents=3, &
                                         zero_level=1.0e-3_wp, longest_bar=1.0e-2_wp, doublings=1, &
                                         sample_interval=0.1_wp, window="hann", segments=2, &
                                    overlap=0.5_wp, peak_floor=1.0e-6_wp, peak_prominence=10.0_wp)
   end function quickly

   !> One thread and two, twice over: the same to the last bit.
   subroutine test_threads(error)
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: alone(:), together(:)
      type(memory_type) :: memory
      integer :: i, round, threads

      threads = omp_get_max_threads()
      call omp_set_num_threads(1)
      call find_attractors(some_points(), quickly(), at_tolerance(1.0e-6_wp, "auto"), alone)
      do round = 1, 2
         memory = memory_type(done=[integer ::], total=[integer ::])
         call omp_set_num_threads(2)
         call find_attractors(some_points(), quickly(), at_tolerance(1.0e-6_wp, "auto"), &
                              together, memory)
         call omp_set_num_threads(threads)
         call expect(error, memory%threads == 2, "two threads")
         call expect(error, size(memory%done) == 8 .and. all(memory%done == [(i, i=1, 8)]) &
                     .and. all(memory%total == 8), "progress point by point")
         do i = 1, size(alone)
            call expect_success(error, alone(i)%problem)
            call expect_success(error, together(i)%problem)
            if (allocated(error)) return
            call expect(error, same_bits(all_of(alone(i)), all_of(together(i))), &
                        "the same at point "//text(i))
         end do
      end do
   end subroutine test_threads

   !> On a grid across the Hopf curve of the block without delay,
   !> epsilon = xi gamma**2/(xi + gamma**2): the points that are computed are the same as without
   !> refinements, the others have the class of their neighbours.
   subroutine test_grid(error)
      type(error_type), allocatable, intent(out) :: error
      integer, parameter :: columns = 5, lines = 5
      type(finding_type), allocatable :: all_computed(:), findings(:)
      type(integration_options) :: options
      type(memory_type) :: memory
      type(point_type) :: points(columns, lines)
      integer :: i, j, threads

      threads = omp_get_max_threads()
      do j = 1, lines
         do i = 1, columns
            points(i, j) = point_type( &
                           block_parameters_type(tau=0.0_wp, xi=0.5_wp + 0.02_wp*j, &
                                                 epsilon=0.1_wp*i, gamma=0.8_wp), &
                           block_history_type(v=1.1_wp))
         end do
      end do
      options = at_tolerance(1.0e-6_wp, "auto")
      associate (list => reshape(points, [size(points)]))
         call find_attractors(list, quickly(), options, all_computed)
         do i = 1, 2
            memory = memory_type(done=[integer ::], total=[integer ::])
            call omp_set_num_threads(i)
            call find_attractors(list, quickly(), options, findings, memory, columns, 1)
            call omp_set_num_threads(threads)
            call expect(error, all(all_computed%computed) .and. .not. all(findings%computed), &
                        "some points are not computed")
            call expect(error, all(findings%attractor%class == all_computed%attractor%class), &
                        "the same classes")
            do j = 1, size(list)
               if (.not. findings(j)%computed) cycle
               call expect_success(error, findings(j)%problem)
               if (allocated(error)) return
               call expect(error, same_bits(all_of(findings(j)), all_of(all_computed(j))), &
                           "the same at point "//text(j))
            end do
            associate (done => memory%done, n => size(memory%done))
               call expect(error, all(done(2:) >= done(:n - 1)) .and. done(n) == size(list) &
                           .and. all(done(:n - 1) < size(list)), "progress to the end")
            end associate
         end do
      end associate
   end subroutine test_grid

   !> All numbers of a finding.
   pure function all_of(finding) result(numbers)
      !> The finding
      type(finding_type), intent(in) :: finding
      real(wp), allocatable :: numbers(:)

      associate (a => finding%attractor)
         numbers = [real([a%class, a%by_exponents, a%by_section, a%by_spectrum, a%period], wp), &
                    a%exponents%value, a%exponents%error, a%roughness, a%bases, a%line_share, &
                    a%motion%maxima, &
                     reshape(a%motion%section, [size(a%motion%section)]), a%motion%section_time]
      end associate
   end function all_of

   !> Whether the bits are the same.
   pure logical function same_bits(a, b) result(value)
      !> Some numbers
      real(wp), intent(in) :: a(:)
      !> As many others
      real(wp), intent(in) :: b(:)

      value = size(a) == size(b) .and. all(transfer(a, [0_int64]) == transfer(b, [0_int64]))
   end function same_bits

   !> A history from which no step is possible gives its words and no class; the points beside it
   !> are what they are alone.
   subroutine test_problem(error)
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: alone(:), findings(:)
      type(point_type) :: points(3)

      points%parameters = block_parameters_type(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, &
                                                gamma=0.8_wp)
      points(1)%parameters%tau = 0.0_wp
      points(1)%parameters%epsilon = 0.3_wp
      points(2)%history%v = 1.0e-300_wp
      points(3)%history%v = 1.5_wp
      call find_attractors(points, quickly(), at_tolerance(1.0e-6_wp, "auto"), findings)
      call find_attractors(points(3:), quickly(), at_tolerance(1.0e-6_wp, "auto"), alone)
      call expect_success(error, findings(1)%problem)
      call expect_failure(error, findings(2)%problem, "stopped at t = ")
      call expect_success(error, findings(3)%problem)
      if (allocated(error)) return
      call expect(error, findings(1)%attractor%class == fixed_point, "steady sliding")
      call expect(error, findings(2)%attractor%class == undecided, "nothing there")
      call expect(error, same_bits(all_of(findings(3)), all_of(alone(1))), "the same alone")
   end subroutine test_problem

   !> Too few steps are allowed for any. So none has the class of its neighbours.
   subroutine test_all_problems(error)
      type(error_type), allocatable, intent(out) :: error
      type(finding_type), allocatable :: findings(:)
      type(integration_options) :: options
      integer :: i

      options = at_tolerance(1.0e-6_wp, "auto")
      options%most_steps = 5
      call find_attractors(some_points(), quickly(), options, findings, columns=4, refinements=1)
      call expect(error, all(findings%computed), "all are computed")
      do i = 1, size(findings)
         call expect_failure(error, findings(i)%problem, "5 steps (most_steps) were used up")
         call expect(error, findings(i)%attractor%class == undecided, "undecided")
      end do
   end subroutine test_all_problems
end module test_attractor_points
