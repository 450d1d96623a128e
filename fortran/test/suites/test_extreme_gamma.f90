!> Linear stability and Hopf curves for gamma from 1e-2 to 1e12, against Newton's method in
!> quadruple precision and the equations of infinite gamma.
module test_extreme_gamma
   use, intrinsic :: iso_fortran_env, only: real128
   use block_family, only: along_tau
   use block_equation, only: block_equation_type
   use block_parameters, only: block_parameters_type
   use characteristic_roots, only: find_roots
   use closed_form, only: closed_tau
   use dde_errors, only: failure_type => error_type, text
   use expectations, only: expect, expect_close, expect_success
   use hopf_condition, only: hopf_epsilon, hopf_tau
   use hopf_curves, only: curve_point_type, trace_curves
   use dde_kinds, only: wp
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use normal_form, only: first_lyapunov_coefficient
   use root_counts, only: roots_right_of
   use traced_planes, only: new_plane
   implicit none (type, external)
   private
   public :: collect_extreme_gamma

contains

   subroutine collect_extreme_gamma(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("roots in quadruple precision", test_quadruple), &
                   new_unittest("l1 at infinite gamma", test_coefficient), &
                   new_unittest("a narrow range of frequencies", test_narrow)]
   end subroutine collect_extreme_gamma

   !> For gamma from 1e-2 to 1e12 all roots are found. Newton's method in quadruple precision moves
   !> them in the last digits only; it takes (5) over gamma^2 as a product less its delayed term.
   subroutine test_quadruple(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(block_parameters_type) :: p
      type(block_equation_type) :: equation
      complex(wp), allocatable :: roots(:)
      real(wp), parameter :: all_tau(5) = [0.0_wp, 0.1_wp, 1.0_wp, 7.0_wp, 10.0_wp]
      real(wp), parameter :: all_xi(3) = [0.01_wp, 0.5_wp, 10.0_wp], bound = -0.02_wp
      integer :: i, j, k, m, most

      most = 0
      do k = -2, 12, 2
         do j = 1, size(all_xi)
            do i = 1, size(all_tau)
               p = block_parameters_type(tau=all_tau(i), epsilon=1.5_wp, xi=all_xi(j), &
                                         gamma=10.0_wp**k)
               equation = block_equation_type(p)
               call find_roots(equation%linear, bound, roots, failure)
               call expect_success(error, failure)
               if (allocated(error)) return
               call expect(error, size(roots) == roots_right_of(p, bound), "number of roots at " &
                           //"tau "//text(p%tau)//", xi "//text(p%xi)//", gamma "//text(p%gamma))
               do m = 1, size(roots)
                  call expect_close(error, abs(roots(m) - quadruple_root(p, roots(m))) &
                                    /abs(roots(m)), 0.0_wp, 1.0e-13_wp, "root "//text(m) &
                                    //" at tau "//text(p%tau)//", gamma "//text(p%gamma))
               end do
               most = max(most, size(roots))
            end do
         end do
      end do
            call expect(error, most > 8, "some blocks have many roots")
   end subroutine test_quadruple

   !> The root near a start in quadruple precision, rounded.
   pure complex(wp) function quadruple_root(p, start) result(root)
      type(block_parameters_type), intent(in) :: p
      complex(wp), intent(in) :: start
      complex(real128) :: delayed, s, square
      real(real128) :: inverse, tau, xi
      integer :: i

      s = start
      tau = p%tau
      xi = p%xi
      inverse = 1.0_real128/real(p%gamma, real128)**2
      do i = 1, 8
         delayed = (1.0_real128 + p%epsilon)/xi*exponential(-s*tau)
         square = s*s*inverse + s/xi + 1.0_real128
         s = s - ((s + 1.0_real128)*square - s*delayed) &
             /(square + (s + 1.0_real128)*(2.0_real128*s*inverse + 1.0_real128/xi) &
               - (1.0_real128 - s*tau)*delayed)
      end do
      root = cmplx(s, kind=wp)
   end function quadruple_root

   !> exp(z), for |z| up to 100, by its series at z/1024 and ten squares: not every compiler has the
   !> intrinsic function in quadruple precision.
   pure complex(real128) function exponential(z) result(value)
      complex(real128), intent(in) :: z
      integer :: i

      value = 1.0_real128
      do i = 20, 1, -1
         value = 1.0_real128 + value*z/(1024.0_real128*i)
      end do
      do i = 1, 10
         value = value*value
      end do
   end function exponential

   !> l1 differs from its value at infinite gamma by terms of size 1/gamma^2.
   subroutine test_coefficient(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      real(wp) :: l1(4), omega
      integer :: i, k

      do i = 1, 6
         omega = 0.3_wp*i
         do k = 1, size(l1)
            associate (gamma => 10.0_wp**(3*k))
               call first_lyapunov_coefficient(block_equation_type(block_parameters_type( &
                  tau=hopf_tau(omega, 0.5_wp, gamma, 1), xi=0.5_wp, gamma=gamma, &
                  epsilon=hopf_epsilon(omega, 0.5_wp, gamma))), omega, l1(k), failure)
            end associate
            call expect_success(error, failure)
         end do
         call expect_close(error, l1(:3), spread(l1(4), 1, 3), 1.0e-5_wp, "l1 at gamma = 1e3..1e9")
         call expect_close(error, l1(2:3), spread(l1(4), 1, 2), 1.0e-11_wp, "l1 at 1e6 and 1e9")
      end do
   end subroutine test_coefficient

   !> At gamma = 0.01 all frequencies of the window lie within 0.01 of gamma; branch 0 goes from the
   !> point without delay to the edge tau = 30.
   subroutine test_narrow(error)
      type(error_type), allocatable, intent(out) :: error
      type(failure_type), allocatable :: failure
      type(curve_point_type), allocatable :: points(:)

      call trace_curves(new_plane(along_tau, 0.01_wp, 0.5_wp, [0.0_wp, 1.5_wp, 0.0_wp, 30.0_wp]), &
                        points, failure)
      call expect_success(error, failure)
      call expect(error, size(points) > 10, "there are points")
      if (allocated(error)) return
      call expect(error, maxval(points%branch) == 0, "one branch")
      call expect_close(error, minval(points%parameters%tau), 0.0_wp, 1.0e-9_wp, "least delay")
      call expect_close(error, maxval(points%parameters%tau), 30.0_wp, 1.0e-9_wp, "longest delay")
      call expect_close(error, points%parameters%tau, &
                        closed_tau(points%omega, 0.5_wp, 0.01_wp, 0), 1.0e-9_wp, &
                        "delays in closed form")
   end subroutine test_narrow
end module test_extreme_gamma
