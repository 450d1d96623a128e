! SPDX-License-Identifier: BSD-3-Clause
!> Problems whose delays depend on t or y, on which solvers are compared (peer_problems.f90): the
!> thresholds of Waltman (1978, "A threshold model of antigen-stimulated antibody production",
!> Theoretical Immunology 8, 437; RADAR5's example), Paul (1992, see moving_problems.f90 of the
!> solver's tests), and the pantograph y' = 0.7 y(t/2) - y.
module moving_peers
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: delayed_time, derivatives, moving_slopes, new_peer

   integer, parameter, public :: waltman = 5, paul = 6, pantograph = 7
   !> The times at which Waltman's f jumps
   real(wp), parameter, public :: switch_on(2) = [35.0_wp, 197.0_wp]
   !> Largest values of his states up to t = 300, and absolute tolerances at the tolerance 1, as in
   !> the example: antibodies begin at 1e-15
   real(wp), parameter, public :: largest(6) = [5.0e-6_wp, 3.4e-7_wp, 4.3e-7_wp, 2.5e-6_wp, &
                                                300.0_wp, 300.0_wp], &
                                  least_absolute(6) = [spread(1.0e-12_wp, 1, 4), 1.0_wp, 1.0_wp]
   !> Entries of the derivatives by z that are not 0, by row
   integer, parameter, public :: filled(2, 9) = reshape([2, 1, 2, 2, 5, 1, 5, 2, 5, 3, 4, 4, 4, 5, &
                                                         6, 5, 6, 6], [2, 9])
   ! Waltman's parameters, and the constant of his second threshold, 0 in the example of RADAR5
   real(wp), parameter :: alpha = 1.8_wp, beta = 20.0_wp, gamma = 0.002_wp, r = 5.0e4_wp, &
                          s = 1.0e5_wp, least = 1.0e-12_wp
   !> What stands for the logarithm of states of Paul's problem that iterations try
   real(wp), parameter :: least_state = exp(-50.0_wp)

   !> One of them for this solver.
   type, extends(constant_past) :: moving_peer
      logical :: gives_jacobian = .false.
   contains
      procedure :: rhs, moving_lags, jacobian
   end type moving_peer

contains

   !> The problem of number PROBLEM.
   type(moving_peer) function new_peer(n, component, gives_jacobian) result(problem)
      integer, intent(in) :: n, component(:)
      logical, intent(in) :: gives_jacobian
      real(wp) :: first(n)

      first = 1.0_wp
      if (PROBLEM == waltman) first = [5.0e-6_wp, 1.0e-15_wp, spread(0.0_wp, 1, n - 2)]
      call fill(problem, n, first, first, spread(huge(1.0_wp), 1, size(component)), component)
      problem%moving = size(component)
      problem%gives_jacobian = gives_jacobian
   end function new_peer

   !> f(t, y, z).
   pure subroutine moving_slopes(t, y, z, f)
      real(wp), intent(in) :: t, y(*), z(*)
      real(wp), intent(out) :: f(*)

      select case (PROBLEM)
      case (waltman)
         f(3) = r*y(1)*y(2)
         f(1) = -f(3) - s*y(1)*y(4)
         f(2) = -f(3)
         f(4) = -s*y(1)*y(4) - gamma*y(4)
         f(5:6) = 0.0_wp
         if (t >= switch_on(1)) then
            f(2) = f(2) + alpha*r*z(1)*z(2)
            f(5) = (y(1)*y(2) + y(3))/(z(1)*z(2) + z(3))
         end if
         if (t >= switch_on(2)) then
            f(4) = f(4) + beta*r*z(4)*z(5)
            f(6) = (least + y(2) + y(3))/(least + z(5) + z(6))
         end if
      case (paul)
         f(1) = y(1)*z(1)/(t + 1.0_wp)
      case default
         f(1) = 0.7_wp*z(1) - y(1)
      end select
   end subroutine moving_slopes

   !> The time that a delay leads to.
   pure real(wp) function delayed_time(delay, t, y) result(time)
      integer, intent(in) :: delay
      real(wp), intent(in) :: t, y(*)

      select case (PROBLEM)
      case (waltman)
         time = y(4 + delay)
      case (paul)
         time = log(max(least_state, y(1))) - 1.0_wp
      case default
         time = 0.5_wp*t
      end select
   end function delayed_time

   !> Derivatives of f by y and z.
   pure subroutine derivatives(t, y, z, by_y, by_z)
      real(wp), intent(in) :: t, y(:), z(:)
      real(wp), intent(out) :: by_y(:, :), by_z(:, :)
      real(wp) :: past

      by_y = 0.0_wp
      by_z = 0.0_wp
      select case (PROBLEM)
      case (waltman)
         by_y(3, 1:2) = r*[y(2), y(1)]
         by_y(2, 1:2) = -by_y(3, 1:2)
         by_y(4, [1, 4]) = -s*[y(4), y(1)]
         by_y(1, :) = by_y(2, :) + by_y(4, :)
         by_y(4, 4) = by_y(4, 4) - gamma
         if (t >= switch_on(1)) then
            past = z(1)*z(2) + z(3)
            by_z(2, 1:2) = alpha*r*[z(2), z(1)]
            by_y(5, 1:3) = [y(2), y(1), 1.0_wp]/past
            by_z(5, 1:3) = -(y(1)*y(2) + y(3))/past**2*[z(2), z(1), 1.0_wp]
         end if
         if (t >= switch_on(2)) then
            past = least + z(5) + z(6)
            by_z(4, 4:5) = beta*r*[z(5), z(4)]
            by_y(6, 2:3) = 1.0_wp/past
            by_z(6, 5:6) = -(least + y(2) + y(3))/past**2
         end if
      case (paul)
         by_y(1, 1) = z(1)/(t + 1.0_wp)
         by_z(1, 1) = y(1)/(t + 1.0_wp)
      case default
         by_y(1, 1) = -1.0_wp
         by_z(1, 1) = 0.7_wp
      end select
   end subroutine derivatives

   pure subroutine rhs(self, t, y, z, dydt)
      class(moving_peer), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      call moving_slopes(t, y, z, dydt)
   end subroutine rhs

   pure subroutine moving_lags(self, t, y, lag)
      class(moving_peer), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp), intent(out) :: lag(self%moving)
      integer :: k

      do k = 1, size(lag)
         lag(k) = t - delayed_time((k + 2)/3, t, y)
      end do
   end subroutine moving_lags

   pure subroutine jacobian(self, t, y, z, by_y, by_z)
      class(moving_peer), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)

      if (self%gives_jacobian) then
         call derivatives(t, y, z, by_y, by_z)
      else
         call self%constant_past%jacobian(t, y, z, by_y, by_z)
      end if
   end subroutine jacobian
end module moving_peers
