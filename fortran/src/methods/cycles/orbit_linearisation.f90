!> The collocation equations of a periodic orbit of x' = T f(x(s), z(s)), z = x_c(s - lag/T), made
!> linear about an approximation and solved on each interval.
module orbit_linearisation
   use dde, only: dde_problem_type, find_jacobian
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use lapack, only: solve
   use orbit_passes, only: orbit_passes_type
   use periodic_orbit, only: periodic_orbit_type
   use problem_family, only: free_family_type
   implicit none (type, external)
   private
   public :: linearise_orbit

   !> Share of its scale by which a parameter is changed for a derivative.
   real(wp), parameter :: difference = 1.0e-5_wp

   !> A problem of the family.
   type :: member_type
      !> The problem
      class(dde_problem_type), allocatable :: problem
   end type member_type

   !> Derivatives and residual at a collocation point.
   type :: point_type
      !> Derivatives of f by y and z
      real(wp), allocatable :: by_y(:, :), by_z(:, :)
      !> Forcings, shape (n, forcings)
      real(wp), allocatable :: forcing(:, :)
   end type point_type

contains

   !> The equations about an orbit.
   subroutine linearise_orbit(family, orbit, whole_past, self, error, further)
      !> Problems and free parameters
      type(free_family_type), intent(in) :: family
      !> The orbit
      type(periodic_orbit_type), intent(in) :: orbit
      !> Whether delays reach back over periods and no parameter is free, as is needed for
      !> multipliers; otherwise delays are taken modulo the period
      logical, intent(in) :: whole_past
      !> The equations
      type(orbit_passes_type), intent(out) :: self
      !> The right-hand side is not finite somewhere
      type(error_type), allocatable, intent(out) :: error
      !> Further forcings at the collocation points, shape (n, m, intervals, forcings); they follow
      !> those of the parameters
      real(wp), intent(in), optional :: further(:, :, :, :)
      class(dde_problem_type), allocatable :: problem
      type(member_type), allocatable :: beside(:, :)
      real(wp), allocatable :: local(:, :), parameters(:), place(:, :, :), right(:, :)
      integer :: first, forcings, i, p

      call family%problems%at(orbit%parameters, problem)
      allocate (beside(2, merge(0, size(family%free), whole_past)))
      do p = 1, size(beside, 2)
         do i = 1, 2
            parameters = orbit%parameters
            associate (moved => parameters(family%free(p)))
               moved = moved + (3 - 2*i)*difference*family%unit(p)
            end associate
            call family%problems%at(parameters, beside(i, p)%problem)
         end do
      end do
      self%n = problem%n
      self%degree = orbit%basis%degree
      self%intervals = orbit%intervals()
      call find_sources(self, problem, orbit, whole_past, place)
      associate (n => self%n, m => self%degree, delays => size(problem%lag))
         first = n + delays*m + 2 + size(beside, 2) + 1
         forcings = 0
         if (present(further)) forcings = size(further, 4)
         allocate (self%response(n*m, first - 1 + forcings, self%intervals))
         allocate (local(n*m, n*(m + 1)), right(n*m, size(self%response, 2)))
         do i = 1, self%intervals
            if (present(further)) right(:, first:) = reshape(further(:, :, i, :), [n*m, forcings])
            call local_system(self, problem, beside, orbit, place(:, :, i), i, local, right)
            call solve(local(:, n + 1:), right, self%response(:, :, i), error)
            if (allocated(error)) return
         end do
      end associate
      if (.not. all(abs(self%response) < huge(1.0_wp))) then
         call raise(error, "periodic orbit: a right-hand side or its derivative is not finite; " &
                    //"finite values expected")
      end if
   end subroutine linearise_orbit

   !> Where delayed values come from.
   subroutine find_sources(self, problem, orbit, whole_past, place)
      type(orbit_passes_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(periodic_orbit_type), intent(in) :: orbit
      logical, intent(in) :: whole_past
      !> Place in the interval of the source, shape (delays, m, intervals)
      real(wp), allocatable, intent(out) :: place(:, :, :)
      real(wp) :: back, s, sigma
      integer :: i, interval, k, l

      associate (m => self%degree, delays => size(problem%lag))
         allocate (self%delayed(0), self%row(delays))
         do l = 1, delays
            if (all(self%delayed /= problem%component(l))) then
               self%delayed = [self%delayed, problem%component(l)]
            end if
            self%row(l) = findloc(self%delayed, problem%component(l), dim=1)
         end do
         allocate (self%source(delays, m, self%intervals), place(delays, m, self%intervals))
         allocate (self%weight(m + 1, delays, m, self%intervals))
         do i = 1, self%intervals
            do k = 1, m
               s = orbit%mesh(i) + (orbit%mesh(i + 1) - orbit%mesh(i))*orbit%basis%point(k)
               do l = 1, delays
                  back = problem%lag(l)/orbit%period
                  if (.not. whole_past) back = back - floor(back)
                  sigma = s - back
                  call orbit%locate(sigma - floor(sigma), interval, place(l, k, i))
                  interval = interval + floor(sigma)*self%intervals
                  if (interval > i .or. back <= 0.0_wp) then
                     interval = i
                     place(l, k, i) = (sigma - orbit%mesh(i))/(orbit%mesh(i + 1) - orbit%mesh(i))
                  end if
                  self%source(l, k, i) = interval
               end do
            end do
         end do
         self%reach = 0
         if (delays > 0) self%reach = max(0, 1 - minval(self%source))
      end associate
   end subroutine find_sources

   !> Equations of an interval: local x = right (inputs), x all its nodes; the first n columns of
   !> local, those of the left end, are moved to the right.
   subroutine local_system(self, problem, beside, orbit, place, i, local, right)
      type(orbit_passes_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(member_type), intent(in) :: beside(:, :)
      type(periodic_orbit_type), intent(in) :: orbit
      !> Place in the interval of the source of delayed values, shape (delays, m)
      real(wp), intent(in) :: place(:, :)
      integer, intent(in) :: i
      real(wp), intent(out) :: local(:, :)
      !> Right-hand sides; those of further forcings are given
      real(wp), intent(inout) :: right(:, :)
      type(point_type) :: point
      real(wp) :: h, row_size(size(local, 1)), values(self%degree + 1)
      integer :: column, first, interval, j, k, l, last, r

      h = orbit%mesh(i + 1) - orbit%mesh(i)
      last = self%n + self%degree*size(problem%lag) + 2 + size(beside, 2)
      local = 0.0_wp
      right(:, :last) = 0.0_wp
      associate (n => self%n, m => self%degree, basis => orbit%basis, period => orbit%period)
         do k = 1, m
            r = (k - 1)*n
            call evaluate_point(self, problem, beside, orbit, place(:, k), i, k, point)
            do j = 1, m + 1
               column = (j - 1)*n
               local(r + 1:r + n, column + 1:column + n) = -period*basis%value(j, k)*point%by_y
               do l = 1, n
                  local(r + l, column + l) = local(r + l, column + l) + basis%slope(j, k)/h
               end do
            end do
            do l = 1, size(problem%lag)
               interval = self%source(l, k, i)
               first = modulo(interval - 1, self%intervals)*m
               values = basis%values_at(place(l, k))
               if (interval == i) then
                  ! the delayed value is one of this interval's own
                  do j = 1, m + 1
                     column = (j - 1)*n + problem%component(l)
                     local(r + 1:r + n, column) = local(r + 1:r + n, column) &
                                                  - period*values(j)*point%by_z(:, l)
                  end do
                  self%weight(:, l, k, i) = 0.0_wp
                  self%source(l, k, i) = 1
               else
                  column = n + (k - 1)*size(problem%lag) + l
                  right(r + 1:r + n, column) = period*point%by_z(:, l)
                  self%weight(:, l, k, i) = values
                  self%source(l, k, i) = (interval - 1 + self%reach)*m + 1
               end if
            end do
            right(r + 1:r + n, n + m*size(problem%lag) + 1:last) = point%forcing
         end do
         right(:, :n) = -local(:, :n)
         row_size = maxval(abs(local(:, n + 1:)), dim=2)
         do column = n + 1, size(local, 2)
            local(:, column) = local(:, column)/row_size
         end do
         do column = 1, size(right, 2)
            right(:, column) = right(:, column)/row_size
         end do
      end associate
   end subroutine local_system

   !> Derivatives and forcings at a collocation point.
   subroutine evaluate_point(self, problem, beside, orbit, place, i, k, point)
      type(orbit_passes_type), intent(in) :: self
      class(dde_problem_type), intent(in) :: problem
      type(member_type), intent(in) :: beside(:, :)
      type(periodic_orbit_type), intent(in) :: orbit
      !> Place of the sources of delayed values, shape (delays)
      real(wp), intent(in) :: place(:)
      integer, intent(in) :: i, k
      type(point_type), intent(inout) :: point
      real(wp) :: slope_z(size(place)), z(size(place))
      real(wp), dimension(self%n) :: f, f_above, f_below, y, y_slope
      integer :: first, from, l, p

      if (.not. allocated(point%by_y)) then
         allocate (point%by_y(self%n, self%n), point%by_z(self%n, size(place)))
         allocate (point%forcing(self%n, 2 + size(beside, 2)))
      end if
      associate (m => self%degree, basis => orbit%basis, mesh => orbit%mesh, period => orbit%period)
         first = (i - 1)*m
         y = matmul(orbit%nodes(:, first + 1:first + m + 1), basis%value(:, k))
         y_slope = matmul(orbit%nodes(:, first + 1:first + m + 1), basis%slope(:, k)) &
                   /(mesh(i + 1) - mesh(i))
         do l = 1, size(place)
            from = modulo(self%source(l, k, i) - 1, self%intervals) + 1
            first = (from - 1)*m
            associate (x => orbit%nodes(problem%component(l), first + 1:first + m + 1))
               z(l) = dot_product(x, basis%values_at(place(l)))
               slope_z(l) = dot_product(x, basis%slopes_at(place(l)))/(mesh(from + 1) - mesh(from))
            end associate
         end do
         call problem%rhs(0.0_wp, y, z, f)
         call find_full_jacobian(problem, y, z, point%by_y, point%by_z)
         point%forcing(:, 1) = period*f - y_slope
         point%forcing(:, 2) = period*f + matmul(point%by_z, slope_z*problem%lag)
         do p = 1, size(beside, 2)
            associate (above => beside(1, p)%problem, below => beside(2, p)%problem)
               call above%rhs(0.0_wp, y, z, f_above)
               call below%rhs(0.0_wp, y, z, f_below)
               point%forcing(:, 2 + p) = (period*(f_above - f_below) &
                                          - matmul(point%by_z, slope_z*(above%lag - below%lag))) &
                                         /(2.0_wp*difference)
            end associate
         end do
      end associate
   end subroutine evaluate_point

   !> The Jacobian as full matrices, also of a problem that gives it as a band.
   pure subroutine find_full_jacobian(problem, y, z, by_y, by_z)
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: y(:), z(:)
      !> Derivatives by y and z, shapes (n, n) and (n, delays)
      real(wp), intent(out) :: by_y(:, :), by_z(:, :)
      real(wp), allocatable :: band(:, :), columns(:, :)
      integer :: column, first, last

      if (problem%lower < 0) then
         call find_jacobian(problem, 0.0_wp, y, z, by_y, by_z)
         return
      end if
      associate (n => problem%n, upper => problem%upper, rows => problem%rows)
         allocate (band(1 + problem%lower + upper, n))
         allocate (columns(1 + maxval([0, rows(2, :) - rows(1, :)]), size(z)))
         call find_jacobian(problem, 0.0_wp, y, z, band, columns)
         by_y = 0.0_wp
         do column = 1, n
            first = max(1, column - upper)
            last = min(n, column + problem%lower)
            by_y(first:last, column) = band(1 + upper + first - column:1 + upper + last - column, &
                                            column)
         end do
         by_z = 0.0_wp
         do column = 1, size(z)
            by_z(rows(1, column):rows(2, column), column) &
               = columns(:1 + rows(2, column) - rows(1, column), column)
         end do
      end associate
   end subroutine find_full_jacobian
end module orbit_linearisation
