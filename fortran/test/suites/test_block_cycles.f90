!> Cycles of the block along lines, against its Hopf points and their kinds.
module test_block_cycles
   use block_cycles, only: cycle_settings_type, cycles_type, find_cycles, left_out_type
   use block_family, only: vector_of, with_vector
   use block_parameters, only: block_parameters_type
   use cycle_curves, only: cycle_curve_type, find_curves
   use cycle_lines, only: along_epsilon, along_gamma, along_tau, along_xi, cycle_line_type, &
                          find_hopf_starts, hopf_start_type
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_between, expect_close, expect_success
   use hopf_curves, only: curve_point_type
   use hopf_planes, only: curve_plane_type
   use hopf_points, only: hopf_point_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use paper_equations, only: relative_residual
   use special_points, only: fold, torus_bifurcation
   use traced_planes, only: find_points, new_plane
   implicit none (type, external)
   private
   public :: collect_block_cycles

contains

   subroutine collect_block_cycles(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("Hopf points on lines", test_hopf_starts), &
                   new_unittest("Hopf points along a law's own parameter", test_own_parameter), &
                   new_unittest("folds start at a generalised Hopf point", test_folds), &
                   new_unittest("tori start at a double Hopf point", test_tori), &
                   new_unittest("a closed branch", test_closed)]
   end subroutine collect_block_cycles

   !> They fulfil (5) and lie on the line. A line in tau through one meets it.
   subroutine test_hopf_starts(error)
      type(error_type), allocatable, intent(out) :: error
      type(cycle_line_type) :: line
      type(failure_type), allocatable :: failure
      type(hopf_start_type), allocatable :: across(:), starts(:)
      integer, parameter :: along(3) = [along_epsilon, along_xi, along_gamma]
      real(wp), parameter :: known(4) = [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp]
      real(wp), allocatable :: place(:)
      integer :: i, j

      do j = 1, size(along)
         line%along = along(j)
         line%parameters = with_vector(block_parameters_type(), known)
         line%window = [0.01_wp, 2.0_wp]
         call find_hopf_starts(line, starts, failure)
         call expect_success(error, failure)
         call expect(error, size(starts) > 0, "Hopf points")
         if (allocated(error)) return
         do i = 1, size(starts)
            associate (p => starts(i)%parameters)
               place = vector_of(p)
               call expect_between(error, place(along(j)), 0.01_wp, 2.0_wp, "window")
               place(along(j)) = known(along(j))
               call expect_close(error, place(:4), known, 1.0e-9_wp, "the line")
               call expect_close(error, relative_residual(p, cmplx(0.0_wp, starts(i)%omega, wp)), &
                                 0.0_wp, 1.0e-10_wp, "residual of (5)")
               call find_hopf_starts(cycle_line_type(along_tau, p, [0.0_wp, 20.0_wp]), across, &
                                     failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect_close(error, minval(abs(across%parameters%tau - 10.0_wp)), 0.0_wp, &
                                 1.0e-9_wp, "tau of the line across")
            end associate
         end do
      end do
   end subroutine test_hopf_starts

   !> About steady sliding the law with a cut-off is the paper's at (1 + c) xi.
   subroutine test_own_parameter(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: p
      type(failure_type), allocatable :: failure
      type(hopf_start_type), allocatable :: along_c(:), of_paper(:)
      integer :: i

      p = block_parameters_type(tau=10.0_wp, epsilon=0.5_wp, xi=0.4_wp, gamma=0.8_wp)
      call find_hopf_starts(cycle_line_type(along_xi, p, [0.4_wp, 4.0_wp]), of_paper, failure)
      call expect_success(error, failure)
      p%law = "slip_cut_off"
      call find_hopf_starts(cycle_line_type(5, p, [0.0_wp, 9.0_wp]), along_c, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, size(along_c) > 0 .and. size(along_c) == size(of_paper), "as many")
      if (allocated(error)) return
      call expect_close(error, 0.4_wp*(1.0_wp + [(along_c(i)%parameters%own(1), &
                                                  i=1, size(along_c))]), &
                        of_paper%parameters%xi, 1.0e-12_wp, "(1 + c) xi")
      call expect_close(error, along_c%omega, of_paper%omega, 1.0e-12_wp, "omega")
   end subroutine test_own_parameter

   !> The Hopf point of a kind in the plane of epsilon and tau that is nearest to a place.
   subroutine nearest_hopf_point(xi, window, kind, place, nearest, error)
      real(wp), intent(in) :: xi, window(4)
      character(len=*), intent(in) :: kind
      real(wp), intent(in) :: place(2)
      real(wp), intent(out) :: nearest(2)
      type(error_type), allocatable, intent(inout) :: error
      type(curve_point_type), allocatable :: points(:)
      type(hopf_point_type), allocatable :: found(:)
      type(curve_plane_type) :: plane
      integer :: i

      nearest = 1000.0_wp
      plane = new_plane(along_tau, 0.8_wp, xi, window)
      call find_points(plane, points, found, error)
      if (allocated(error)) return
      do i = 1, size(found)
         associate (p => found(i)%parameters)
            if (found(i)%kind == kind .and. norm2([p%epsilon, p%tau] - place) &
                < norm2(nearest - place)) nearest = [p%epsilon, p%tau]
         end associate
      end do
   end subroutine nearest_hopf_point

   !> The curves of a kind that start on a line end at the Hopf point of another kind.
   subroutine expect_end(line, window, kind, ending, error)
      type(cycle_settings_type), intent(in) :: line
      real(wp), intent(in) :: window(4)
      character(len=*), intent(in) :: kind, ending
      type(error_type), allocatable, intent(inout) :: error
      type(cycle_settings_type) :: settings
      type(cycle_curve_type), allocatable :: curves(:)
      type(cycles_type), allocatable :: found(:)
      type(left_out_type), allocatable :: left_out(:)
      type(failure_type), allocatable :: failure
      type(hopf_start_type), allocatable :: hopf(:)
      real(wp) :: known(2)
      integer :: ends, i, k

      settings = line
      settings%curve_window = reshape(window, [2, 2])
      call find_cycles(settings, hopf, found, left_out, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call find_curves(settings, found, curves, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      ends = 0
      do i = 1, size(curves)
         do k = 1, 2
            associate (part => curves(i)%parts(k))
               if (part%points(1)%kind /= kind .or. part%ending /= ending) cycle
               ends = ends + 1
               associate (last => part%points(size(part%points))%orbit%parameters)
                  call nearest_hopf_point(last(3), window, ending, [last(2), last(1)], known, error)
                  call expect_close(error, [last(2), last(1)], known, 1.0e-4_wp, "end of the curve")
               end associate
            end associate
         end do
      end do
      call expect(error, ends > 0, "a curve of kind "//kind//" with the end "//ending)
   end subroutine expect_end

   !> Where the first Lyapunov coefficient vanishes, a curve of folds of cycles begins.
   subroutine test_folds(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_end(settings_on(along_epsilon, [5.9_wp, 0.0_wp, 0.8_wp, 0.8_wp], &
                                  [0.3_wp, 0.6_wp]), &
                      [0.3_wp, 0.6_wp, 5.0_wp, 6.0_wp], fold, "generalised_hopf", error)
   end subroutine test_folds

   !> Where two pairs of roots are imaginary, a curve of torus points begins.
   subroutine test_tori(error)
      type(error_type), allocatable, intent(out) :: error

      call expect_end(settings_on(along_tau, [0.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], &
                                  [12.0_wp, 12.8_wp]), &
                      [0.4_wp, 0.6_wp, 11.5_wp, 12.8_wp], torus_bifurcation, "double_hopf", error)
   end subroutine test_tori

   !> A line without trajectories, of a coarse mesh.
   function settings_on(along, parameters, window) result(settings)
      integer, intent(in) :: along
      !> tau, epsilon, xi, gamma, and the window on the line
      real(wp), intent(in) :: parameters(4), window(2)
      type(cycle_settings_type) :: settings

      settings%line = cycle_line_type(along, with_vector(block_parameters_type(), parameters), &
                                      window)
      allocate (settings%starts(0), settings%start_v(0))
      settings%degree = 5
      settings%intervals = 20
      settings%most_orbits = 40
   end function settings_on

   !> Cycles of three maxima exist between two folds: their branch is closed and is found once.
   subroutine test_closed(error)
      type(error_type), allocatable, intent(out) :: error
      type(cycle_settings_type) :: settings
      type(cycles_type), allocatable :: found(:)
      type(left_out_type), allocatable :: left_out(:)
      type(failure_type), allocatable :: failure
      type(hopf_start_type), allocatable :: hopf(:)

      settings%line = cycle_line_type(along_tau, &
                                      block_parameters_type(0.0_wp, 0.7_wp, 0.5_wp, 0.8_wp), &
                                      [4.8_wp, 5.2_wp])
      settings%starts = [5.0_wp, 5.0_wp]
      settings%start_v = [1.1_wp, 1.1_wp]
      settings%most_orbits = 100
      call find_cycles(settings, hopf, found, left_out, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, size(hopf) == 0, "no Hopf point")
      call expect(error, size(found) == 1, "one branch")
      if (allocated(error)) return
      call expect(error, found(1)%branch%ending == "closed", "a closed branch")
      call expect(error, size(found(1)%points) == 2, "two special points")
      if (allocated(error)) return
      call expect(error, all(found(1)%points%kind == fold), "two folds")
      call expect(error, size(left_out) == 1, "the second start is named")
      if (allocated(error)) return
      call expect(error, left_out(1)%reason == "its cycle is on a branch", "and why")
      call expect_close(error, left_out(1)%at, 5.0_wp, 0.0_wp, "and where")
   end subroutine test_closed
end module test_block_cycles
