! SPDX-License-Identifier: BSD-3-Clause
!> Problems whose delays depend on time or state, most with exact solutions: of Neves (1975,
!> "Automatic integration of functional differential equations: an approach", ACM Trans. Math.
!> Softw. 1, 357), Feldstein and Neves (1984, "High order methods for state-dependent delay
!> differential equations with nonsmooth solutions", SIAM J. Numer. Anal. 21, 844), Paul (1992,
!> "Developing a delay differential equation solver", Appl. Numer. Math. 9, 403; 1994, "A test set
!> of functional differential equations", Manchester, problem 1.3.10), Enright and Hayashi (1997,
!> "The evaluation of numerical software for delay differential equations", problem D1), and of Fox,
!> Mayers, Ockendon and Tayler (1971, "On a functional differential equation", J. Inst. Maths
!> Applics 8, 271), the pantograph.
module moving_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, fill
   implicit none (type, external)
   private
   public :: in_disguise, moving_problem, named

   abstract interface
      !> Delays of parameters p.
      pure subroutine lags_interface(p, t, y, lag)
         import :: wp
         implicit none (type, external)
         real(wp), intent(in) :: p(:), t, y(:)
         real(wp), intent(out) :: lag(:)
      end subroutine lags_interface
   end interface

   !> Iterations may try states for which functions overflow.
   real(wp), parameter :: least_log = 50.0_wp

   !> A problem with delays that move.
   type, extends(constant_past) :: moving_problem
      !> Initial time, and the end up to which the solution is known
      real(wp) :: t_start = 0.0_wp, t_end = 0.0_wp
      procedure(lags_interface), pointer, nopass :: lags => null()
   contains
      procedure :: moving_lags
   end type moving_problem

contains

   !> One of the problems.
   function named(name) result(problem)
      character(len=*), intent(in) :: name
      type(moving_problem) :: problem
      real(wp) :: start(2)

      call fill(problem, 1, first=[1.0_wp], lag=[huge(1.0_wp)], component=[1])
      problem%moving = 1
      select case (name)
      case ("Neves")
         problem%t_start = 0.1_wp
         problem%t_end = 10.0_wp
         problem%first = [log(0.1_wp)]
         problem%f => one_less_the_past
         problem%lags => to_exponential
         problem%exact => logarithm
      case ("Enright and Hayashi D1")
         problem%t_start = 0.1_wp
         problem%t_end = 5.0_wp
         call logarithm(problem%p, 0.1_wp, start)
         call fill(problem, 2, first=start, component=[2])
         problem%f => slope_and_square
         problem%lags => to_exponential_of_state
         problem%exact => logarithm
      case ("Feldstein and Neves")
         problem%t_start = 1.0_wp
         problem%t_end = 5.0_wp
         problem%past = [1.0_wp]
         problem%f => past_over_root
         problem%lags => to_state_less_root
         problem%exact => roots
      case ("Paul 1992")
         problem%t_end = 10.0_wp
         problem%past = [1.0_wp]
         problem%f => growth_by_past
         problem%lags => to_logarithm_of_state
         problem%exact => three_pieces
      case ("Paul 1.3.10")
         problem%t_start = 2.0_wp
         problem%t_end = 5.5_wp
         problem%past = [0.5_wp]
         problem%f => the_past
         problem%lags => to_state
         problem%exact => three_pieces_of_jump
      case ("pantograph")
         problem%t_end = 2.0_wp
         problem%past = [1.0_wp]
         problem%p = [0.7_wp, -1.0_wp]
         problem%f => past_and_present
         problem%lags => half
         problem%exact => pantograph_series
      case ("pantograph from 1")
         problem%t_start = 1.0_wp
         problem%t_end = 4.0_wp
         problem%p = [0.7_wp, -1.0_wp]
         call pantograph_series(problem%p, 1.0_wp, problem%first)
         problem%f => past_and_present
         problem%lags => half
         problem%exact => pantograph_series
      case ("stiff sine")
         ! the second parameter times the delay, 1000 or more, is no limit of its steps
         problem%t_end = 10.0_wp
         problem%p = [1.0e6_wp, 1.0e5_wp]
         problem%first = [0.0_wp]
         problem%f => towards_sine
         problem%lags => square_of_state
         problem%exact => sine_of_time
      case ("two thresholds")
         ! no known solution; many kinks, of two delays that move and a constant one
         problem%t_end = 10.0_wp
         call fill(problem, 2, [1.0_wp, 1.0_wp], [1.0_wp, 0.5_wp], [1.0_wp, 3.0_wp, 3.0_wp], &
                   [1, 2, 1])
         problem%moving = 2
         problem%f => coupled
         problem%lags => of_state_and_time
      case ("reader")
         problem%t_end = 10.0_wp
         problem%first = [-0.5_wp]
         problem%f => five_less_the_past
         problem%lags => two_and_square
         problem%exact => two_levels
      case ("below zero")
         problem%t_end = 2.0_wp
         problem%past = [1.0_wp]
         problem%f => less_the_past
         problem%lags => one_less_time
      case default
         ! "whole numbers"
         problem%t_end = 3.5_wp
         problem%past = [1.0_wp]
         problem%f => the_past
         problem%lags => since_whole_number
         problem%exact => doubled
      end select
   end function named

   !> A problem with constant delays, given as delays that move from number `first` on.
   function in_disguise(problem, first) result(disguised)
      class(constant_past), intent(in) :: problem
      integer, intent(in) :: first
      type(moving_problem) :: disguised

      call fill(disguised, problem%n, problem%past, problem%first, problem%lag, problem%component, &
                [problem%p, problem%lag(first:)])
      disguised%f => problem%f
      disguised%exact => problem%exact
      disguised%lags => last_parameters
      disguised%moving = size(problem%lag) - first + 1
      disguised%lag(first:) = 2.0_wp*problem%lag(first:)
   end function in_disguise

   pure subroutine moving_lags(self, t, y, lag)
      class(moving_problem), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp), intent(out) :: lag(self%moving)

      call self%lags(self%p, t, y, lag)
   end subroutine moving_lags

   pure subroutine last_parameters(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = p(size(p) - size(lag) + 1:)
   end subroutine last_parameters

   pure subroutine one_less_the_past(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = 1.0_wp - z
   end subroutine one_less_the_past

   pure subroutine to_exponential(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = t - exp(1.0_wp - 1.0_wp/t)
   end subroutine to_exponential

   !> log t and its slope.
   pure subroutine logarithm(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = 1.0_wp/t
      y(1) = log(t)
   end subroutine logarithm

   pure subroutine slope_and_square(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = [y(2), -z(1)*y(2)**2*exp(1.0_wp - max(-least_log, y(2)))]
   end subroutine slope_and_square

   pure subroutine to_exponential_of_state(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = t - exp(1.0_wp - max(-least_log, y(2)))
   end subroutine to_exponential_of_state

   pure subroutine past_over_root(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = 0.5_wp*z/sqrt(t)
   end subroutine past_over_root

   pure subroutine to_state_less_root(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = t - (y(1) - sqrt(2.0_wp) + 1.0_wp)
   end subroutine to_state_less_root

   pure subroutine roots(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = sqrt(t)
      if (t > 2.0_wp) y = 0.25_wp*t + 0.5_wp + (1.0_wp - sqrt(0.5_wp))*sqrt(t)
   end subroutine roots

   pure subroutine growth_by_past(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = y*z/(t + 1.0_wp)
   end subroutine growth_by_past

   pure subroutine to_logarithm_of_state(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = t + 1.0_wp - log(max(exp(-least_log), y(1)))
   end subroutine to_logarithm_of_state

   pure subroutine three_pieces(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)
      real(wp), parameter :: e = exp(1.0_wp)

      y = t + 1.0_wp
      if (t > e - 1.0_wp) y = exp((t + 1.0_wp)/e)
      if (t > e**2 - 1.0_wp) y = (e/(3.0_wp - log(t + 1.0_wp)))**e
   end subroutine three_pieces

   pure subroutine the_past(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = z
   end subroutine the_past

   pure subroutine to_state(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = t - y(1)
   end subroutine to_state

   pure subroutine three_pieces_of_jump(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)
      real(wp), parameter :: last = 4.0_wp + 2.0_wp*log(2.0_wp)

      y = 0.5_wp*t
      if (t > 4.0_wp) y = 2.0_wp*exp(0.5_wp*t - 2.0_wp)
      if (t > last) y = 4.0_wp - 2.0_wp*log(1.0_wp + last - t)
   end subroutine three_pieces_of_jump

   pure subroutine past_and_present(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = p(1)*z + p(2)*y
   end subroutine past_and_present

   pure subroutine half(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = 0.5_wp*t
   end subroutine half

   !> Coefficient n + 1 is (a 2**-n + b)/(n + 1) times coefficient n.
   pure subroutine pantograph_series(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)
      real(wp) :: term
      integer :: n

      y = 1.0_wp
      term = 1.0_wp
      do n = 0, 80
         term = term*t*(p(1)*0.5_wp**n + p(2))/(n + 1)
         y = y + term
      end do
   end subroutine pantograph_series

   pure subroutine towards_sine(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)
      real(wp) :: lag(1)

      call square_of_state(p, t, y, lag)
      f = cos(t) - p(1)*(y - sin(t)) + p(2)*(z - sin(t - lag))
   end subroutine towards_sine

   pure subroutine square_of_state(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = 0.01_wp*(1.0_wp + y(1)**2)
   end subroutine square_of_state

   pure subroutine sine_of_time(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = sin(t)
   end subroutine sine_of_time

   pure subroutine coupled(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = [y(2) - 0.3_wp*z(2), -z(1) - 0.2_wp*z(3)]
   end subroutine coupled

   pure subroutine of_state_and_time(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = [1.0_wp + 0.3_wp*sin(y(1)), 0.5_wp + 0.4_wp*cos(t)]
   end subroutine of_state_and_time

   pure subroutine five_less_the_past(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = 5.0_wp - z
   end subroutine five_less_the_past

   pure subroutine two_and_square(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = 2.0_wp + y(1)**2
   end subroutine two_and_square

   !> The history, up to -1 and from there on.
   pure subroutine two_levels(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = merge(4.5_wp, -0.5_wp, t < -1.0_wp)
   end subroutine two_levels

   pure subroutine less_the_past(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = -z
   end subroutine less_the_past

   pure subroutine one_less_time(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = 1.0_wp - t
   end subroutine one_less_time

   pure subroutine since_whole_number(p, t, y, lag)
      real(wp), intent(in) :: p(:), t, y(:)
      real(wp), intent(out) :: lag(:)

      lag = t - floor(t)
   end subroutine since_whole_number

   !> y' = y(n) from each whole number n on: twice as large at the next.
   pure subroutine doubled(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = 2.0_wp**floor(t)*(1.0_wp + t - floor(t))
   end subroutine doubled
end module moving_problems
