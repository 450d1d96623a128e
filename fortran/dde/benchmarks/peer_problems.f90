! SPDX-License-Identifier: BSD-3-Clause
!> The problem on which solvers are compared: PROBLEM is its number, given to the compiler, so that
!> others than this solver have f in one piece, as their users write it.
module peer_problems
   use block_problem, only: block_with_jacobian, spring_block
   use dde_kinds, only: wp
   use published_problems, only: enzyme, infection, mackey_glass
   use test_problems, only: constant_past, wille_baker
   use worker_protocol, only: epsilon, gamma, past, tau, xi
   implicit none (type, external)
   private
   public :: breaking_points, problem_of, slopes

   !> Numbers of equations, of delayed values, and components that these are, of each problem: the
   !> block, enzyme, infection, mackey_glass, wille_baker. Without delay z of the block is w.
   integer, parameter :: sizes(0:4) = [3, 4, 3, 1, 3], values(0:4) = [1, 1, 2, 1, 2], &
                         components(2, 0:4) = reshape([3, 0, 4, 0, 2, 2, 1, 0, 1, 2], [2, 5])
   integer, parameter, public :: n = sizes(PROBLEM), delayed = values(PROBLEM), &
                                 component(delayed) = components(:delayed, PROBLEM)
   !> Generations of breaking points that matter up to order 5; at k delays the derivative of theta
   !> of order 2k jumps
   integer, parameter :: generations = merge(2, 5, PROBLEM == 0)

contains

   !> The problem for this solver.
   subroutine problem_of(given, problem)
      !> f, jacobian (of the block) or series: what it gives
      character(len=*), intent(in) :: given
      class(constant_past), allocatable, intent(out) :: problem
      type(block_with_jacobian) :: block

      select case (PROBLEM)
      case (0)
         block%spring_block = spring_block(tau, epsilon, xi, gamma, past)
         if (given == "f") problem = block%spring_block
         if (given /= "f") problem = block
      case (1)
         problem = enzyme()
      case (2)
         problem = infection()
      case (3)
         problem = mackey_glass()
      case default
         problem = wille_baker()
      end select
      problem%analytic = given == "series"
   end subroutine problem_of

   !> f(y, z) for other solvers: a call of the problem's own would cost a quarter of their time.
   pure subroutine slopes(y, z, f)
      real(wp), intent(in) :: y(*), z(*)
      real(wp), intent(out) :: f(*)
      real(wp) :: flow, v

      select case (PROBLEM)
      case (0)
         v = exp(y(3))
         f(1) = -v*(y(1) + (1.0_wp + epsilon)*z(1))
         f(2) = v - 1.0_wp
         f(3) = -gamma**2/v*(y(2) + (y(1) + y(3))/xi)
      case (1)
         flow = y(1)/(1.0_wp + 0.0005_wp*z(1)**3)
         f(1) = 10.5_wp - flow
         f(2) = flow - y(2)
         f(3) = y(2) - y(3)
         f(4) = y(3) - 0.5_wp*y(4)
      case (2)
         f(1) = -y(1)*z(1) + z(2)
         f(2) = y(1)*z(1) - y(2)
         f(3) = y(2) - z(2)
      case (3)
         f(1) = 0.2_wp*z(1)/(1.0_wp + z(1)**10) - 0.1_wp*y(1)
      case default
         f(1) = z(1)
         f(2) = z(1) + z(2)
         f(3) = y(2)
      end select
   end subroutine slopes

   !> Where derivatives jump that peers are told of: sums of a few delays, ascending, before a time.
   pure function breaking_points(lag, before) result(points)
      real(wp), intent(in) :: lag(:), before
      real(wp), allocatable :: points(:), sums(:)
      integer :: generation, k

      allocate (points(0))
      sums = [0.0_wp]
      do generation = 1, generations
         sums = [(sums + lag(k), k=1, size(lag))]
         points = [points, sums]
      end do
      sums = points
      points = points(:0)
      do while (any(sums < before))
         points = [points, minval(sums)]
         ! sums of the same delays in another order
         sums = pack(sums, sums > points(size(points))*(1.0_wp + 1.0e-12_wp))
      end do
   end function breaking_points
end module peer_problems
