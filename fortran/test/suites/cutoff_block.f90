!> The block with another friction law: the worked example of docs/friction-law.md. The logarithm of
!> the velocity has a cut-off,
!>
!>     L(v) = ln[(1 + c) v/(1 + c v)],   L(1) = 0,   L(v) < ln[(1 + c)/c],
!>
!> so that friction stays finite at large v, as in (1.1). c = 0 is the law of the paper. L(v) takes
!> the place of ln v in (4). All quantities are nondimensional.
module cutoff_block
   use block_parameters, only: block_history_type, block_parameters_type
   use block_state, only: index_of_ln_v, index_of_theta, index_of_u
   use dde_kinds, only: wp
   use test_problems, only: constant_past
   implicit none (type, external)
   private
   public :: build_cutoff_block, cutoff_block_type, with_jacobian_type, with_series_type

   !> Step 1, the right-hand side alone.
   type, extends(constant_past) :: cutoff_block_type
      !> Parameters of the block
      type(block_parameters_type) :: parameters
      !> c, the cut-off, >= 0
      real(wp) :: cutoff = 0.0_wp
   contains
      procedure :: rhs => equation_with_cutoff
      !> Fill in all components
      procedure :: set
   end type cutoff_block_type

   !> Step 2, with its Jacobian.
   type, extends(cutoff_block_type) :: with_jacobian_type
   contains
      procedure :: jacobian => derivatives
   end type with_jacobian_type

   !> Step 3, with its Taylor series.
   type, extends(with_jacobian_type) :: with_series_type
   contains
      procedure :: series => series_with_cutoff
   end type with_series_type

contains

   !> A block of step 1.
   pure type(cutoff_block_type) function build_cutoff_block(parameters, history, cutoff) &
      result(block)
      type(block_parameters_type), intent(in) :: parameters
      type(block_history_type), intent(in) :: history
      real(wp), intent(in) :: cutoff

      call block%set(parameters, history, cutoff)
   end function build_cutoff_block

   !> Fill in all components: of the three equations one is delayed, or none without delay.
   pure subroutine set(self, parameters, history, cutoff)
      class(cutoff_block_type), intent(inout) :: self
      type(block_parameters_type), intent(in) :: parameters
      type(block_history_type), intent(in) :: history
      real(wp), intent(in) :: cutoff

      self%n = 3
      self%lag = pack([parameters%tau], parameters%tau > 0.0_wp)
      self%component = pack([index_of_ln_v], parameters%tau > 0.0_wp)
      self%parameters = parameters
      self%past = [history%theta, history%u, log(history%v)]
      self%first = self%past
      self%cutoff = cutoff
   end subroutine set

   !> L(v) of w = ln v.
   elemental real(wp) function cut_logarithm(w, c) result(value)
      real(wp), intent(in) :: w, c

      value = log((1.0_wp + c)/(exp(-w) + c))
   end function cut_logarithm

   !> Its derivative by w.
   elemental real(wp) function cut_slope(w, c) result(value)
      real(wp), intent(in) :: w, c

      value = 1.0_wp/(1.0_wp + c*exp(w))
   end function cut_slope

   !> Equation (4) with L in place of the logarithm, w = ln v:
   !>
   !>     theta' = -v [theta + (1 + epsilon) L(w(t - tau))]
   !>     u'     =  v - 1
   !>     w'     = -(gamma^2/v) [u + (theta + L(w))/xi]
   pure subroutine equation_with_cutoff(self, t, y, z, dydt)
      class(cutoff_block_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp) :: delayed_w, v

      associate (p => self%parameters, c => self%cutoff, theta => y(index_of_theta), &
                 u => y(index_of_u), w => y(index_of_ln_v))
         delayed_w = w
         if (size(z) > 0) delayed_w = z(1)
         v = exp(w)
         dydt(index_of_theta) = -v*(theta + (1.0_wp + p%epsilon)*cut_logarithm(delayed_w, c))
         dydt(index_of_u) = v - 1.0_wp
         dydt(index_of_ln_v) = -p%gamma**2/v*(u + (theta + cut_logarithm(w, c))/p%xi)
      end associate
   end subroutine equation_with_cutoff

   !> Derivatives of the right-hand side by theta, u, w and by w(t - tau).
   pure subroutine derivatives(self, t, y, z, by_y, by_z)
      class(with_jacobian_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)
      real(wp) :: dydt(3), v

      associate (p => self%parameters, c => self%cutoff, w => y(index_of_ln_v))
         call self%rhs(t, y, z, dydt)
         v = exp(w)
         by_y = 0.0_wp
         by_y(index_of_theta, index_of_theta) = -v
         by_y(index_of_theta, index_of_ln_v) = dydt(index_of_theta)
         by_y(index_of_u, index_of_ln_v) = v
         by_y(index_of_ln_v, index_of_theta) = -p%gamma**2/(v*p%xi)
         by_y(index_of_ln_v, index_of_u) = -p%gamma**2/v
         by_y(index_of_ln_v, index_of_ln_v) = -dydt(index_of_ln_v) &
                                              - p%gamma**2/(v*p%xi)*cut_slope(w, c)
         if (size(z) > 0) then
            by_z = 0.0_wp
            by_z(index_of_theta, 1) = -v*(1.0_wp + p%epsilon)*cut_slope(z(1), c)
         else
            by_y(index_of_theta, index_of_ln_v) = dydt(index_of_theta) &
                                                  - v*(1.0_wp + p%epsilon)*cut_slope(w, c)
         end if
      end associate
   end subroutine derivatives

   !> Taylor series of the solution: each coefficient from those before it. With e = exp(-w),
   !> e' = -e w' and (e + c) L' = -e'.
   pure subroutine series_with_cutoff(self, t, unit, degree, z, y)
      class(with_series_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      !> Coefficients of v, of exp(-w), of L, of both for the delayed w, and of the two brackets
      real(wp), dimension(0:degree) :: v, e, cut, delayed_e, delayed_cut, friction, force
      real(wp) :: bracket
      integer :: k

      associate (p => self%parameters, c => self%cutoff, w => y(:, index_of_ln_v))
         do k = 0, degree - 1
            call extend_exponential(k, w, 1.0_wp, v)
            call extend_logarithm(k, w, c, e, cut)
            bracket = cut(k)
            if (size(z, 2) > 0) then
               call extend_logarithm(k, z(:, 1), c, delayed_e, delayed_cut)
               bracket = delayed_cut(k)
            end if
            friction(k) = y(k, index_of_theta) + (1.0_wp + p%epsilon)*bracket
            force(k) = y(k, index_of_u) + (y(k, index_of_theta) + cut(k))/p%xi
            y(k + 1, index_of_theta) = -unit/(k + 1)*product_term(k, v, friction)
            y(k + 1, index_of_u) = unit/(k + 1)*(v(k) - merge(1.0_wp, 0.0_wp, k == 0))
            y(k + 1, index_of_ln_v) = -unit/(k + 1)*p%gamma**2*product_term(k, e, force)
         end do
      end associate
   end subroutine series_with_cutoff

   !> Coefficient k of a product.
   pure real(wp) function product_term(k, a, b) result(term)
      integer, intent(in) :: k
      real(wp), intent(in) :: a(0:), b(0:)

      term = dot_product(a(:k), b(k:0:-1))
   end function product_term

   !> Coefficient k of exp(sign w) from those before it.
   pure subroutine extend_exponential(k, w, sign_of_w, e)
      integer, intent(in) :: k
      real(wp), intent(in) :: w(0:), sign_of_w
      real(wp), intent(inout) :: e(0:)
      integer :: j

      if (k == 0) then
         e(0) = exp(sign_of_w*w(0))
      else
         e(k) = sign_of_w*sum([(j*w(j)*e(k - j), j=1, k)])/k
      end if
   end subroutine extend_exponential

   !> Coefficient k of exp(-w) and of L(w) from those before them.
   pure subroutine extend_logarithm(k, w, c, e, cut)
      integer, intent(in) :: k
      real(wp), intent(in) :: w(0:), c
      real(wp), intent(inout) :: e(0:), cut(0:)
      integer :: j

      call extend_exponential(k, w, -1.0_wp, e)
      if (k == 0) then
         cut(0) = cut_logarithm(w(0), c)
      else
         cut(k) = -(k*e(k) + sum([(j*cut(j)*e(k - j), j=1, k - 1)]))/(k*(e(0) + c))
      end if
   end subroutine extend_logarithm
end module cutoff_block
