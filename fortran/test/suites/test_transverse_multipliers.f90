! SPDX-License-Identifier: BSD-3-Clause
!> Exponents of modes along cycles by multipliers, against the block's own multipliers, against
!> characteristic roots, and against exponents along the motion.
module test_transverse_multipliers
   use block_builder, only: block_at, build_block, paper_law
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use floquet_multipliers, only: multipliers_type
   use lyapunov_spectrum, only: growth_settings_type
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use model_problem, only: model_type
   use model_roots, only: find_model_roots
   use orbit_runs, only: cycle_of_block, multipliers_of, new_orbit
   use periodic_orbit, only: periodic_orbit_type
   use solving, only: at_tolerance
   use transverse_growth, only: find_zeros, measure_transverse_growth, of_mode, &
                                transverse_growth_type, zero_type
   use transverse_multipliers, only: find_transverse_cycle, transverse_cycle_type
   implicit none (type, external)
   private
   public :: collect_transverse_multipliers

   !> tau, epsilon, xi and gamma: the paper's torus, a cycle; chaos; steady sliding.
   real(wp), parameter :: cycle_place(4) = [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], &
                          chaos_place(4) = [7.0_wp, 0.7_wp, 0.5_wp, 0.8_wp], &
                          rest_place(4) = [7.0_wp, 0.1_wp, 0.5_wp, 0.8_wp]

contains

   subroutine collect_transverse_multipliers(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("s = 1 is the block", test_block), &
                   new_unittest("modes about rest are blocks", test_rest), &
                   new_unittest("multipliers and exponents of modes", test_exponents), &
                   new_unittest("motions that are no cycle", test_no_cycle)]
   end subroutine collect_transverse_multipliers

   !> A chain of one block with kappa = 1.
   type(model_type) function chain_at(place, keep_delays) result(model)
      real(wp), intent(in) :: place(4)
      logical, intent(in), optional :: keep_delays

      model = build_block(place(1), place(2), place(3), place(4), v=1.1_wp, &
                          law="chain_"//paper_law, own=[1.0_wp], keep_delays=keep_delays)
   end function chain_at

   !> At s = 1 the multipliers are those of the block, whose Jacobian is no band.
   subroutine test_block(error)
      type(error_type), allocatable, intent(out) :: error
      type(multipliers_type) :: found, own
      type(periodic_orbit_type) :: orbit
      integer :: i

      associate (p => cycle_place)
         call cycle_of_block(build_block(p(1), p(2), p(3), p(4), v=1.1_wp), 1500.0_wp, 5, 40, &
                             orbit, own, error)
      end associate
      if (allocated(error)) return
      orbit%parameters = [orbit%parameters, 1.0_wp]
      call multipliers_of(chain_at(cycle_place), orbit, 6, found, error)
      if (allocated(error)) return
      call expect_close(error, abs(found%values - own%values), [(0.0_wp, i=1, size(own%values))], &
                        1.0e-11_wp, "multipliers")
   end subroutine test_block

   !> About rest a mode is a block at gamma sqrt(s) and xi s: the exponent of a cycle that rests is
   !> the real part of the rightmost root there.
   subroutine test_rest(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(model_type) :: chain
      type(multipliers_type) :: found
      type(periodic_orbit_type) :: orbit
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: delays(3) = [7.0_wp, 2.0_wp, 0.0_wp], &
                             stiffness(3) = [1.0_wp, 1.3_wp, 5.0_wp], period = 6.0_wp
      integer :: i, j

      do i = 1, size(delays)
         chain = chain_at([delays(i), chaos_place(2:)], keep_delays=.true.)
         orbit = new_orbit(6, 30, period, chain%numbers)
         allocate (orbit%nodes(3, 30*6 + 1), source=0.0_wp)
         do j = 1, size(stiffness)
            associate (s => stiffness(j), p => chain%numbers)
               call multipliers_of(of_mode(chain, s), orbit, 0, found, error)
               if (allocated(error)) return
               call find_model_roots(block_at([p(1), p(2), s*p(3), sqrt(s)*p(4)]), -0.5_wp, roots, &
                                     failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect_close(error, log(found%greatest)/period, real(roots(1)), 1.0e-9_wp, &
                                 "exponent")
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
      call measure_transverse_growth(chain_at(cycle_place), s, settings, at_tolerance(1.0e-8_wp), &
                                     growth, failure)
      call expect_success(error, failure)
      call find_zeros(chain_at(cycle_place), settings, at_tolerance(1.0e-8_wp), growth, zeros, &
                      failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call find_transverse_cycle(chain_at(cycle_place), 2000.0_wp, at_tolerance(1.0e-8_wp), s, &
                                 found)
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

      call find_transverse_cycle(chain_at(chaos_place), 600.0_wp, at_tolerance(1.0e-8_wp), s, found)
      call expect(error, found%reason /= "" .and. size(found%growth) == 0, "chaos")
      call find_transverse_cycle(chain_at(rest_place), 600.0_wp, at_tolerance(1.0e-8_wp), s, found)
      call expect(error, found%reason /= "" .and. size(found%zeros) == 0, "rest")
   end subroutine test_no_cycle
end module test_transverse_multipliers
