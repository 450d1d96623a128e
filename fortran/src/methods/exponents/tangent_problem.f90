! SPDX-License-Identifier: BSD-3-Clause
!> A delayed problem together with small disturbances of its solution: the variational equations
!>
!>     d delta_j/dt = (df/dy) delta_j(t) + (df/dz) [component c(k) of delta_j](t - lag(k)),
!>
!> j = 1..m, beside dy/dt = f, for the solver to integrate as one problem of n (m + 1) equations
!> with the same delays (Farmer 1982, Physica D 4, 366). The problem must give its derivatives
!> itself: those by differences are not accurate enough.
module tangent_problem
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde, only: dde_problem_type, find_jacobian, problem_with_tangents
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: allocate_slopes, tangent_problem_type

   !> State y, then the tangent vectors delta_1, ..., delta_m; delayed values in the same order.
   type, extends(dde_problem_type) :: tangent_problem_type
      !> The problem that is disturbed
      class(dde_problem_type), allocatable :: base
      !> Number of tangent vectors
      integer :: vectors = 0
   contains
      procedure :: initial => undisturbed_state
      procedure :: history => undisturbed_history
      procedure :: rhs => variational_equations
      procedure :: jacobian => blocks_on_the_diagonal
      procedure :: exponents => undisturbed_exponents
      procedure :: series => solution_and_vectors
      procedure :: past_series => undisturbed_past
      procedure :: relaxation_rate => undisturbed_rate
      procedure :: slow_series => slow_solution_and_vectors
   end type tangent_problem_type

   interface tangent_problem_type
      module procedure :: new_problem
   end interface tangent_problem_type

contains

   !> The problem with a number of tangent vectors.
   function new_problem(base, vectors) result(problem)
      class(dde_problem_type), intent(in) :: base
      integer, intent(in) :: vectors
      type(tangent_problem_type) :: problem
      integer :: j, k

      allocate (problem%base, source=base)
      problem%vectors = vectors
      problem%n = base%n*(vectors + 1)
      problem%exponentials = base%exponentials
      problem%checked_components = base%n
      problem%delayed_exponents = base%delayed_exponents
      select type (base)
      class is (problem_with_tangents)
         problem%analytic = base%analytic .and. base%analytic_tangents
      end select
      allocate (problem%lag, source=[((base%lag(k), k=1, size(base%lag)), j=0, vectors)])
      allocate (problem%component, source=[((base%component(k) + j*base%n, &
                                             k=1, size(base%lag)), j=0, vectors)])
      if (base%lower < 0) return
      ! the same band in each block on the diagonal
      problem%lower = base%lower
      problem%upper = base%upper
      problem%rows = reshape([((base%rows(:, k) + j*base%n, k=1, size(base%lag)), j=0, vectors)], &
                             [2, size(problem%lag)])
   end function new_problem

   !> No disturbance.
   pure subroutine undisturbed_state(self, y)
      class(tangent_problem_type), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = 0.0_wp
      call self%base%initial(y(:self%base%n))
   end subroutine undisturbed_state

   !> No disturbance.
   pure function undisturbed_history(self, t, component) result(value)
      class(tangent_problem_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = 0.0_wp
      if (component <= self%base%n) value = self%base%history(t, component)
   end function undisturbed_history

   !> Right-hand side and variational equations.
   pure subroutine variational_equations(self, t, y, z, dydt)
      class(tangent_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      real(wp), allocatable :: by_y(:, :), by_z(:, :)
      integer :: first, i, j, last

      associate (base => self%base, n => self%base%n, delays => size(self%base%lag))
         call base%rhs(t, y(:n), z(:delays), dydt(:n))
         if (.not. all(ieee_is_finite(dydt(:n)))) then
            dydt = ieee_value(1.0_wp, ieee_quiet_nan)
            return
         end if
         call allocate_slopes(base, by_y, by_z)
         call find_jacobian(base, t, y(:n), z(:delays), by_y, by_z)
         dydt(n + 1:) = 0.0_wp
         do j = 1, self%vectors
            associate (slope => dydt(j*n + 1:(j + 1)*n))
               do i = 1, n
                  if (base%lower < 0) then
                     slope = slope + y(j*n + i)*by_y(:, i)
                     cycle
                  end if
                  first = max(1, i - base%upper)
                  last = min(n, i + base%lower)
                  slope(first:last) = slope(first:last) + y(j*n + i) &
                                      *by_y(1 + base%upper + first - i:1 + base%upper + last - i, i)
               end do
               do i = 1, delays
                  if (base%lower < 0) then
                     slope = slope + z(j*delays + i)*by_z(:, i)
                     cycle
                  end if
                  first = base%rows(1, i)
                  last = base%rows(2, i)
                  slope(first:last) = slope(first:last) &
                                      + z(j*delays + i)*by_z(:last - first + 1, i)
               end do
            end associate
         end do
      end associate
   end subroutine variational_equations

   !> Room for the derivatives of a problem, full or banded.
   pure subroutine allocate_slopes(problem, by_y, by_z)
      class(dde_problem_type), intent(in) :: problem
      real(wp), allocatable, intent(out) :: by_y(:, :), by_z(:, :)

      associate (n => problem%n, delays => size(problem%lag))
         if (problem%lower < 0) then
            allocate (by_y(n, n), by_z(n, delays))
         else
            allocate (by_y(1 + problem%lower + problem%upper, n))
            allocate (by_z(1 + maxval([0, problem%rows(2, :) - problem%rows(1, :)]), delays))
         end if
      end associate
   end subroutine allocate_slopes

   !> Derivatives for simplified Newton iterations: the blocks on the diagonal, all the same. How
   !> the variational equations change with the state is left out: that part lies below the
   !> diagonal, and an iteration makes up for it once the state has converged.
   pure subroutine blocks_on_the_diagonal(self, t, y, z, by_y, by_z)
      class(tangent_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)
      real(wp), allocatable :: of_y(:, :), of_z(:, :)
      integer :: j

      by_y = 0.0_wp
      by_z = 0.0_wp
      associate (n => self%base%n, delays => size(self%base%lag))
         call allocate_slopes(self%base, of_y, of_z)
         call find_jacobian(self%base, t, y(:n), z(:delays), of_y, of_z)
         do j = 0, self%vectors
            ! rows of a band count from its diagonal
            associate (above => merge(j*n, 0, self%base%lower < 0))
               by_y(above + 1:above + size(of_y, 1), j*n + 1:(j + 1)*n) = of_y
               by_z(above + 1:above + size(of_z, 1), j*delays + 1:(j + 1)*delays) = of_z
            end associate
         end do
      end associate
   end subroutine blocks_on_the_diagonal

   !> Taylor series of the solution, and of the vectors along it.
   pure subroutine solution_and_vectors(self, t, unit, degree, z, y)
      class(tangent_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      !> Coefficients of state and tangent vectors; y(0, :) is given
      real(wp), intent(inout) :: y(0:degree, self%n)

      select type (base => self%base)
      class is (problem_with_tangents)
         associate (n => base%n, delays => size(base%lag))
            call base%series(t, unit, degree, z, y)
            ! where a delayed value has none the vectors have none
            if (.not. all(ieee_is_finite(y(1, :n)))) return
            call base%tangent_series(t, unit, degree, z, y, self%vectors, z(:, delays + 1:), &
                                     y(:, n + 1:))
         end associate
      end select
   end subroutine solution_and_vectors

   !> Taylor series before the initial time: no disturbance.
   pure subroutine undisturbed_past(self, t, component, unit, y)
      class(tangent_problem_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp), intent(in) :: unit
      real(wp), intent(out) :: y(0:)

      y = 0.0_wp
      if (component <= self%base%n) call self%base%past_series(t, component, unit, y)
   end subroutine undisturbed_past

   !> Terms of the variational equations have exponents of the terms of the right-hand side.
   pure subroutine undisturbed_exponents(self, t, y, z, values)
      class(tangent_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: values(self%exponentials)

      call self%base%exponents(t, y(:self%base%n), z(:size(self%base%lag)), values)
   end subroutine undisturbed_exponents

   !> Fast components of the vectors approach their balance as those of the state do.
   pure function undisturbed_rate(self, t, y) result(rate)
      class(tangent_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n)
      real(wp) :: rate

      rate = self%base%relaxation_rate(t, y)
   end function undisturbed_rate

   !> A better series of the slow solution, and of the vectors along it.
   pure subroutine slow_solution_and_vectors(self, t, unit, degree, z, y)
      class(tangent_problem_type), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      !> Coefficients of the last iteration; better ones
      real(wp), intent(inout) :: y(0:degree, self%n)
      real(wp) :: before(0:degree, self%base%n)

      select type (base => self%base)
      class is (problem_with_tangents)
         associate (n => base%n, delays => size(base%lag))
            before = y(:, :n)
            call base%slow_series(t, unit, degree, z, y)
            ! without a slow solution there are no disturbances of it
            if (.not. all(ieee_is_finite(y(0, :n)))) return
            call base%slow_tangent_series(t, unit, degree, z, before, y, self%vectors, &
                                          z(:, delays + 1:), y(:, n + 1:))
         end associate
      end select
   end subroutine slow_solution_and_vectors
end module tangent_problem
