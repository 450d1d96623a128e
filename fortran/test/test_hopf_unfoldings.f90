!> What the normal forms predict beside special points of the Hopf curves, against roots of (5) and
!> against simulation.
module test_hopf_unfoldings
   use block_equation, only: block_equation_type
   use block_parameters, only: block_history_type, block_parameters_type
   use characteristic_roots, only: find_roots
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: find_hopf_points, hopf_point_type, judge_points
   use hopf_unfoldings, only: cycle_type, predict_torus
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use normal_form, only: critical_vectors
   use solving, only: at_tolerance, solve
   use spring_block, only: index_of_ln_v, spring_block_type
   use traced_planes, only: trace, traced_plane
   implicit none (type, external)
   private
   public :: collect_hopf_unfoldings

   !> The block with a history of oscillations, sum over pairs of 2 Re(z q exp(i omega t)).
   type, extends(spring_block_type) :: oscillating_block
      !> Frequencies
      real(wp) :: omega(2) = 0.0_wp
      !> z q of the pairs
      complex(wp) :: mode(3, 2) = 0.0_wp
   contains
      procedure :: initial => oscillation_at_zero
      procedure :: history => oscillation
   end type oscillating_block

contains

   !> All tests of this suite.
   subroutine collect_hopf_unfoldings(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("directions against roots", test_directions), &
                   new_unittest("folds leave along the curve", test_fold_direction), &
                   new_unittest("torus between its lines", test_torus)]
   end subroutine collect_hopf_unfoldings

   !> Special points of a kind in a plane of Figures 2 and 3.
   subroutine find_points(i, kind, plane, found, error)
      !> Number of the plane
      integer, intent(in) :: i
      !> Kind
      character(len=*), intent(in) :: kind
      !> The plane
      class(curve_plane_type), allocatable, intent(out) :: plane
      !> The points
      type(hopf_point_type), allocatable, intent(out) :: found(:)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      type(traced_plane) :: traced
      type(hopf_point_type), allocatable :: all_points(:)

      call trace(i, traced, error)
      if (allocated(error)) return
      call judge_points(traced%points, failure)
      call expect_success(error, failure)
      call find_hopf_points(traced%plane, traced%points, all_points, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      allocate (plane, source=traced%plane)
      found = pack(all_points, all_points%kind == kind)
   end subroutine find_points

   !> A small way from a double Hopf point along the start of a curve of tori, the growth rates of
   !> both pairs have the ratio that the normal form gives, with p_jj and mu_j of different sign.
   subroutine test_directions(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(hopf_point_type), allocatable :: found(:)
      class(curve_plane_type), allocatable :: plane
      complex(wp), allocatable :: roots(:)
      type(block_equation_type) :: equation
      real(wp), parameter :: step = 1.0e-5_wp
      real(wp) :: growth(2)
      integer :: i, j, n, pair

      do n = 1, 2
         call find_points(n, "double_hopf", plane, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
            do pair = 1, 2
               associate (p => found(i)%parameters, u => found(i)%unfolding)
                  equation = block_equation_type(plane%parameters( &
                             p%epsilon + step*u%start(1, pair), &
                             plane%ordinate(p) + step*u%start(2, pair)))
                  call find_roots(equation%linear, -0.05_wp, roots, failure)
                  call expect_success(error, failure)
                  if (allocated(error)) return
                  do j = 1, 2
                     growth(j) = real(roots(minloc(abs(roots - cmplx(0.0_wp, found(i)%omega(j), &
                                                                     kind=wp)), dim=1)))
                  end do
                  growth = growth/norm2(growth)
                  call expect_close(error, growth, u%form%torus_rates(pair), 1.0e-2_wp, &
                                    "growth rates at point "//text(i)//" of plane "//text(n))
                  call expect(error, growth(pair)*real(u%form%g(pair, pair)) < 0.0_wp, &
                              "the cycle exists")
               end associate
            end do
         end do
      end do
   end subroutine test_directions

   !> Towards that side of a generalised Hopf point on which l1 and l2 differ in sign, by l1 and
   !> places of nearby points of the curve.
   subroutine test_fold_direction(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)
      class(curve_plane_type), allocatable :: plane
      type(block_parameters_type) :: there
      real(wp) :: way(2)
      integer :: i, n, side

      do n = 1, 2
         call find_points(n, "generalised_hopf", plane, found, error)
         if (allocated(error)) return
         do i = 1, size(found)
            associate (p => found(i)%parameters, u => found(i)%unfolding)
               ! c1 = 0 here
               side = nint(-sign(1.0_wp, real(u%c2)*u%c1_slope))
               there = plane%at(found(i)%omega(1)*(1.0_wp + 1.0e-5_wp*side), found(i)%branch(1))
               way = [there%epsilon - p%epsilon, plane%ordinate(there) - plane%ordinate(p)]
               call expect_close(error, u%start(:, 1), way/norm2(way), 1.0e-3_wp, &
                                 "start of the folds at point "//text(i)//" of plane "//text(n))
               call expect_close(error, real(u%c1), 0.0_wp, 1.0e-13_wp, "Re c1")
            end associate
         end do
      end do
   end subroutine test_fold_direction

   !> Beside the first double Hopf point of Figure 2 with stable tori at both lines and no unstable
   !> pair: between the lines both pairs live on, so that the maxima of ln v are of many sizes;
   !> beyond either line one of them dies out and the maxima become equal. The history is of both.
   subroutine test_torus(error)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_point_type), allocatable :: found(:)
      class(curve_plane_type), allocatable :: plane
      complex(wp) :: mode(3, 2)
      real(wp) :: least, mean, most, mu(2), r_k
      real(wp), parameter :: r = 0.1_wp, time = 2.0e4_wp
      ! |z_j|^2 of tori is positive for both pairs between the lines, negative for one of them beyond
      real(wp), parameter :: beyond(2, 2) = reshape([r, -0.5_wp*r, -0.1_wp*r, r], [2, 2])
      integer :: i, k

      call find_points(1, "double_hopf", plane, found, error)
      if (allocated(error)) return
      do i = 1, size(found)
         associate (form => found(i)%unfolding%form)
            if (found(i)%unstable_pairs == 0 .and. form%torus_stability(1) == "stable" &
                .and. form%torus_stability(2) == "stable") exit
         end associate
      end do
      call expect(error, i <= size(found), "a point with stable tori")
      if (allocated(error)) return
      associate (point => found(i), g => real(found(i)%unfolding%form%g))
         mode = modes_of(point, [sqrt(r), sqrt(r)])
         mu = -matmul(g, [r, r])
         call run(parameters_at(plane, point, mu), point%omega, mode, time, least, mean, most, error)
         call expect_between(error, most - least, 0.5_wp*known_range(mode), &
                             1.5_wp*known_range(mode), "range of maxima of the torus")
         do k = 1, 2
            mu = -matmul(g, beyond(:, k))
            call run(parameters_at(plane, point, mu), point%omega, mode, time, least, mean, most, &
                     error)
            r_k = -mu(k)/g(k, k)
            call expect_between(error, most - least, 0.0_wp, 1.0e-2_wp*mean, &
                                "range of maxima of cycle "//text(k))
            ! to first order in the amplitude
            call expect_close(error, mean, 2.0_wp*abs(mode(index_of_ln_v, k))*sqrt(r_k/r), &
                              0.25_wp*mean, "maximum of cycle "//text(k))
         end do
      end associate
   end subroutine test_torus

   !> To first order the maxima of ln v on a torus range from the difference to the sum of both
   !> amplitudes.
   pure real(wp) function known_range(mode) result(value)
      !> z q of both pairs
      complex(wp), intent(in) :: mode(3, 2)

      value = 4.0_wp*minval(abs(mode(index_of_ln_v, :)))
   end function known_range

   !> The parameters at which both pairs have given growth rates, to first order, from the starts of
   !> both curves of tori.
   type(block_parameters_type) function parameters_at(plane, point, mu) result(there)
      !> The plane
      class(curve_plane_type), intent(in) :: plane
      !> The double Hopf point
      type(hopf_point_type), intent(in) :: point
      !> Growth rates
      real(wp), intent(in) :: mu(2)
      type(cycle_type) :: at_torus
      real(wp) :: share(2), way(2, 2)
      integer :: j

      associate (p => real(point%unfolding%form%g), here => point%parameters)
         share = -[p(2, 2)*mu(1) - p(1, 2)*mu(2), p(1, 1)*mu(2) - p(2, 1)*mu(1)] &
                 /(p(1, 1)*p(2, 2) - p(1, 2)*p(2, 1))
         do j = 1, 2
            at_torus = predict_torus(plane, here, point%unfolding, j, 1.0_wp)
            way(:, j) = [at_torus%parameters%epsilon - here%epsilon, &
                         plane%ordinate(at_torus%parameters) - plane%ordinate(here)]
         end do
         there = plane%parameters(here%epsilon + sum(way(1, :)*share), &
                                  plane%ordinate(here) + sum(way(2, :)*share))
      end associate
   end function parameters_at

   !> z q of all pairs of a point.
   function modes_of(point, z) result(mode)
      !> The point
      type(hopf_point_type), intent(in) :: point
      !> z of the pairs
      real(wp), intent(in) :: z(2)
      complex(wp) :: mode(3, 2)
      type(failure_type), allocatable :: failure
      type(block_equation_type) :: equation
      complex(wp) :: p(3), q(3)
      integer :: j

      equation = block_equation_type(point%parameters)
      mode = 0.0_wp
      do j = 1, count(point%omega > 0.0_wp)
         call critical_vectors(equation%linear, cmplx(0.0_wp, point%omega(j), kind=wp), q, p, &
                               failure)
         mode(:, j) = z(j)*q
      end do
   end function modes_of

   !> Least, mean and greatest maximum of ln v in the last 400 units of a run.
   subroutine run(parameters, omega, mode, time, least, mean, most, error)
      !> Parameters
      type(block_parameters_type), intent(in) :: parameters
      !> Frequencies of the history
      real(wp), intent(in) :: omega(2)
      !> z q of its pairs
      complex(wp), intent(in) :: mode(3, 2)
      !> Length of the run
      real(wp), intent(in) :: time
      !> Least maximum
      real(wp), intent(out) :: least
      !> Their mean
      real(wp), intent(out) :: mean
      !> Greatest maximum
      real(wp), intent(out) :: most
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      type(oscillating_block) :: block
      real(wp), allocatable :: maxima(:), values(:, :)
      integer, parameter :: samples = 20000
      integer :: i

      block%spring_block_type = spring_block_type(parameters, block_history_type())
      block%omega = omega
      block%mode = mode
      call solve(block, [(time - 0.02_wp*(samples - i), i=1, samples)], &
                 at_tolerance(1.0e-8_wp), values, error)
      if (allocated(error)) return
      associate (w => values(index_of_ln_v, :))
         allocate (maxima, source=pack(w(2:samples - 1), w(2:samples - 1) > w(1:samples - 2) &
                                       .and. w(2:samples - 1) >= w(3:samples)))
      end associate
      mean = sum(maxima)/size(maxima)
      least = minval(maxima)
      most = maxval(maxima)
   end subroutine run

   !> The state at t = 0.
   pure subroutine oscillation_at_zero(self, y)
      !> The block
      class(oscillating_block), intent(in) :: self
      !> theta, u, ln v
      real(wp), intent(out) :: y(self%n)
      integer :: i

      y = [(self%history(0.0_wp, i), i=1, 3)]
   end subroutine oscillation_at_zero

   !> The sum of the oscillations.
   pure function oscillation(self, t, component) result(value)
      !> The block
      class(oscillating_block), intent(in) :: self
      !> Time <= 0
      real(wp), intent(in) :: t
      !> Index into the state
      integer, intent(in) :: component
      real(wp) :: value

      value = 2.0_wp*sum(real(self%mode(component, :)*exp(cmplx(0.0_wp, self%omega*t, kind=wp))))
   end function oscillation
end module test_hopf_unfoldings
