! SPDX-License-Identifier: BSD-3-Clause
!> Cycles of the block as trigonometric polynomials, by collocation: for a given amplitude of the
!> first harmonic of ln v, the epsilon and the frequency that it needs.
module harmonic_balance
   use block_builder, only: by_epsilon, by_tau, index_of_ln_v
   use dde_errors, only: failure_type => error_type
   use dde_kinds, only: wp
   use expectations, only: expect, expect_success
   use hopf_normal_form, only: critical_vectors
   use lapack_algebra, only: solve
   use linear_system, only: linear_part
   use mctc_env_testing, only: error_type
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: find_cycle

   !> Harmonics, and points in a period.
   integer, parameter :: harmonics = 6, points = 2*harmonics + 1
   !> Unknowns: the coefficients of 1, cos and sin of each component, where those of cos t and sin t
   !> of ln v are given and make place for epsilon and the frequency.
   integer, parameter :: unknowns = 3*points
   !> Place of cos t and sin t among the functions.
   integer, parameter :: cosine = 2, sine = 3
   !> One turn.
   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)

contains

   !> Newton's method from the linear oscillation.
   subroutine find_cycle(block, omega, r, epsilon, frequency, error)
      !> The block on the Hopf curve, which keeps delays of 0
      class(model_type), intent(in) :: block
      !> Frequency of its pair; |z|, with the pair's eigenvector of length 1
      real(wp), intent(in) :: omega, r
      !> Epsilon at which there is this cycle, and its frequency
      real(wp), intent(out) :: epsilon, frequency
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      type(failure_type), allocatable :: failure
      complex(wp) :: answer(unknowns, 1), matrix(unknowns, unknowns), p(3), q(3)
      real(wp) :: amplitude, base(unknowns), change, moved(unknowns), x(unknowns)
      real(wp), parameter :: step = 1.0e-6_wp
      integer :: iteration, j

      call critical_vectors(linear_part(block), cmplx(0.0_wp, omega, kind=wp), q, p, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      ! the coefficient of cos t in ln v
      amplitude = 2.0_wp*abs(q(index_of_ln_v))*r
      q = q/q(index_of_ln_v)*amplitude
      x = 0.0_wp
      do j = 1, 3
         x([place(j, cosine), place(j, sine)]) = [real(q(j)), -aimag(q(j))]
      end do
      x([place(index_of_ln_v, cosine), place(index_of_ln_v, sine)]) = &
         [block%numbers(by_epsilon), omega]
      do iteration = 1, 12
         base = residual(block, amplitude, x)
         do j = 1, unknowns
            moved = x
            moved(j) = moved(j) + step
            matrix(:, j) = (residual(block, amplitude, moved) - base)/step
         end do
         call solve(matrix, reshape(cmplx(base, kind=wp), [unknowns, 1]), answer, failure)
         call expect_success(error, failure)
         if (allocated(error)) return
         x = x - real(answer(:, 1))
         change = maxval(abs(answer))
      end do
      call expect(error, change < 1.0e-11_wp, "Newton's method has converged")
      epsilon = x(place(index_of_ln_v, cosine))
      frequency = x(place(index_of_ln_v, sine))
   end subroutine find_cycle

   !> frequency x'(t) less the right-hand side at all points of a period.
   function residual(block, amplitude, x) result(value)
      class(model_type), intent(in) :: block
      real(wp), intent(in) :: amplitude, x(unknowns)
      real(wp) :: value(unknowns)
      class(model_type), allocatable :: there
      real(wp) :: coefficients(points, 3), frequency, numbers(4), slope(3), t
      integer :: i

      coefficients = reshape(x, [points, 3])
      numbers = block%numbers
      numbers(by_epsilon) = coefficients(cosine, index_of_ln_v)
      allocate (there, source=block)
      call there%put(numbers)
      frequency = x(place(index_of_ln_v, sine))
      coefficients(cosine:sine, index_of_ln_v) = [amplitude, 0.0_wp]
      do i = 1, points
         t = two_pi*i/points
         call there%rhs(0.0_wp, matmul(functions(t), coefficients), &
                        matmul(functions(t - frequency*numbers(by_tau)), &
                               coefficients(:, index_of_ln_v:index_of_ln_v)), slope)
         value(3*i - 2:3*i) = frequency*matmul(slopes(t), coefficients) - slope
      end do
   end function residual

   !> 1, cos t, sin t, cos 2t, ...
   pure function functions(t) result(values)
      real(wp), intent(in) :: t
      real(wp) :: values(points)
      integer :: k

      values = [1.0_wp, ([cos(k*t), sin(k*t)], k=1, harmonics)]
   end function functions

   !> Their derivatives.
   pure function slopes(t) result(values)
      real(wp), intent(in) :: t
      real(wp) :: values(points)
      integer :: k

      values = [0.0_wp, ([-k*sin(k*t), k*cos(k*t)], k=1, harmonics)]
   end function slopes

   !> Place of a coefficient among the unknowns.
   pure integer function place(component, number) result(value)
      integer, intent(in) :: component, number

      value = (component - 1)*points + number
   end function place
end module harmonic_balance
