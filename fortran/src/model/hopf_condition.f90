!> Where a pair of characteristic roots of a law lies at s = i omega. In the characteristic function
!>
!>     Delta(s) = P(s) + Q(s) exp(-s tau)
!>
!> of the block, P and Q are polynomials in s whose coefficients have no power above the first of
!> d = 1 + epsilon, x = 1/xi and g = gamma^2, for any law of friction of which epsilon enters the
!> linear part in this way; without inertia x = xi and g = gamma. P is without d, Q is d times a
!> polynomial that is 0 at s = 0, where P is not: a frequency has one epsilon, and an epsilon two
!> frequencies or none. On the Hopf set |P| = |Q| and
!> exp(i omega tau) = -Q/P. For the paper's law these are (7) to (10), corrected where
!> docs/method.md, "What was corrected", says so; the tests compare them. All quantities are
!> nondimensional.
module hopf_condition
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: characteristic_type
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use spring_block, only: block_characteristic
   implicit none (type, external)
   private
   public :: find_hopf_condition, hopf_condition_type, two_pi

   real(wp), parameter :: two_pi = 2.0_wp*acos(-1.0_wp)
   !> xi and gamma that stand for 1/xi = 0 and gamma = 0; xi of a spring that does not matter.
   real(wp), parameter :: infinite = 1.0e100_wp, none = 1.0e-100_wp, weak = 1.0e-6_wp
   !> Where the coefficients are compared: d, x, g.
   real(wp), parameter :: probe(3) = [1.7_wp, 2.3_wp, 0.6_wp]
   !> Largest difference there, relative to the largest coefficient.
   real(wp), parameter :: affine_error = 1.0e-12_wp

   !> P and Q of a law.
   type :: hopf_condition_type
      !> Degree of P
      integer :: n = 0
      !> Whether the block has inertia: x = 1/xi and g = gamma^2, or x = xi and g = gamma
      logical :: has_inertia = .true.
      !> Coefficients of d**a x**b g**c in those of P and Q, shape (0:n, 2, a: 0:1, b: 0:1, c: 0:1)
      real(wp), allocatable :: term(:, :, :, :, :)
   contains
      procedure :: polynomials
      procedure :: epsilon_at
      procedure :: largest_omega
      procedure :: least_omega
      procedure :: xi_at
      procedure :: tau_at
      procedure :: partner_omega
   end type hopf_condition_type

contains

   !> P and Q of a law with its parameters, from the corners of the cube 0 <= d, x, g <= 1.
   subroutine find_hopf_condition(parameters, condition, error)
      !> Law and its own parameters; tau, epsilon, xi and gamma do not matter
      type(block_parameters_type), intent(in) :: parameters
      !> P and Q
      type(hopf_condition_type), intent(out) :: condition
      !> The law is outside of this form
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: at_0(:, :), by_d(:, :), expected(:, :), met(:, :)
      type(block_parameters_type) :: there
      type(characteristic_type) :: c
      integer :: form

      there = parameters
      there%tau = probe(1)
      c = block_characteristic(there)
      if (size(c%delay) == 2 .and. .not. abs(sum(c%delay) - there%tau) > 0.0_wp &
          .and. .not. abs(sum(c%delay_by(:, 1)) - 1.0_wp) > 0.0_wp) then
         do form = 1, 2
            condition%has_inertia = form == 1
            call find_terms(parameters, condition)
            expected = condition%polynomials(probe(1), probe(2), probe(3))
            met = coefficients(parameters, condition%has_inertia, probe(1), probe(2), probe(3))
            ! their first index is 1, for s**0
            at_0 = condition%polynomials(0.0_wp, probe(2), probe(3))
            by_d = condition%polynomials(1.0_wp, probe(2), probe(3)) - at_0
            associate (small => affine_error*maxval(abs(expected)))
               if (all(abs(met - expected) <= small) .and. abs(at_0(1, 1)) > small &
                   .and. all(abs([at_0(:, 2), by_d(:, 1), by_d(1, 2)]) <= small) &
                   .and. any(abs(by_d(:, 2)) > small)) return
            end associate
         end do
      end if
      call raise(error, "Hopf points of the law '"//trim(parameters%law)//"': its linear part is " &
                 //"not of their form; expected v with the delay tau, times 1 + epsilon, and " &
                 //"nothing else that is delayed or depends on epsilon")
   end subroutine find_hopf_condition

   !> The terms from the corners of the cube.
   subroutine find_terms(parameters, condition)
      type(block_parameters_type), intent(in) :: parameters
      type(hopf_condition_type), intent(inout) :: condition
      real(wp), allocatable :: corner(:, :), term(:, :, :, :, :)
      integer :: a, b, c

      do c = 0, 1
         do b = 0, 1
            do a = 0, 1
               corner = coefficients(parameters, condition%has_inertia, real(a, wp), real(b, wp), &
                                     real(c, wp))
               condition%n = size(corner, 1) - 1
               if (.not. allocated(term)) allocate (term(0:condition%n, 2, 0:1, 0:1, 0:1))
               term(:, :, a, b, c) = corner
            end do
         end do
      end do
      term(:, :, 1, :, :) = term(:, :, 1, :, :) - term(:, :, 0, :, :)
      term(:, :, :, 1, :) = term(:, :, :, 1, :) - term(:, :, :, 0, :)
      term(:, :, :, :, 1) = term(:, :, :, :, 1) - term(:, :, :, :, 0)
      call move_alloc(term, condition%term)
   end subroutine find_terms

   !> Coefficients of P and Q at d = 1 + epsilon, and x and g of xi and gamma.
   function coefficients(parameters, has_inertia, d, x, g) result(values)
      type(block_parameters_type), intent(in) :: parameters
      logical, intent(in) :: has_inertia
      real(wp), intent(in) :: d, x, g
      real(wp), allocatable :: values(:, :)
      type(block_parameters_type) :: there
      type(characteristic_type) :: c

      there = parameters
      there%tau = 1.0_wp
      there%epsilon = d - 1.0_wp
      if (has_inertia) then
         there%xi = infinite
         if (x > 0.0_wp) there%xi = 1.0_wp/x
         there%gamma = sqrt(g)
      else
         there%xi = max(x, none)
         there%gamma = max(g, none)
      end if
      c = block_characteristic(there)
      values = c%coefficient
   end function coefficients

   !> x of xi.
   elemental real(wp) function x_of(self, xi) result(x)
      class(hopf_condition_type), intent(in) :: self
      real(wp), intent(in) :: xi

      x = xi
      if (self%has_inertia) x = 1.0_wp/xi
   end function x_of

   !> g of gamma.
   elemental real(wp) function g_of(self, gamma) result(g)
      class(hopf_condition_type), intent(in) :: self
      real(wp), intent(in) :: gamma

      g = gamma
      if (self%has_inertia) g = gamma**2
   end function g_of

   !> Coefficients of P and Q, shape (0:n, 2).
   pure function polynomials(self, d, x, g) result(values)
      class(hopf_condition_type), intent(in) :: self
      !> 1 + epsilon, x, g
      real(wp), intent(in) :: d, x, g
      real(wp) :: values(0:self%n, 2)
      real(wp) :: plane(0:self%n, 2, 0:1, 0:1), line(0:self%n, 2, 0:1)

      plane = self%term(:, :, :, :, 0) + g*self%term(:, :, :, :, 1)
      line = plane(:, :, :, 0) + x*plane(:, :, :, 1)
      values = line(:, :, 0) + d*line(:, :, 1)
   end function polynomials

   !> Value of a polynomial with real coefficients at i omega.
   pure complex(wp) function on_axis(coefficient, omega) result(value)
      real(wp), intent(in) :: coefficient(0:), omega
      integer :: k

      value = 0.0_wp
      do k = ubound(coefficient, 1), 0, -1
         value = value*cmplx(0.0_wp, omega, kind=wp) + coefficient(k)
      end do
   end function on_axis

   !> The epsilon of a pair i omega, by |P| = |Q|; (7) and (8) for the paper's law, with gamma^2
   !> where (8) prints gamma^1. Not a number above -1 where there is none.
   pure real(wp) function epsilon_at(self, omega, xi, gamma) result(epsilon)
      class(hopf_condition_type), intent(in) :: self
      !> Frequency of the pair, > 0; spring constant; frequency of the block
      real(wp), intent(in) :: omega, xi, gamma
      complex(wp) :: p, p_by_d, q, q_by_d
      real(wp) :: at_0(0:self%n, 2), middle, square, rest, by_d(0:self%n, 2)

      at_0 = self%polynomials(0.0_wp, x_of(self, xi), g_of(self, gamma))
      by_d = self%polynomials(1.0_wp, x_of(self, xi), g_of(self, gamma)) - at_0
      p = on_axis(at_0(:, 1), omega)
      q = on_axis(at_0(:, 2), omega)
      p_by_d = on_axis(by_d(:, 1), omega)
      q_by_d = on_axis(by_d(:, 2), omega)
      ! square d^2 - 2 middle d - rest = 0
      square = abs(q_by_d)**2 - abs(p_by_d)**2
      middle = real(p*conjg(p_by_d)) - real(q*conjg(q_by_d))
      rest = abs(p)**2 - abs(q)**2
      epsilon = -1.0_wp + larger_root(square, middle, rest)
   end function epsilon_at

   !> The larger root of square d^2 - 2 middle d - rest = 0; 0 where there is none.
   pure real(wp) function larger_root(square, middle, rest) result(d)
      real(wp), intent(in) :: square, middle, rest
      real(wp) :: half

      d = 0.0_wp
      half = middle**2 + square*rest
      if (half < 0.0_wp) return
      half = sqrt(half)
      if (abs(square) <= tiny(1.0_wp)) then
         if (abs(middle) > 0.0_wp) d = -0.5_wp*rest/middle
      else if (middle >= 0.0_wp .eqv. square > 0.0_wp) then
         d = (middle + sign(half, square))/square
      else
         ! the other root is (middle - half)/square, and their product -rest/square
         d = -rest/(middle - sign(half, square))
      end if
   end function larger_root

   !> Largest frequency of a pair i omega at this epsilon or a smaller one: a pair needs the least
   !> epsilon where gamma = omega, and the spring then does not matter, or without inertia on a weak
   !> spring. For the paper's law this is 1 + epsilon = sqrt(1 + omega^2).
   pure real(wp) function largest_omega(self, epsilon) result(omega)
      class(hopf_condition_type), intent(in) :: self
      !> Sensitivity of the velocity relaxation
      real(wp), intent(in) :: epsilon
      real(wp) :: above, middle
      integer :: i

      omega = 0.0_wp
      above = 1.0_wp
      do while (self%epsilon_at(above, weak, above) <= epsilon .and. above < infinite)
         omega = above
         above = 2.0_wp*above
      end do
      ! to the last digit
      do i = 1, 2*digits(1.0_wp)
         middle = 0.5_wp*(omega + above)
         if (middle <= omega .or. middle >= above) exit
         if (self%epsilon_at(middle, weak, middle) <= epsilon) then
            omega = middle
         else
            above = middle
         end if
      end do
   end function largest_omega

   !> A frequency below those of pairs i omega at this epsilon or a smaller one. As omega falls to
   !> 0, 1 + epsilon = |P|/|Q/d| grows as |P(0)|/(omega |Q'(0)/d|); a block that is much slower than
   !> its spring has pairs near gamma alone.
   pure real(wp) function least_omega(self, epsilon, xi, gamma) result(omega)
      class(hopf_condition_type), intent(in) :: self
      !> Sensitivity of the velocity relaxation; spring constant; frequency of the block
      real(wp), intent(in) :: epsilon, xi, gamma
      !> How far below
      real(wp), parameter :: share = 0.25_wp, far_share = 1.0e-6_wp
      real(wp) :: at_0(0:self%n, 2), by_d(0:self%n, 2)

      at_0 = self%polynomials(0.0_wp, x_of(self, xi), g_of(self, gamma))
      by_d = self%polynomials(1.0_wp, x_of(self, xi), g_of(self, gamma)) - at_0
      associate (left => abs(at_0(0, 1)) - (1.0_wp + epsilon)*abs(by_d(0, 2)), &
                 right => (1.0_wp + epsilon)*abs(by_d(1, 2)))
         omega = far_share*gamma
         if (left > 0.0_wp .and. right > 0.0_wp) omega = share*min(left/right, gamma)
      end associate
   end function least_omega

   !> The xi of a pair i omega at delay tau, whatever its epsilon; (9) for the paper's law. It
   !> holds where `tau_at` gives tau back. Not above 0 where there is none.
   !>
   !> Delta = a + d b is 0 for a real d where the imaginary part of a conjg(b) is 0.
   pure real(wp) function xi_at(self, omega, tau, gamma) result(xi)
      class(hopf_condition_type), intent(in) :: self
      !> Frequency of the pair, > 0; delay; frequency of the block
      real(wp), intent(in) :: omega, tau, gamma
      complex(wp) :: a(0:1), b(0:1)
      real(wp) :: x
      integer :: i

      do i = 0, 1
         a(i) = delta_at(self, omega, 0.0_wp, real(i, wp), g_of(self, gamma), tau)
         b(i) = delta_at(self, omega, 1.0_wp, real(i, wp), g_of(self, gamma), tau) - a(i)
      end do
      ! parts without x and with x
      a(1) = a(1) - a(0)
      b(1) = b(1) - b(0)
      if (abs(b(0)) <= affine_error*abs(b(1))) then
         x = -aimag(a(0)*conjg(b(1)))/aimag(a(1)*conjg(b(1)))
      else if (abs(b(1)) <= affine_error*abs(b(0))) then
         x = -aimag(a(0)*conjg(b(0)))/aimag(a(1)*conjg(b(0)))
      else
         x = larger_root(aimag(a(1)*conjg(b(1))), &
                         -0.5_wp*(aimag(a(0)*conjg(b(1))) + aimag(a(1)*conjg(b(0)))), &
                         -aimag(a(0)*conjg(b(0))))
      end if
      xi = x
      if (self%has_inertia) xi = 1.0_wp/x
   end function xi_at

   !> Delta(i omega).
   pure complex(wp) function delta_at(self, omega, d, x, g, tau) result(value)
      class(hopf_condition_type), intent(in) :: self
      real(wp), intent(in) :: omega, d, x, g, tau
      real(wp) :: c(0:self%n, 2)

      c = self%polynomials(d, x, g)
      value = on_axis(c(:, 1), omega) &
              + on_axis(c(:, 2), omega)*exp(cmplx(0.0_wp, -omega*tau, kind=wp))
   end function delta_at

   !> The delay of a pair i omega on branch k, by exp(i omega tau) = -Q/P; (10) for the paper's law,
   !> with its full numerator and the arctangent of two arguments. There the angle is continuous in
   !> omega, so each branch is one smooth curve.
   pure real(wp) function tau_at(self, omega, epsilon, xi, gamma, k) result(tau)
      class(hopf_condition_type), intent(in) :: self
      !> Frequency of the pair, > 0; its epsilon; spring constant; frequency of the block
      real(wp), intent(in) :: omega, epsilon, xi, gamma
      !> Branch
      integer, intent(in) :: k
      complex(wp) :: turn
      real(wp) :: c(0:self%n, 2)

      c = self%polynomials(1.0_wp + epsilon, x_of(self, xi), g_of(self, gamma))
      turn = -on_axis(c(:, 2), omega)/on_axis(c(:, 1), omega)
      tau = (atan2(aimag(turn), real(turn)) + two_pi*k)/omega
   end function tau_at

   !> The other frequency at which |P| = |Q|, or omega again where epsilon is least. |P|^2 - |Q|^2
   !> is a polynomial in omega^2 of degree 3: its other roots are a pair whose product is negative.
   pure real(wp) function partner_omega(self, omega, epsilon, xi, gamma) result(partner)
      class(hopf_condition_type), intent(in) :: self
      !> Frequency of a pair, > 0; its epsilon; spring constant; frequency of the block
      real(wp), intent(in) :: omega, epsilon, xi, gamma
      real(wp) :: c(0:self%n, 2), half_sum, product, root, second_highest

      c = self%polynomials(1.0_wp + epsilon, x_of(self, xi), g_of(self, gamma))
      c = c/c(self%n, 1)
      product = (c(0, 1)**2 - c(0, 2)**2)/omega**2
      second_highest = c(2, 1)**2 - 2.0_wp*c(1, 1) - c(2, 2)**2
      half_sum = -0.5_wp*(second_highest + omega**2)
      root = sqrt(half_sum**2 + product)
      if (half_sum > 0.0_wp) then
         partner = sqrt(half_sum + root)
      else
         partner = sqrt(product/(root - half_sum))
      end if
   end function partner_omega
end module hopf_condition
