! SPDX-License-Identifier: BSD-3-Clause
!> The baseline of the paper's time: the classical Runge-Kutta method of order 4 with steps of one
!> length as a method of steps, delayed values interpolated between grid points, linearly or by
!> cubic Hermite polynomials. No error control; kinks are met only where they lie on the grid.
module fixed_step_rk4
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde, only: dde_problem_type, integration_result, reached_end, refused, sampler_type, &
                  value_not_finite
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: integrate_rk4

   !> Grid points of the past that delayed values are taken from.
   type :: grid_type
      !> Length of the steps
      real(wp) :: h = 0.0_wp
      !> Number of grid points held
      integer :: points = 0
      !> State and slope at the newest grid points, point i in column modulo(i, points)
      real(wp), allocatable :: y(:, :), slope(:, :)
      !> Cubic Hermite interpolation, or linear
      logical :: cubic = .true.
   contains
      procedure :: between, delayed
   end type grid_type

contains

   !> Integrate from t = 0 to t_end in steps of length `h`, at most the shortest delay, or of the
   !> length nearest to it that divides t_end.
   subroutine integrate_rk4(problem, t_end, h, cubic, outcome, error, sampler)
      class(dde_problem_type), intent(in) :: problem
      !> Final time
      real(wp), intent(in) :: t_end
      !> Length of a step
      real(wp), intent(in) :: h
      !> Cubic Hermite interpolation of the past, or linear
      logical, intent(in) :: cubic
      !> What was done
      type(integration_result), intent(out) :: outcome
      !> Why it did not reach t_end
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of samples, which are always interpolated by cubic Hermite polynomials
      class(sampler_type), intent(inout), optional :: sampler
      type(grid_type) :: grid
      integer :: step, steps

      outcome%reason = refused
      if (problem%switches > 0) then
         call raise(error, "rk4: the model is not smooth; expected a smooth one")
         return
      end if
      if (problem%moving > 0) then
         call raise(error, "rk4: delays depend on t or the states; expected constant delays")
         return
      end if
      steps = max(1, nint(t_end/h))
      grid%h = t_end/steps
      grid%cubic = cubic
      if (any(problem%lag < grid%h*(1.0_wp - 1.0e-12_wp))) then
         call raise(error, "steps of length "//text(grid%h)//" are longer than the shortest " &
                    //"delay, "//text(minval(problem%lag)))
         return
      end if
      grid%points = 3
      if (size(problem%lag) > 0) grid%points = 3 + ceiling(maxval(problem%lag)/grid%h)
      allocate (grid%y(problem%n, 0:grid%points - 1), grid%slope(problem%n, 0:grid%points - 1))
      call problem%initial(grid%y(:, 0))
      outcome%y = grid%y(:, 0)
      call find_slope(problem, grid, 0, 0.0_wp, outcome%y, grid%slope(:, 0))
      outcome%evaluations = 1
      do step = 0, steps - 1
         call advance(problem, grid, step, outcome%y)
         outcome%evaluations = outcome%evaluations + 4
         if (.not. all(ieee_is_finite(outcome%y))) then
            outcome%reason = value_not_finite
            call raise(error, "stopped at t = "//text(outcome%t)//" of "//text(t_end)//" after " &
                       //text(step)//" steps of length "//text(grid%h) &
                       //": a value that is not finite was met")
            return
         end if
         outcome%accepted = step + 1
         outcome%t = (step + 1)*grid%h
         if (present(sampler)) call sample(grid, step, steps, t_end, sampler)
      end do
      outcome%reason = reached_end
   end subroutine integrate_rk4

   !> One step from grid point `step`.
   subroutine advance(problem, grid, step, y)
      class(dde_problem_type), intent(in) :: problem
      !> The past, whose newest point is this; the next is added
      type(grid_type), intent(inout) :: grid
      integer, intent(in) :: step
      !> State there, replaced by the next
      real(wp), intent(inout) :: y(:)
      real(wp) :: k2(size(y)), k3(size(y)), k4(size(y))
      integer :: new

      new = modulo(step + 1, grid%points)
      associate (h => grid%h, k1 => grid%slope(:, modulo(step, grid%points)))
         call find_slope(problem, grid, step, 0.5_wp, y + 0.5_wp*h*k1, k2)
         call find_slope(problem, grid, step, 0.5_wp, y + 0.5_wp*h*k2, k3)
         call find_slope(problem, grid, step, 1.0_wp, y + h*k3, k4)
         y = y + h/6.0_wp*(k1 + 2.0_wp*(k2 + k3) + k4)
      end associate
      grid%y(:, new) = y
      call find_slope(problem, grid, step, 1.0_wp, y, grid%slope(:, new))
   end subroutine advance

   !> Right-hand side at `part` of the step from grid point `step`.
   subroutine find_slope(problem, grid, step, part, y, slope)
      class(dde_problem_type), intent(in) :: problem
      type(grid_type), intent(in) :: grid
      integer, intent(in) :: step
      !> Share of the step, 0..1
      real(wp), intent(in) :: part
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: slope(:)

      call problem%rhs((step + part)*grid%h, y, grid%delayed(problem, step, part), slope)
   end subroutine find_slope

   !> Delayed values at `part` of the step from grid point `step`.
   pure function delayed(self, problem, step, part) result(z)
      class(grid_type), intent(in) :: self
      class(dde_problem_type), intent(in) :: problem
      !> Number of the newest grid point
      integer, intent(in) :: step
      !> Share of the step, 0..1
      real(wp), intent(in) :: part
      real(wp) :: z(size(problem%lag))
      real(wp) :: place
      integer :: k

      do k = 1, size(z)
         ! rounding must not put a grid point into the interval beside it
         place = step + part - problem%lag(k)/self%h
         if (abs(place - nint(place)) < 1.0e-9_wp) place = nint(place)
         if (place < 0.0_wp) then
            z(k) = problem%history(place*self%h, problem%component(k))
         else
            z(k) = self%between(problem%component(k), min(floor(place), max(step - 1, 0)), place, &
                                self%cubic)
         end if
      end do
   end function delayed

   !> A component between grid points `point` and `point` + 1.
   pure real(wp) function between(self, component, point, place, cubic) result(value)
      class(grid_type), intent(in) :: self
      integer, intent(in) :: component
      !> Number of the grid point on the left
      integer, intent(in) :: point
      !> Time in steps
      real(wp), intent(in) :: place
      logical, intent(in) :: cubic
      real(wp) :: change, s
      integer :: left, right

      left = modulo(point, self%points)
      right = modulo(point + 1, self%points)
      s = place - point
      value = self%y(component, left)
      if (.not. s > 0.0_wp) return
      change = self%y(component, right) - value
      value = value + s*change
      if (.not. cubic) return
      value = value + s*(1.0_wp - s)*((1.0_wp - s)*(self%h*self%slope(component, left) - change) &
                                      - s*(self%h*self%slope(component, right) - change))
   end function between

   !> The samples that lie in the step from grid point `step`.
   subroutine sample(grid, step, steps, t_end, sampler)
      !> The past, both ends of the step included
      type(grid_type), intent(in) :: grid
      integer, intent(in) :: step
      integer, intent(in) :: steps
      real(wp), intent(in) :: t_end
      class(sampler_type), intent(inout) :: sampler
      real(wp) :: place
      integer :: i

      do while (sampler%next <= t_end)
         place = sampler%next/grid%h
         if (place > step + 1 .and. step < steps - 1) exit
         call sampler%take([(grid%between(sampler%wanted(i), step, place, .true.), &
                             i=1, size(sampler%wanted))])
      end do
   end subroutine sample
end module fixed_step_rk4
