! SPDX-License-Identifier: BSD-3-Clause
!> The Jacobian of a problem at one place. The problem gives it, or it is found by forward
!> differences. Columns that share no equation are moved together (Curtis, Powell and Reid 1974, "On
!> the estimation of sparse Jacobian matrices", J. Inst. Maths Applics 13, 117): a banded Jacobian
!> costs one evaluation for each diagonal. Delayed values of one component and nearly equal delays
!> are moved together, too, and each gets their mean derivative: many delays cost 25 evaluations for
!> each factor of 10 between them.
module dde_jacobian
   use dde_problem, only: dde_problem_type, not_given
   use dde_tolerance, only: all_finite, tolerance_type
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: difference, find_jacobian, jacobian_type, size_of

   !> Difference over the size of the component.
   real(wp), parameter :: difference = sqrt(epsilon(1.0_wp))
   !> Lower bounds on the size of a component: this share of (absolute tolerance / tolerance level),
   !> and this number.
   real(wp), parameter :: small_share = 1.0e-5_wp, least_size = 1.0e-140_wp
   !> More than `few` delayed values share derivatives where delays are equal within this factor. In
   !> a difference quotient of delayed values each needs its own.
   integer, parameter :: few = 10
   real(wp), parameter :: alike = 1.1_wp

   !> Derivatives of the right-hand side.
   type :: jacobian_type
      !> By y: element (i, j) at (i, j), shape (n, n), or at (1 + upper + i - j, j) where it is
      !> banded, shape (1 + lower + upper, n)
      real(wp), allocatable :: by_y(:, :)
      !> Sums of the absolute values in each row of it, shape (n)
      real(wp), allocatable :: row_sums(:)
      !> By the delayed values, from the first row of each on, shape (most rows, delayed values)
      real(wp), allocatable :: by_z(:, :)
      !> First and last row of each delayed value, shape (2, delayed values)
      integer, allocatable :: rows(:, :)
      !> `by_z` is known for delays up to this one
      real(wp) :: known_to = 0.0_wp
      !> Whether the Jacobian by y is banded
      logical :: banded = .false.
      !> Diagonals below and above the main one
      integer :: lower = 0, upper = 0
      !> False once the problem is known not to give it
      logical, private :: given = .true.
      !> The right-hand side at the place, and beside it, shape (n)
      real(wp), allocatable, private :: here(:), beside(:)
      !> Moved arguments, shapes (n) and (delayed values)
      real(wp), allocatable, private :: moved_y(:), moved_z(:)
      !> Number of the evaluation in which each delayed value is moved, and how many share a
      !> derivative, at the first of them
      integer, allocatable, private :: group(:), shared(:)
   contains
      procedure :: evaluate, find_rows, add_moving
      procedure, private :: difference_by_y, difference_by_z, group_delays, prepare, sum_rows
   end type jacobian_type

contains

   !> The Jacobian at a place, as the problem gives it or by forward differences.
   pure subroutine evaluate(self, problem, tolerance, work, t, y, z, longest, finite)
      class(jacobian_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(tolerance_type), intent(in) :: tolerance
      type(work_type), intent(inout) :: work
      real(wp), intent(in) :: t
      real(wp), contiguous, intent(in) :: y(:)
      !> Delayed values, shape (delayed values)
      real(wp), contiguous, intent(in) :: z(:)
      !> Derivatives by delayed values are wanted for delays shorter than this
      real(wp), intent(in) :: longest
      logical, intent(out) :: finite

      if (.not. allocated(self%by_y)) then
         call self%prepare(problem, merge(alike, 0.0_wp, size(z) > few))
      end if
      if (self%given) then
         call problem%jacobian(t, y, z, self%by_y, self%by_z)
         if (self%by_y(1, 1) <= not_given) then
            self%given = .not. all(self%by_y <= not_given)
            if (.not. self%given) self%by_z = 0.0_wp
         end if
      end if
      self%known_to = merge(huge(1.0_wp), longest, self%given)
      if (.not. self%given) then
         call self%difference_by_y(problem, tolerance, work, t, y, z)
         call self%difference_by_z(problem, tolerance, work, t, y, z)
      end if
      call self%sum_rows()
      finite = all_finite(size(self%row_sums), self%row_sums)
      if (finite .and. longest > 0.0_wp) finite = all_finite(size(self%by_z), self%by_z)
   end subroutine evaluate

   !> Derivatives by y. Columns that share no equation are moved together.
   pure subroutine difference_by_y(self, problem, tolerance, work, t, y, z)
      class(jacobian_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(tolerance_type), intent(in) :: tolerance
      type(work_type), intent(inout) :: work
      real(wp), intent(in) :: t
      real(wp), contiguous, intent(in) :: y(:), z(:)
      real(wp) :: share
      integer :: apart, first, group, i, j, last, shift

      call problem%rhs(t, y, z, self%here)
      apart = min(problem%n, merge(1 + self%lower + self%upper, problem%n, self%banded))
      work%evaluations = work%evaluations + 1 + apart
      self%moved_y(:) = y
      do group = 1, apart
         do j = group, problem%n, apart
            self%moved_y(j) = y(j) + difference*size_of(tolerance, j, y(j))
         end do
         call problem%rhs(t, self%moved_y, z, self%beside)
         do j = group, problem%n, apart
            call self%find_rows(j, first, last, shift)
            share = 1.0_wp/(self%moved_y(j) - y(j))
            do i = first, last
               self%by_y(shift + i, j) = share*(self%beside(i) - self%here(i))
            end do
            self%moved_y(j) = y(j)
         end do
      end do
   end subroutine difference_by_y

   !> Derivatives by delayed values up to `known_to`, after those by y.
   pure subroutine difference_by_z(self, problem, tolerance, work, t, y, z)
      class(jacobian_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(tolerance_type), intent(in) :: tolerance
      type(work_type), intent(inout) :: work
      real(wp), intent(in) :: t, y(:), z(:)
      integer :: first, group, k, last

      if (.not. self%known_to > 0.0_wp) return
      do group = 1, maxval(self%group)
         if (.not. any(self%group == group .and. problem%lag < self%known_to)) cycle
         self%moved_z = merge(z + difference*size_of(tolerance, problem%component, z), z, &
                              self%group == group)
         call problem%rhs(t, y, self%moved_z, self%beside)
         work%evaluations = work%evaluations + 1
         do k = 1, size(z)
            if (self%group(k) /= group .or. self%shared(k) == 0) cycle
            first = self%rows(1, k)
            last = self%rows(2, k)
            associate (final => k + self%shared(k) - 1)
               self%by_z(:last - first + 1, k:final) &
                  = spread((self%beside(first:last) - self%here(first:last)) &
                           /sum(self%moved_z(k:final) - z(k:final)), 2, self%shared(k))
            end associate
         end do
      end do
   end subroutine difference_by_z

   !> Add to the derivatives by y those through delays that depend on it.
   pure subroutine add_moving(self, by_y)
      class(jacobian_type), intent(inout) :: self
      !> Derivatives by y of the last delayed values, shape (moving, n)
      real(wp), intent(in) :: by_y(:, :)
      integer :: first, i, j, k, last, moving, shift

      do j = 1, size(by_y, 2)
         call self%find_rows(j, first, last, shift)
         do moving = 1, size(by_y, 1)
            if (.not. abs(by_y(moving, j)) > 0.0_wp) cycle
            k = size(self%rows, 2) - size(by_y, 1) + moving
            do i = max(first, self%rows(1, k)), min(last, self%rows(2, k))
               self%by_y(shift + i, j) = self%by_y(shift + i, j) &
                                         + self%by_z(1 + i - self%rows(1, k), k)*by_y(moving, j)
            end do
         end do
      end do
      call self%sum_rows()
   end subroutine add_moving

   !> Rows of a column that may differ from 0: row i is at (shift + i, j).
   pure subroutine find_rows(self, j, first, last, shift)
      class(jacobian_type), intent(in) :: self
      integer, intent(in) :: j
      !> First and last row, and the shift of all rows
      integer, intent(out) :: first, last, shift

      first = 1
      last = size(self%by_y, 2)
      shift = 0
      if (.not. self%banded) return
      first = max(1, j - self%upper)
      last = min(last, j + self%lower)
      shift = 1 + self%upper - j
   end subroutine find_rows

   !> The Jacobian of a problem outside of a run, as the problem gives it or by differences.
   pure subroutine find_jacobian(problem, t, y, z, by_y, by_z)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Time
      real(wp), intent(in) :: t
      !> State, shape (n)
      real(wp), intent(in) :: y(:)
      !> Delayed values, shape (delayed values)
      real(wp), intent(in) :: z(:)
      !> Derivatives by y, shape (n, n), or that of a band
      real(wp), intent(out) :: by_y(:, :)
      !> Derivatives by the delayed values, shape (n or most rows, delayed values)
      real(wp), intent(out) :: by_z(:, :)
      type(jacobian_type) :: here
      type(work_type) :: work
      logical :: finite

      call problem%jacobian(t, y, z, by_y, by_z)
      if (any(by_y > not_given)) return
      here%given = .false.
      call here%prepare(problem, 0.0_wp)
      call here%evaluate(problem, tolerance_type(problem%n, 1.0_wp, 1.0_wp), work, t, y, z, &
                         huge(1.0_wp), finite)
      by_y = here%by_y
      by_z = here%by_z
   end subroutine find_jacobian

   !> Storage, when it is first needed.
   pure subroutine prepare(self, problem, ratio)
      class(jacobian_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      !> Delayed values share a derivative where their delays differ by less than this factor
      real(wp), intent(in) :: ratio
      integer :: most_rows

      associate (n => problem%n, delays => size(problem%lag))
         self%banded = problem%lower >= 0
         self%lower = merge(problem%lower, n - 1, self%banded)
         self%upper = merge(problem%upper, n - 1, self%banded)
         allocate (self%by_y(merge(1 + self%lower + self%upper, n, self%banded), n), source=0.0_wp)
         allocate (self%rows(2, delays))
         self%rows(1, :) = 1
         self%rows(2, :) = n
         if (allocated(problem%rows)) self%rows = problem%rows
         call self%group_delays(problem, ratio)
         ! without delays as high as a full one: the problem may fill n rows of no columns
         most_rows = n
         if (delays > 0) most_rows = maxval(self%rows(2, :) - self%rows(1, :)) + 1
         allocate (self%by_z(most_rows, delays), source=0.0_wp)
         allocate (self%here(n), self%beside(n), self%moved_y(n), self%moved_z(delays), &
                   self%row_sums(n))
      end associate
   end subroutine prepare

   !> A delayed value shares a derivative with the last one if they are of one component, of the
   !> same rows and of nearly equal delays. Otherwise it joins the first group that ends above its
   !> rows.
   pure subroutine group_delays(self, problem, ratio)
      class(jacobian_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      real(wp), intent(in) :: ratio
      integer, allocatable :: end_of(:)
      integer :: group, k, leader

      allocate (self%group(size(problem%lag)), self%shared(size(problem%lag)), source=0)
      allocate (end_of(size(problem%lag)), source=0)
      leader = 0
      do k = 1, size(problem%lag)
         if (leader > 0) then
            associate (lag => problem%lag([leader, k]))
               if (problem%component(k) == problem%component(leader) &
                   .and. all(self%rows(:, k) == self%rows(:, leader)) &
                   .and. maxval(lag) < ratio*minval(lag)) then
                  self%group(k) = self%group(leader)
                  self%shared(leader) = self%shared(leader) + 1
                  cycle
               end if
            end associate
         end if
         leader = k
         self%shared(k) = 1
         group = 1
         do while (end_of(group) >= self%rows(1, k))
            group = group + 1
         end do
         self%group(k) = group
         end_of(group) = self%rows(2, k)
      end do
   end subroutine group_delays

   !> Size of a component, to which its difference is proportional.
   elemental real(wp) function size_of(tolerance, i, value) result(size)
      type(tolerance_type), intent(in) :: tolerance
      integer, intent(in) :: i
      real(wp), intent(in) :: value

      size = max(abs(value), small_share*tolerance%absolute(i)/tolerance%level, &
                 least_size)
   end function size_of

   !> Sums of the absolute values in each row.
   pure subroutine sum_rows(self)
      class(jacobian_type), intent(inout) :: self
      integer :: first, i, j, last, shift

      if (.not. self%banded) then
         call sum_of_rows(size(self%row_sums), self%by_y, self%row_sums)
         return
      end if
      self%row_sums(:) = 0.0_wp
      do j = 1, size(self%row_sums)
         call self%find_rows(j, first, last, shift)
         do i = first, last
            self%row_sums(i) = self%row_sums(i) + abs(self%by_y(shift + i, j))
         end do
      end do
   end subroutine sum_rows

   !> Sums of the absolute values in each row of a full matrix.
   pure subroutine sum_of_rows(n, a, sums)
      integer, intent(in) :: n
      real(wp), intent(in) :: a(n, n)
      real(wp), intent(out) :: sums(n)
      integer :: j

      sums = 0.0_wp
      do j = 1, n
         sums = sums + abs(a(:, j))
      end do
   end subroutine sum_of_rows
end module dde_jacobian
