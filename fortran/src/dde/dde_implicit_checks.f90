!> What a converged implicit step must pass besides the embedded estimate, which a very stiff
!> component escapes: a solution that is one, and a polynomial that serves between the ends.
module dde_implicit_checks
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_norm, only: hopeless, scaled_norm
   use dde_problem, only: dde_problem_type
   use dde_radau_tableau, only: radau_tableau
   use dde_stage_iteration, only: stage_iteration
   use dde_stage_systems, only: correct_real
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: confirmed, error_inside

contains

   !> Whether the last stage solves its equation by the Jacobian there too: where the Jacobian of
   !> the iteration is far too large, corrections are small without a solution. Evaluates once.
   pure function confirmed(problem, method, stages, t, h, y, scale) result(value)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The method
      type(radau_tableau), intent(in) :: method
      !> The iteration, converged
      type(stage_iteration), intent(in) :: stages
      !> Start of the step
      real(wp), intent(in) :: t
      !> Length of the step
      real(wp), intent(in) :: h
      !> State at its start, shape (n)
      real(wp), intent(in) :: y(:)
      !> Scale of each component
      real(wp), intent(in) :: scale(:)
      logical :: value
      real(wp) :: by_y(problem%n, problem%n), by_z(problem%n, size(problem%lag))
      real(wp) :: allowed, misfit(problem%n), y_end(problem%n)
      logical :: singular

      value = .false.
      y_end = y + stages%increments(:, method%stages)
      call problem%rhs(t + h, y_end, stages%delayed(:, method%stages), misfit)
      if (.not. all(ieee_is_finite(misfit))) return
      misfit = misfit - stages%slope_at_end(h)
      ! a part of the tolerance, and what rounding does to the slope
      allowed = 0.1_wp + 4.0_wp*epsilon(1.0_wp)*maxval(abs(y_end))/minval(scale) &
                *sum(abs(stages%systems%a_inverse(method%stages, :)))
      value = scaled_norm(problem%n, h*misfit, scale) <= method%real_eigenvalue*allowed
      if (value) return
      call problem%jacobian(t + h, y_end, stages%delayed(:, method%stages), by_y, by_z)
      if (.not. all(ieee_is_finite(by_y))) return
      call correct_real(method, h, by_y, misfit, singular)
      if (.not. singular) value = scaled_norm(problem%n, misfit, scale) <= allowed
   end function confirmed

   !> Error between the ends, in units of the tolerance. A stiff component that follows the others
   !> at once is right at the stages however long the step, and its embedded error is filtered
   !> away; so the polynomial's last term there, of size h**s, is asked for tol**(s/(s + 1)).
   pure function error_inside(method, h, differences, unfiltered, filtered, scale, asked, &
                              tolerance) result(error)
      !> The method
      type(radau_tableau), intent(in) :: method
      !> Length of the step
      real(wp), intent(in) :: h
      !> Newton coefficients of the collocation polynomial, shape (0:stages, n)
      real(wp), intent(in) :: differences(0:, :)
      !> Error of the embedded method, shape (n)
      real(wp), intent(in) :: unfiltered(:)
      !> The same, filtered
      real(wp), intent(in) :: filtered(:)
      !> Scale of each component to `asked`
      real(wp), intent(in) :: scale(:)
      !> What the estimate is asked for
      real(wp), intent(in) :: asked
      !> Tolerance of the step
      real(wp), intent(in) :: tolerance
      real(wp) :: error
      real(wp), dimension(size(scale)) :: hidden, passed

      associate (s => method%stages)
         ! the filter lets the errors of components that are not stiff pass as they are
         passed = method%real_eigenvalue/h*abs(filtered)
         hidden = max(0.0_wp, abs(unfiltered) - 2.0_wp*passed)/max(abs(unfiltered), tiny(1.0_wp))
         hidden = hidden*method%bulge*differences(s, :)
         error = min(scaled_norm(size(scale), hidden, scale), hopeless)
         error = (error*asked/tolerance**(real(s, wp)/(s + 1)))**((s + 1.0_wp)/s)
      end associate
   end function error_inside
end module dde_implicit_checks
