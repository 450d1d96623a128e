! SPDX-License-Identifier: BSD-3-Clause
!> Problems that ask for an implicit method, all but `sdisc` with exact solutions.
module stiff_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill, linear
   implicit none (type, external)
   private
   public :: exponential_decay, prothero_robinson, sdisc

   !> y_i' = rate (y_i - a_i cos t) - a_i sin t, y_i(0) = a_i: y_i = a_i cos t whatever the rate,
   !> far below 0 (Prothero and Robinson 1974), with a = 1, 0, 0, ....
   type, extends(constant_past) :: prothero_robinson
   contains
      procedure :: rhs => relax_to_cosine
   end type prothero_robinson

   !> y' = -y(t - lag) with the history exp(root t), where root = -exp(-root lag): y = exp(root t).
   type, extends(linear) :: exponential_decay
      !> Characteristic root
      real(wp) :: root = -1.0_wp
   contains
      procedure :: history => earlier_decay
   end type exponential_decay

   !> y' = 1/(1 + t^2) - rate (y + 0.8 y(t - 1) - 0.9 pi), rate 1e6, with the history arctan t: near
   !> each multiple of the delay y changes within 1/rate. From the set of test problems of RADAR5
   !> (Guglielmi and Hairer 2001, Computing 67, 1).
   type, extends(constant_past) :: sdisc
   contains
      procedure :: rhs => sdisc_rhs
      procedure :: history => arctangent
   end type sdisc

   interface sdisc
      module procedure :: new_sdisc
   end interface sdisc

   interface prothero_robinson
      module procedure :: new_prothero_robinson
   end interface prothero_robinson

   interface exponential_decay
      module procedure :: new_exponential_decay
   end interface exponential_decay

contains

   !> n equations; 1 if not given.
   pure type(prothero_robinson) function new_prothero_robinson(rate, n) result(problem)
      real(wp), intent(in) :: rate
      integer, intent(in), optional :: n

      call fill(problem, 1, [0.0_wp], [1.0_wp])
      if (present(n)) then
         call fill(problem, n, spread(0.0_wp, 1, n), [1.0_wp, spread(0.0_wp, 1, n - 1)])
      end if
      problem%rate = rate
   end function new_prothero_robinson

   !> The problem of a given delay below 1/e; its root by Newton's method.
   pure type(exponential_decay) function new_exponential_decay(lag) result(problem)
      real(wp), intent(in) :: lag
      integer :: i

      call fill(problem, 1, [1.0_wp], [1.0_wp], [lag], [1])
      do i = 1, 20
         associate (x => problem%root, e => exp(-problem%root*lag))
            x = x - (x + e)/(1.0_wp - lag*e)
         end associate
      end do
   end function new_exponential_decay

   !> One equation, from 0.
   pure type(sdisc) function new_sdisc() result(problem)
      call fill(problem, 1, first=[0.0_wp], lag=[1.0_wp], component=[1])
      problem%rate = 1.0e6_wp
   end function new_sdisc

   !> It is in balance with y + 0.8 y(t - 1) = 0.9 pi.
   pure subroutine sdisc_rhs(self, t, y, z, dydt)
      class(sdisc), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = 1.0_wp/(1.0_wp + t*t) - self%rate*(y + 0.8_wp*z - 0.9_wp*acos(-1.0_wp))
   end subroutine sdisc_rhs

   !> arctan t.
   pure function arctangent(self, t, component) result(value)
      class(sdisc), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = atan(t)
   end function arctangent

   !> rate (y - a cos t) - a sin t.
   pure subroutine relax_to_cosine(self, t, y, z, dydt)
      class(prothero_robinson), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = self%rate*(y - self%first*cos(t)) - self%first*sin(t)
   end subroutine relax_to_cosine

   !> exp(root t).
   pure function earlier_decay(self, t, component) result(value)
      class(exponential_decay), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = exp(self%root*t)
   end function earlier_decay
end module stiff_problems
