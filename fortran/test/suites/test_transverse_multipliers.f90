!> Exponents of modes along cycles by multipliers, against the block's own multipliers, against
!> characteristic roots, and against exponents along the motion.
module test_transverse_multipliers
   use block_family, only: transverse_family_type, vector_of
   use block_parameters, only: block_history_type, block_parameters_type, with_vector
   use block_roots, only: roots_of_block
   use collocation_basis, only: radau_points
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use floquet_multipliers, only: find_largest_multiplier, find_multipliers, multipliers_type
   use lyapunov_spectrum, only: growth_settings_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use orbit_runs, only: cycle_of_block, fix_parameters, new_orbit
   use periodic_orbit, only: periodic_orbit_type
   use solving, only: at_tolerance
   use spring_block, only: spring_block_type
   use transverse_growth, only: find_zeros, measure_transverse_growth, transverse_growth_type, &
                                zero_type
   use transverse_multipliers, only: find_transverse_cycle, transverse_cycle_type
   implicit none (type, external)
   private
   public :: collect_transverse_multipliers

   !> The paper's torus, a cycle; chaos; steady sliding.
   type(block_parameters_type), parameter :: &
      cycle_place = block_parameters_type(tau=10.0_wp, epsilon=0.5_wp, xi=0.8_wp, gamma=0.8_wp), &
      chaos_place = block_parameters_type(tau=7.0_wp, epsilon=0.7_wp, xi=0.5_wp, gamma=0.8_wp), &
      rest_place = block_parameters_type(tau=7.0_wp, epsilon=0.1_wp, xi=0.5_wp, gamma=0.8_wp)
   !> Values for t <= 0.
   type(block_history_type), parameter :: start = block_history_type(v=1.1_wp)

contains

   subroutine collect_transverse_multipliers(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("s = 1 is the block", test_block), &
                   new_unittest("modes about rest are blocks", test_rest), &
                   new_unittest("multipliers and exponents of modes", test_exponents), &
                   new_unittest("motions that are no cycle", test_no_cycle)]
   end subroutine collect_transverse_multipliers

   !> At s = 1 the multipliers are those of the block, whose Jacobian is no band.
   subroutine test_block(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(multipliers_type) :: found, own
      type(periodic_orbit_type) :: orbit
      integer :: i

      call cycle_of_block(spring_block_type(cycle_place, start), 1500.0_wp, 5, radau_points, 40, &
                          orbit, own, error)
      if (allocated(error)) return
      call find_multipliers(fix_parameters(transverse_family_type(cycle_place, 0.0_wp)), orbit, 6, &
                            found, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect_close(error, abs(found%values - own%values), [(0.0_wp, i=1, size(own%values))], &
                        1.0e-11_wp, "multipliers")
   end subroutine test_block

   !> About rest a mode is a block at gamma sqrt(s) and xi s: the exponent of a cycle that rests is
   !> the real part of the rightmost root there.
   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: place
      type(failure_type), allocatable :: failure
      type(periodic_orbit_type) :: orbit
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: delays(3) = [7.0_wp, 2.0_wp, 0.0_wp], &
                             stiffness(3) = [1.0_wp, 1.3_wp, 5.0_wp], period = 6.0_wp
      real(wp) :: modulus
      integer :: i, j

      do i = 1, size(delays)
         place = chaos_place
         place%tau = delays(i)
         do j = 1, size(stiffness)
            orbit = new_orbit(6, radau_points, 30, period, vector_of(place))
            allocate (orbit%nodes(3, 30*6 + 1), source=0.0_wp)
            associate (s => stiffness(j))
               call find_largest_multiplier(fix_parameters(transverse_family_type(place, &
                                                                                  s - 1.0_wp)), &
                                            orbit, modulus, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call roots_of_block(with_vector(place, [place%tau, place%epsilon, place%xi*s, &
                                                       place%gamma*sqrt(s)]), -0.5_wp, roots, &
                                   failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect_close(error, log(modulus)/period, real(roots(1)), 1.0e-9_wp, "exponent")
            end associate
         end do
      end do
   end subroutine test_rest

   !> The exponents and their zero are those measured along the motion.
   subroutine test_exponents(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(growth_settings_type) :: settings
      type(transverse_cycle_type) :: found
      type(transverse_growth_type), allocatable :: growth(:)
      type(zero_type), allocatable :: zeros(:)
      real(wp), parameter :: s(3) = [1.0_wp, 1.2_wp, 2.0_wp]
      integer :: i

      settings = growth_settings_type(t_begin=1000.0_wp, t_end=3000.0_wp, t_turning=300.0_wp, &
                                      interval=20.0_wp, blocks=10)
      call measure_transverse_growth(cycle_place, start, s, settings, at_tolerance(1.0e-8_wp), &
                                     growth, failure)
      call expect_success(error, failure)
      call find_zeros(cycle_place, start, settings, at_tolerance(1.0e-8_wp), growth, zeros, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call find_transverse_cycle(cycle_place, start, 2000.0_wp, at_tolerance(1.0e-8_wp), s, found)
      call expect(error, found%reason == "", "a cycle: "//found%reason)
      if (allocated(error)) return
      call expect(error, abs(found%growth(1)%value) <= 0.0_wp, "the flow at s = 1")
      call expect_close(error, found%growth%s, s, 0.0_wp, "s")
      do i = 1, size(s)
         call expect_close(error, found%growth(i)%value, growth(i)%value, 3.0_wp*growth(i)%error, &
                           "exponent")
      end do
      call expect_close(error, growth%error, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-3_wp, "their errors")
      call expect_close(error, found%growth%error, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-10_wp, "meshes")
      call expect(error, size(found%zeros) == 1 .and. size(zeros) == 1, "one zero each")
      if (allocated(error)) return
      call expect_close(error, found%zeros(1)%s, zeros(1)%s, 3.0_wp*zeros(1)%error, "zero")
      call expect(error, zeros(1)%error < 1.0e-3_wp, "accuracy of the zero")
      call expect(error, .not. (found%zeros(1)%rises .or. zeros(1)%rises), "its direction")
   end subroutine test_exponents

   !> They have no exponents, and the reason is given.
   subroutine test_no_cycle(error)
      type(error_type), allocatable, intent(out) :: error
      type(transverse_cycle_type) :: found
      real(wp), parameter :: s(2) = [1.0_wp, 2.0_wp]

      call find_transverse_cycle(chaos_place, start, 600.0_wp, at_tolerance(1.0e-8_wp), s, found)
      call expect(error, found%reason /= "" .and. size(found%growth) == 0, "chaos")
      call find_transverse_cycle(rest_place, start, 600.0_wp, at_tolerance(1.0e-8_wp), s, found)
      call expect(error, found%reason /= "" .and. size(found%zeros) == 0, "rest")
   end subroutine test_no_cycle
end module test_transverse_multipliers
