! SPDX-License-Identifier: BSD-3-Clause
!> The problem on which solvers are compared: PROBLEM is its number, given to the compiler, so that
!> others than this solver have f in one piece, as their users write it.
module peer_problems
   use block_problem, only: block_with_jacobian, spring_block
   use dde_kinds, only: wp
   use moving_peers, only: largest, least_absolute, moving_slopes, new_peer, pantograph, &
                           switch_on, waltman
   use published_problems, only: enzyme, infection, mackey_glass
   use sizes_problem, only: cells_with_jacobian
   use test_problems, only: constant_past, wille_baker
   use worker_protocol, only: parameters, read_task, t_end
   implicit none (type, external)
   private
   public :: history, prepare, slopes

   !> Numbers of equations, of delayed values, and components that these are, of each problem: the
   !> block, enzyme, infection, mackey_glass, wille_baker, those of moving_peers; cells are for this
   !> solver alone. Without delay z of the block is w.
   integer, parameter :: sizes(0:8) = [3, 4, 3, 1, 3, 6, 1, 1, 0], &
                         values(0:8) = [1, 1, 2, 1, 2, 6, 1, 1, 0], &
                         components(16) = [3, 4, 2, 2, 1, 1, 2, 1, 2, 3, 1, 2, 3, 1, 1, 0], &
                         before = sum(values(:PROBLEM)) - values(PROBLEM)
   integer, parameter, public :: n = sizes(PROBLEM), delayed = values(PROBLEM)
   integer :: k
   integer, parameter, public :: component(delayed) = components(before + 1:before + delayed)
   !> Whether delays move, and number of the delay of each value: Waltman's has two of three values
   logical, parameter, public :: moves = PROBLEM >= waltman .and. PROBLEM <= pantograph
   integer, parameter, public :: delay_of(delayed) = [(merge((k + 2)/3, k, moves), k=1, delayed)]
   !> Generations of breaking points that matter up to order 5; at k delays the derivative of theta
   !> of order 2k jumps
   integer, parameter :: generations = merge(2, 5, PROBLEM == 0)
   !> The problem for this solver
   class(constant_past), allocatable, public, protected :: problem
   !> For others: parameters of the block, the delays, and where derivatives jump
   real(wp), public, protected :: epsilon = 0.0_wp, xi = 0.0_wp, gamma = 0.0_wp, lags(delayed)
   integer, public, protected :: delays
   real(wp), allocatable, public, protected :: breaks(:)
   !> Units of errors, and absolute tolerances at the tolerance 1: Waltman's states differ in size
   real(wp), public, protected :: units(n), finest(n)
   real(wp) :: past(n)

contains

   !> Read the task.
   subroutine prepare(given)
      !> f, jacobian (of the block and of cells) or series: what the problem gives
      character(len=*), intent(in) :: given
      type(block_with_jacobian) :: block
      type(cells_with_jacobian) :: row

      call read_task()
      select case (PROBLEM)
      case (0)
         ! tau, epsilon, xi, gamma, then theta, u and w for t <= 0
         epsilon = parameters(2)
         xi = parameters(3)
         gamma = parameters(4)
         block%spring_block = spring_block(parameters(1), epsilon, xi, gamma, parameters(5:7))
         if (given == "f") problem = block%spring_block
         if (given /= "f") problem = block
      case (1)
         problem = enzyme()
      case (2)
         problem = infection()
      case (3)
         problem = mackey_glass()
      case (4)
         problem = wille_baker()
      case (waltman:pantograph)
         problem = new_peer(n, component, given /= "f")
      case default
         ! numbers of equations and delays, the longest delay less the shortest
         call row%set_up(nint(parameters(1)), nint(parameters(2)), parameters(3))
         if (given /= "jacobian") problem = row%cells
         if (given == "jacobian") problem = row
      end select
      problem%analytic = given == "series"
      units = 1.0_wp
      finest = 1.0_wp
      if (PROBLEM == waltman) then
         units = largest(:n)
         finest = least_absolute(:n)
      end if
      delays = size(problem%lag)
      if (delays > delayed) return
      lags(:delays) = problem%lag
      past = problem%past
      breaks = breaking_points(problem%lag, t_end)
      if (.not. moves) return
      delays = delay_of(delayed)
      breaks = pack(switch_on, PROBLEM == waltman)
   end subroutine prepare

   !> f(t, y, z) for other solvers: a call of the problem's own would cost a quarter of their time.
   pure subroutine slopes(t, y, z, f)
      real(wp), intent(in) :: t, y(*), z(*)
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
      case (waltman:pantograph)
         call moving_slopes(t, y, z, f)
      case default
         f(1) = z(1)
         f(2) = z(1) + z(2)
         f(3) = y(2)
      end select
   end subroutine slopes

   !> The constant past, for others.
   function history(component, t, rpar, ipar) result(value)
      integer, intent(in) :: component, ipar(*)
      real(wp), intent(in) :: t, rpar(*)
      real(wp) :: value

      value = past(component)
   end function history

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
