!> A problem that gives Taylor series of small disturbances of its solution. The solver does not
!> call them: they serve methods that combine a problem and its disturbances into one problem, for
!> instance for Lyapunov exponents. The type is here because models extend it and methods call it,
!> and these do not know each other.
module dde_tangents
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_problem, only: dde_problem_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: problem_with_tangents

   !> A system of delay differential equations and its variational equations as series.
   type, abstract, extends(dde_problem_type) :: problem_with_tangents
      !> Whether the extension gives `tangent_series`, and `slow_tangent_series` with `slow_series`
      logical :: analytic_tangents = .false.
   contains
      !> Taylor series of small disturbances of the solution
      procedure :: tangent_series => no_tangent_series
      !> Taylor series of small disturbances of the solution of `slow_series`
      procedure :: slow_tangent_series => no_slow_tangent_series
   end type problem_with_tangents

contains

   !> Taylor series of disturbances of the solution: the derivative of `series`. Not a number unless
   !> the extension gives it.
   pure subroutine no_tangent_series(self, t, unit, degree, z, y, vectors, dz, dy)
      class(problem_with_tangents), intent(in) :: self
      !> Time
      real(wp), intent(in) :: t
      !> Unit of time of the powers
      real(wp), intent(in) :: unit
      !> Degree of the series
      integer, intent(in) :: degree
      !> Coefficients of the delayed values
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      !> Coefficients of the solution, all known
      real(wp), intent(in) :: y(0:degree, self%n)
      !> Number of disturbances
      integer, intent(in) :: vectors
      !> Coefficients of the disturbances of the delayed values
      real(wp), intent(in) :: dz(0:degree, size(self%lag), vectors)
      !> Coefficients of the disturbances; dy(0, :, :) is given
      real(wp), intent(inout) :: dy(0:degree, self%n, vectors)

      dy(1:, :, :) = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_tangent_series

   !> A better series of disturbances of the slow solution: the derivative of one iteration of
   !> `slow_series`. Not a number unless the extension gives it.
   pure subroutine no_slow_tangent_series(self, t, unit, degree, z, before, y, vectors, dz, dy)
      class(problem_with_tangents), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      !> Coefficients of the solution before the iteration of `slow_series`, and after it
      real(wp), intent(in) :: before(0:degree, self%n), y(0:degree, self%n)
      integer, intent(in) :: vectors
      real(wp), intent(in) :: dz(0:degree, size(self%lag), vectors)
      !> Coefficients of the disturbances before the iteration, then after it
      real(wp), intent(inout) :: dy(0:degree, self%n, vectors)

      dy = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine no_slow_tangent_series
end module dde_tangents
