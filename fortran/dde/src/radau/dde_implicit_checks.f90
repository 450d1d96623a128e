!> What a converged implicit step must pass besides the embedded estimate, which a very stiff
!> component escapes: a solution that is one, and a polynomial that serves between the ends.
module dde_implicit_checks
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_jacobian, only: jacobian_type
   use dde_norm, only: hopeless, scaled_norm
   use dde_problem, only: dde_problem_type
   use dde_radau_tableau, only: radau_tableau
   use dde_stage_iteration, only: stage_iteration
   use dde_systems, only: real_system
   use dde_tolerance, only: tolerance_type
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: confirm, find_error_inside

contains

   !> Whether the last stage solves its equation by the Jacobian there too: where the Jacobian of
   !> the iteration is far too large, corrections are small without a solution.
   pure subroutine confirm(problem, method, stages, h, t_end, y, scale, tolerance, evaluations, &
                           at_end, system, misfit, confirmed)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The method
      type(radau_tableau), intent(in) :: method
      !> The iteration, converged
      type(stage_iteration), intent(inout) :: stages
      !> Length of the step
      real(wp), intent(in) :: h
      !> End of the step
      real(wp), intent(in) :: t_end
      !> State at its start, shape (n)
      real(wp), intent(in) :: y(:)
      !> Scale of each component
      real(wp), contiguous, intent(in) :: scale(:)
      !> Tolerance of each component
      type(tolerance_type), intent(in) :: tolerance
      !> Right-hand sides evaluated so far
      integer(int64), intent(inout) :: evaluations
      !> The Jacobian there
      type(jacobian_type), intent(inout) :: at_end
      !> Its real system
      type(real_system), intent(inout) :: system
      !> What the last stage leaves of its equation, shape (n)
      real(wp), contiguous, intent(inout) :: misfit(:)
      !> Whether it does
      logical, intent(out) :: confirmed
      real(wp) :: allowed
      logical :: finite, singular

      confirmed = .false.
      associate (y_end => stages%argument, slope => stages%slope_at)
         y_end = y + stages%increments(:, method%stages)
         call stages%slope_at_end(h, slope)
         call problem%rhs(t_end, y_end, stages%delayed(:, method%stages), misfit)
         evaluations = evaluations + 1
         if (.not. all(ieee_is_finite(misfit))) return
         misfit = misfit - slope
         ! a part of the tolerance, and what rounding does to the slope
         allowed = 0.1_wp + 4.0_wp*epsilon(1.0_wp)*maxval(abs(y_end)/scale) &
                   *sum(abs(stages%systems%a_inverse(method%stages, :)))
         confirmed = h*scaled_norm(problem%n, misfit, scale) <= method%real_eigenvalue*allowed
         if (confirmed) return
         call at_end%evaluate(problem, t_end, y_end, stages%delayed(:, method%stages), tolerance, &
                              .false., evaluations, finite)
         if (.not. finite) return
         call system%prepare(at_end, method%real_eigenvalue/h, singular)
         stages%systems%operations = stages%systems%operations + system%factor_operations
         if (singular) return
         call system%solve(misfit)
         confirmed = scaled_norm(problem%n, misfit, scale) <= allowed
      end associate
   end subroutine confirm

   !> Error between the ends, in units of the tolerance. A stiff component that follows the others
   !> at once is right at the stages however long the step, and its embedded error is filtered
   !> away; so the polynomial's last term there, of size h**s, is asked for tol**(s/(s + 1)).
   pure subroutine find_error_inside(method, h, differences, unfiltered, filtered, scale, asked, &
                                     tolerance, error)
      !> The method
      type(radau_tableau), intent(in) :: method
      !> Length of the step
      real(wp), intent(in) :: h
      !> Newton coefficients of the collocation polynomial, shape (0:stages, n)
      real(wp), intent(in) :: differences(0:, :)
      !> Error of the embedded method, shape (n); on return, what of the polynomial's last term is
      !> hidden
      real(wp), contiguous, intent(inout) :: unfiltered(:)
      !> The same, filtered
      real(wp), intent(in) :: filtered(:)
      !> Scale of each component to `asked`
      real(wp), contiguous, intent(in) :: scale(:)
      !> What the estimate is asked for
      real(wp), intent(in) :: asked
      !> Tolerance of the step
      real(wp), intent(in) :: tolerance
      !> The error
      real(wp), intent(out) :: error

      associate (s => method%stages, hidden => unfiltered)
         ! the filter lets the errors of components that are not stiff pass as they are
         hidden = max(0.0_wp, abs(unfiltered) - 2.0_wp*(method%real_eigenvalue/h*abs(filtered))) &
                  /max(abs(unfiltered), tiny(1.0_wp))
         hidden = hidden*method%bulge*differences(s, :)
         error = min(scaled_norm(size(scale), hidden, scale), hopeless)
         error = (error*asked/tolerance**(real(s, wp)/(s + 1)))**((s + 1.0_wp)/s)
      end associate
   end subroutine find_error_inside
end module dde_implicit_checks
