! SPDX-License-Identifier: BSD-3-Clause
!> The normal form on the centre manifold of a delay equation with one or more pairs of imaginary
!> roots, to any order (Kuznetsov 2004, sections 8.6 and 8.7; for delay equations Janssens 2010).
!>
!> Pair i has the modes 2 i - 1 and 2 i with the roots s_j = i omega and -i omega. On the manifold
!> the history and the flow are power series in the modes, where m is a multi-index,
!>
!>     y(t + a) = sum_m h_m(a) z(t)^m,   z_j' = s_j z_j + sum_m g_jm z^m,   h_m = q_j exp(s_j a)
!>
!> in first order. The sum of g_jm is over resonant m: z_j times powers of z_i conj z_i. With
!> s = m . s_j and N_m the coefficient of z^m in the nonlinear part of the right-hand side,
!>
!>     h_m'(a) = s h_m(a) + r_m(a),   s h_m(0) + r_m(0) = sum_l A_l h_m(-lag_l) + N_m,
!>     r_m = sum over k of (sum over j of (m - k)_j g_j,e_j+k) h_(m - k),   k a product of pairs.
module centre_manifold
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use lapack_algebra, only: solve
   use linear_system, only: linear_part, linear_system_type
   use model_problem, only: model_type
   use hopf_normal_form, only: critical_vectors
   implicit none (type, external)
   private
   public :: normal_form_coefficient

   !> The terms of the series up to a multi-index; any term follows all those that it needs.
   type :: series_type
      !> Multi-indices, shape (modes, terms); the first one is zero
      integer, allocatable :: power(:, :)
      !> Distance of two terms that differ by 1 in a mode, shape (modes)
      integer, allocatable :: stride(:)
      !> Roots of the modes, shape (modes)
      complex(wp), allocatable :: s(:)
      !> h_m = exp(s a) sum_d polynomial(:, d, m) a^d, shape (n, 0:degree, terms)
      complex(wp), allocatable :: polynomial(:, :, :)
      !> h_m at all lags, shape (n, lags, terms)
      complex(wp), allocatable :: history(:, :, :)
      !> g_jm of the mode j for which m is resonant, or 0, shape (terms)
      complex(wp), allocatable :: flow(:)
   contains
      procedure :: place
   end type series_type

contains

   !> The coefficient g_jm of z^m in z_j', with |q| = 1.
   subroutine normal_form_coefficient(model, omega, m, coefficient, error)
      !> The model, which keeps delays of 0 and has simple roots +-i omega at rest
      class(model_type), intent(in) :: model
      !> Frequencies of the pairs, > 0, without low resonances
      real(wp), intent(in) :: omega(:)
      !> Resonant multi-index, shape (2 size(omega))
      integer, intent(in) :: m(:)
      !> The coefficient; 0 where m is not resonant
      complex(wp), intent(out) :: coefficient
      !> A combination of the frequencies is a root, too
      type(error_type), allocatable, intent(out) :: error
      type(linear_system_type) :: linear
      type(series_type) :: series
      integer :: i

      coefficient = 0.0_wp
      linear = linear_part(model)
      call set_first_order(linear, omega, m, series, error)
      do i = 2, size(series%flow)
         if (allocated(error)) return
         if (sum(series%power(:, i)) > 1) call add_term(model, linear, series, i, error)
      end do
      coefficient = series%flow(size(series%flow))
   end subroutine normal_form_coefficient

   !> The terms of first order.
   subroutine set_first_order(linear, omega, m, series, error)
      type(linear_system_type), intent(in) :: linear
      real(wp), intent(in) :: omega(:)
      integer, intent(in) :: m(:)
      type(series_type), intent(out) :: series
      type(error_type), allocatable, intent(out) :: error
      complex(wp), dimension(size(linear%a, 1)) :: p, q
      integer :: i, j, modes, terms, unit_index(size(m))

      modes = size(m)
      terms = product(m + 1)
      allocate (series%stride, source=[(product(m(:j - 1) + 1), j=1, modes)])
      allocate (series%power, source=reshape( &
                [((modulo((i - 1)/series%stride(j), m(j) + 1), j=1, modes), i=1, terms)], &
                [modes, terms]))
      allocate (series%s, source=[(cmplx(0.0_wp, [omega(i), -omega(i)], kind=wp), &
                                   i=1, size(omega))])
      allocate (series%polynomial(size(q), 0:sum(m)/2, terms), &
                series%history(size(q), size(linear%lag), terms), series%flow(terms), &
                source=(0.0_wp, 0.0_wp))
      do i = 1, modes
         if (m(i) == 0) cycle
         call critical_vectors(linear, cmplx(0.0_wp, omega((i + 1)/2), kind=wp), q, p, &
                               error)
         if (allocated(error)) return
         if (modulo(i, 2) == 0) q = conjg(q)
         unit_index = 0
         unit_index(i) = 1
         j = series%place(unit_index)
         series%polynomial(:, 0, j) = q
         series%history(:, :, j) = linear%history(series%polynomial(:, :, j), series%s(i))
      end do
   end subroutine set_first_order

   !> The term of a multi-index of second or higher order, all lower ones being known.
   subroutine add_term(model, linear, series, term, error)
      class(model_type), intent(in) :: model
      type(linear_system_type), intent(in) :: linear
      type(series_type), intent(inout) :: series
      integer, intent(in) :: term
      !> A combination of the frequencies is a root
      type(error_type), allocatable, intent(out) :: error
      complex(wp), dimension(size(series%polynomial, 1), &
                             0:ubound(series%polynomial, 2)) :: rest, integral
      complex(wp) :: at_lags(size(series%polynomial, 1), size(linear%lag))
      complex(wp) :: right(size(series%polynomial, 1)), s
      integer :: i, mode

      associate (m => series%power(:, term))
         s = sum(m*series%s)
         call find_rest(series, term, rest)
         integral = 0.0_wp
         do i = 1, ubound(rest, 2)
            integral(:, i) = rest(:, i - 1)/i
         end do
         right = -rest(:, 0)
         call add_products(model, series, m, [integer ::], right)
         at_lags = linear%history(integral, s)
         do i = 1, size(linear%lag)
            right = right + matmul(linear%a(:, :, i), at_lags(:, i))
         end do
         mode = resonant_mode(m)
         if (mode == 0) then
            call solve_scaled(linear%characteristic_matrix(s), right, integral(:, 0), error)
         else
            call solve_resonant()
         end if
         series%polynomial(:, :, term) = integral
         series%history(:, :, term) = linear%history(integral, s)
      end associate

   contains

      !> At a root, g_jm makes the system solvable: Delta(s) h = right - g_jm Delta'(s) q. The part
      !> of h along q is free and set to 0.
      subroutine solve_resonant()
         complex(wp), dimension(size(right) + 1) :: answer
         complex(wp), dimension(size(right) + 1, size(right) + 1) :: bordered
         integer :: n

         n = size(right)
         associate (q => series%polynomial(:, 0, 1 + series%stride(mode)))
            bordered = 0.0_wp
            bordered(:n, :n) = linear%characteristic_matrix(s)
            bordered(:n, n + 1) = matmul(linear%characteristic_slope(s), q)
            bordered(n + 1, :n) = conjg(q)
            call solve_scaled(bordered, [right, (0.0_wp, 0.0_wp)], answer, error)
            series%flow(term) = answer(n + 1)
            integral(:, 0) = answer(:n)
            integral(:, 1) = integral(:, 1) + answer(n + 1)*q
         end associate
      end subroutine solve_resonant
   end subroutine add_term

   !> r_m exp(-s a) without the unknown g_jm.
   pure subroutine find_rest(series, term, rest)
      type(series_type), intent(in) :: series
      integer, intent(in) :: term
      complex(wp), intent(out) :: rest(:, 0:)
      complex(wp) :: rate
      integer :: i, j, lower(size(series%s))

      rest = 0.0_wp
      do i = 2, term
         associate (pairs => series%power(:, i))
            lower = series%power(:, term) - pairs
            if (any(pairs(1::2) /= pairs(2::2)) .or. any(lower < 0)) cycle
            rate = 0.0_wp
            do j = 1, size(lower)
               if (lower(j) > 0) rate = rate + lower(j)*series%flow(i + series%stride(j))
            end do
            rest = rest + rate*series%polynomial(:, :, series%place(lower))
         end associate
      end do
   end subroutine find_rest

   !> The mode j with m = e_j plus a product of pairs, or 0.
   pure integer function resonant_mode(m) result(mode)
      integer, intent(in) :: m(:)
      integer :: surplus(size(m)/2)

      surplus = m(1::2) - m(2::2)
      mode = 0
      if (sum(abs(surplus)) /= 1) return
      mode = 2*findloc(abs(surplus), 1, dim=1)
      if (sum(surplus) > 0) mode = mode - 1
   end function resonant_mode

   !> Add N_m, the sum of the derivatives of all orders k of k terms with the product z^m, over k!;
   !> of these those that begin with given terms.
   pure recursive subroutine add_products(model, series, left, terms, total)
      class(model_type), intent(in) :: model
      type(series_type), intent(in) :: series
      !> Multi-index of the product of the further terms
      integer, intent(in) :: left(:)
      integer, intent(in) :: terms(:)
      complex(wp), intent(inout) :: total(:)
      integer :: i

      if (all(left == 0)) then
         if (size(terms) > 1) total = total + model%derivative(series%history(:, :, terms)) &
                                      /gamma(size(terms) + 1.0_wp)
         return
      end if
      do i = 2, series%place(left)
         if (any(series%power(:, i) > left)) cycle
         call add_products(model, series, left - series%power(:, i), [terms, i], total)
      end do
   end subroutine add_products

   !> Solution of a system with rows of different sizes.
   subroutine solve_scaled(matrix, right, solution, error)
      !> The matrix, shape (n, n); right-hand side, shape (n)
      complex(wp), intent(in) :: matrix(:, :), right(:)
      !> Solution, shape (n)
      complex(wp), intent(out) :: solution(:)
      type(error_type), allocatable, intent(out) :: error
      complex(wp) :: answer(size(right), 1)
      real(wp) :: row_size(size(right))

      row_size = maxval(abs(matrix), dim=2)
      call solve(matrix/spread(row_size, 2, size(right)), &
                 reshape(right/row_size, shape(answer)), answer, error)
      solution = answer(:, 1)
   end subroutine solve_scaled

   !> Position of a multi-index among the terms.
   pure integer function place(self, m) result(number)
      class(series_type), intent(in) :: self
      integer, intent(in) :: m(:)

      number = 1 + sum(m*self%stride)
   end function place
end module centre_manifold
