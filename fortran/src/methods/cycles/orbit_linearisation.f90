! SPDX-License-Identifier: BSD-3-Clause
!> The collocation equations of a periodic orbit of x' = T f(x(s), z(s)), z = x_c(s - lag/T), made
!> linear about an approximation and solved on each interval.
module orbit_linearisation
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use linear_system, only: find_full_jacobian
   use model_family, only: family_type
   use model_problem, only: model_type
   use orbit_passes, only: orbit_passes_type
   use periodic_orbit, only: periodic_orbit_type
   use small_systems, only: group, solve_equations
   implicit none (type, external)
   private
   public :: linearise_orbit

   !> Share of its scale by which a parameter is changed for a derivative.
   real(wp), parameter :: difference = 1.0e-5_wp

   !> A problem of the family.
   type :: member_type
      !> The problem
      class(model_type), allocatable :: problem
   end type member_type

   !> A collocation point: state, delayed values, and derivatives there.
   type :: point_type
      !> State and its derivative by s, shape (n)
      real(wp), allocatable :: y(:), y_slope(:)
      !> Delayed values and their derivatives by s, shape (delays)
      real(wp), allocatable :: z(:), z_slope(:)
      !> Derivatives of f by y and z
      real(wp), allocatable :: by_y(:, :), by_z(:, :)
      !> f, and f at parameters above and below, shape (n)
      real(wp), allocatable :: f(:), f_above(:), f_below(:)
      !> Forcings, shape (n, forcings)
      real(wp), allocatable :: forcing(:, :)
   end type point_type

contains

   !> The equations about an orbit.
   subroutine linearise_orbit(family, orbit, self, error, further)
      !> The model and its free parameters
      type(family_type), intent(in) :: family
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> The equations, with delays modulo the period
      type(orbit_passes_type), intent(out) :: self
      !> The right-hand side is not finite somewhere
      type(error_type), allocatable, intent(out) :: error
      !> Further forcings at the collocation points, shape (n, m, intervals, forcings); they follow
      !> those of the parameters
      real(wp), intent(in), optional :: further(:, :, :, :)
      class(model_type), allocatable :: problem
      type(member_type), allocatable :: beside(:, :)
      type(point_type) :: point
      real(wp), allocatable :: equations(:, :), parameters(:), slope(:, :, :, :)
      integer :: first, forcings, i, numbers, p
      logical :: singular

      call family%at(orbit%parameters, problem)
      allocate (beside(2, size(family%free)))
      do p = 1, size(beside, 2)
         do i = 1, 2
            parameters = orbit%parameters
            associate (moved => parameters(family%free(p)))
               moved = moved + (3 - 2*i)*difference*family%unit(p)
            end associate
            call family%at(parameters, beside(i, p)%problem)
         end do
      end do
      self%n = problem%n
      self%degree = orbit%basis%degree
      self%intervals = orbit%intervals()
      self%unit = orbit%unit
      call find_sources(self, problem, orbit, slope)
      forcings = 0
      if (present(further)) forcings = size(further, 4)
      associate (n => self%n, m => self%degree, delays => size(problem%lag), &
                 parameters_free => size(beside, 2))
         first = self%inputs() + 2 + parameters_free + 1
         allocate (self%response(first - 1 + forcings, n*m, self%intervals))
         numbers = n*m + size(self%response, 1)
         allocate (equations(group*((numbers + group - 1)/group), n*m))
         allocate (point%y(n), point%y_slope(n), point%f(n), point%f_above(n), point%f_below(n))
         allocate (point%z(delays), point%z_slope(delays), point%by_y(n, n))
         allocate (point%by_z(n, delays), point%forcing(n, 2 + parameters_free))
         do i = 1, self%intervals
            call set_equations(self, problem, beside, orbit, slope(:, :, :, i), i, point, &
                               equations)
            do p = 1, forcings
               equations(n*m + first - 1 + p, :) = reshape(further(:, :, i, p), [n*m])
            end do
            call solve_equations(n*m, size(equations, 1), equations, singular)
            if (singular) then
               call raise(error, "periodic orbit: the equations of interval "//text(i)//" of " &
                          //text(self%intervals)//" are singular; a regular matrix expected")
               return
            end if
            self%response(:, :, i) = equations(n*m + 1:numbers, :)
         end do
      end associate
      if (.not. all(abs(self%response) < huge(1.0_wp))) then
         call raise(error, "periodic orbit: a right-hand side or its derivative is not finite; " &
                    //"finite values expected")
      end if
   end subroutine linearise_orbit

   !> Where delayed values come from.
   subroutine find_sources(self, problem, orbit, slope)
      type(orbit_passes_type), intent(inout) :: self
      class(model_type), intent(in) :: problem
      type(periodic_orbit_type), intent(in) :: orbit
      !> Weights of the slope of a delayed value, by the place in its interval; as `weight`
      real(wp), allocatable, intent(out) :: slope(:, :, :, :)
      real(wp) :: place, s, sigma
      integer :: i, interval, k, l

      associate (m => self%degree, delays => size(problem%lag))
         allocate (self%delayed(0), self%row(delays))
         do l = 1, delays
            if (all(self%delayed /= problem%component(l))) then
               self%delayed = [self%delayed, problem%component(l)]
            end if
            self%row(l) = findloc(self%delayed, problem%component(l), dim=1)
         end do
         allocate (self%source(delays, m, self%intervals))
         allocate (self%later(delays, m, self%intervals), source=0)
         allocate (self%weight(m + 1, delays, m, self%intervals))
         allocate (slope(m + 1, delays, m, self%intervals))
         do i = 1, self%intervals
            do k = 1, m
               s = orbit%mesh(i) + (orbit%mesh(i + 1) - orbit%mesh(i))*orbit%basis%point(k)
               do l = 1, delays
                  sigma = s - problem%lag(l)/orbit%period
                  call orbit%locate(sigma - floor(sigma), interval, place)
                  interval = interval + floor(sigma)*self%intervals
                  if (interval > i .or. problem%lag(l) <= 0.0_wp) then
                     interval = i
                     place = (sigma - orbit%mesh(i))/(orbit%mesh(i + 1) - orbit%mesh(i))
                  else if (interval < i) then
                     self%later(l, k, i) = (i - 1 - interval)/self%intervals
                     interval = interval + self%later(l, k, i)*self%intervals
                  end if
                  self%source(l, k, i) = interval
                  self%weight(:, l, k, i) = orbit%basis%values_at(place)
                  slope(:, l, k, i) = orbit%basis%slopes_at(place)
               end do
            end do
         end do
         if (delays > 0) self%reach = max(0, 1 - minval(self%source))
      end associate
   end subroutine find_sources

   !> Equations of an interval, one a column: the factors of the nodes but the first, then those of
   !> the inputs on the right-hand side; those of further forcings are left.
   subroutine set_equations(self, problem, beside, orbit, slope, i, point, equations)
      type(orbit_passes_type), intent(inout) :: self
      class(model_type), intent(in) :: problem
      type(member_type), intent(in) :: beside(:, :)
      type(periodic_orbit_type), intent(in) :: orbit
      !> Weights of the slopes of delayed values, shape (m + 1, delays, m)
      real(wp), intent(in) :: slope(:, :, :)
      integer, intent(in) :: i
      type(point_type), intent(inout) :: point
      real(wp), intent(inout) :: equations(:, :)
      real(wp) :: factor, h
      integer :: c, column, j, k, l, r, right

      h = orbit%mesh(i + 1) - orbit%mesh(i)
      equations = 0.0_wp
      associate (n => self%n, m => self%degree, basis => orbit%basis, period => orbit%period)
         right = n*m
         do k = 1, m
            call evaluate_point(self, problem, beside, orbit, slope(:, :, k), i, k, point)
            do r = 1, n
               associate (equation => equations(:, (k - 1)*n + r))
                  do j = 1, m + 1
                     ! the left end is an input
                     column = merge(right, (j - 2)*n, j == 1)
                     factor = merge(1.0_wp, -1.0_wp, j == 1)*period*basis%value(j, k)
                     do c = 1, n
                        equation(column + c) = factor*point%by_y(r, c)
                     end do
                     equation(column + r) = equation(column + r) &
                                            + merge(-1.0_wp, 1.0_wp, j == 1)*basis%slope(j, k)/h
                  end do
                  do l = 1, size(problem%lag)
                     if (self%source(l, k, i) < i) then
                        column = right + n + (k - 1)*size(problem%lag) + l
                        equation(column) = period*point%by_z(r, l)
                        cycle
                     end if
                     ! the delayed value is one of this interval's own
                     do j = 1, m + 1
                        column = merge(right, (j - 2)*n, j == 1) + problem%component(l)
                        equation(column) = equation(column) + merge(1.0_wp, -1.0_wp, j == 1) &
                                           *period*self%weight(j, l, k, i)*point%by_z(r, l)
                     end do
                  end do
                  column = right + self%inputs()
                  equation(column + 1:column + size(point%forcing, 2)) = point%forcing(r, :)
               end associate
            end do
            do l = 1, size(problem%lag)
               if (self%source(l, k, i) == i) self%weight(:, l, k, i) = 0.0_wp
            end do
         end do
      end associate
   end subroutine set_equations

   !> Derivatives and forcings at a collocation point.
   subroutine evaluate_point(self, problem, beside, orbit, slope, i, k, point)
      type(orbit_passes_type), intent(in) :: self
      class(model_type), intent(in) :: problem
      type(member_type), intent(in) :: beside(:, :)
      type(periodic_orbit_type), intent(in) :: orbit
      !> Weights of the slopes of delayed values, shape (m + 1, delays)
      real(wp), intent(in) :: slope(:, :)
      integer, intent(in) :: i, k
      type(point_type), intent(inout) :: point
      integer :: first, from, j, l, p

      associate (m => self%degree, basis => orbit%basis, mesh => orbit%mesh, &
                 period => orbit%period, y => point%y, z => point%z)
         first = (i - 1)*m
         y = 0.0_wp
         point%y_slope = 0.0_wp
         do j = 1, m + 1
            y = y + basis%value(j, k)*orbit%nodes(:, first + j)
            point%y_slope = point%y_slope + basis%slope(j, k)/(mesh(i + 1) - mesh(i)) &
                            *orbit%nodes(:, first + j)
         end do
         do l = 1, size(z)
            from = modulo(self%source(l, k, i) - 1, self%intervals) + 1
            first = (from - 1)*m
            z(l) = 0.0_wp
            point%z_slope(l) = 0.0_wp
            do j = 1, m + 1
               associate (x => orbit%nodes(problem%component(l), first + j))
                  z(l) = z(l) + x*self%weight(j, l, k, i)
                  point%z_slope(l) = point%z_slope(l) + x*slope(j, l)/(mesh(from + 1) - mesh(from))
               end associate
            end do
         end do
         call problem%rhs(0.0_wp, y, z, point%f)
         call find_full_jacobian(problem, y, z, point%by_y, point%by_z)
         point%forcing(:, 1) = period*point%f - point%y_slope
         point%forcing(:, 2) = period*point%f
         do l = 1, size(z)
            point%forcing(:, 2) = point%forcing(:, 2) &
                                  + point%z_slope(l)*problem%lag(l)*point%by_z(:, l)
         end do
         do p = 1, size(beside, 2)
            associate (above => beside(1, p)%problem, below => beside(2, p)%problem, &
                       forcing => point%forcing(:, 2 + p))
               call above%rhs(0.0_wp, y, z, point%f_above)
               call below%rhs(0.0_wp, y, z, point%f_below)
               forcing = period*(point%f_above - point%f_below)
               do l = 1, size(z)
                  forcing = forcing &
                            - point%z_slope(l)*(above%lag(l) - below%lag(l))*point%by_z(:, l)
               end do
               forcing = forcing/(2.0_wp*difference)
            end associate
         end do
      end associate
   end subroutine evaluate_point
end module orbit_linearisation
