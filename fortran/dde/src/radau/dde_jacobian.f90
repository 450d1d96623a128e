! SPDX-License-Identifier: BSD-3-Clause
!> The Jacobian of a problem at one place. The problem gives it, or it is found by forward
!> differences. Columns that share no equation are moved together (Curtis, Powell and Reid 1974, "On
!> the estimation of sparse Jacobian matrices", J. Inst. Maths Applics 13, 117): a banded Jacobian
!> costs one evaluation for each diagonal.
module dde_jacobian
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_problem, only: dde_problem_type, not_given
   use dde_tolerance, only: tolerance_type
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: find_jacobian, jacobian_type

   !> Difference over the size of the component.
   real(wp), parameter :: difference = sqrt(epsilon(1.0_wp))
   !> Lower bounds on the size of a component: this share of (absolute tolerance / tolerance level),
   !> and this number.
   real(wp), parameter :: small_share = 1.0e-5_wp, least_size = 1.0e-140_wp

   !> Derivatives of the right-hand side.
   type :: jacobian_type
      !> By y: element (i, j) at (i, j), shape (n, n), or at (1 + upper + i - j, j) where it is
      !> banded, shape (1 + lower + upper, n)
      real(wp), allocatable :: by_y(:, :)
      !> By the delayed values, from the first row of each on, shape (most rows, delayed values)
      real(wp), allocatable :: by_z(:, :)
      !> First and last row of each delayed value, shape (2, delayed values)
      integer, allocatable :: rows(:, :)
      !> Whether the Jacobian by y is banded
      logical :: banded = .false.
      !> Diagonals below and above the main one
      integer :: lower = 0, upper = 0
      !> Whether `by_z` is known
      logical :: knows_delays = .false.
      !> False once the problem is known not to give it
      logical, private :: given = .true.
      !> The right-hand side at the place, and beside it, shape (n)
      real(wp), allocatable, private :: here(:), beside(:)
      !> Moved arguments, shapes (n) and (delayed values)
      real(wp), allocatable, private :: moved_y(:), moved_z(:)
      !> Number of the evaluation in which each delayed value is moved
      integer, allocatable, private :: group(:)
   contains
      procedure :: evaluate, find_norm, find_rows
      procedure, private :: group_delays, prepare
   end type jacobian_type

contains

   !> The Jacobian at a place, as the problem gives it or by forward differences.
   pure subroutine evaluate(self, problem, tolerance, work, t, y, z, with_delays, finite)
      class(jacobian_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      type(tolerance_type), intent(in) :: tolerance
      type(work_type), intent(inout) :: work
      real(wp), intent(in) :: t, y(:)
      !> Delayed values, shape (delayed values)
      real(wp), intent(in) :: z(:)
      logical, intent(in) :: with_delays
      logical, intent(out) :: finite
      integer :: apart, first, group, j, k, last, shift

      call self%prepare(problem)
      if (self%given) then
         call problem%jacobian(t, y, z, self%by_y, self%by_z)
         self%given = any(self%by_y > not_given) .or. .not. all(ieee_is_finite(self%by_y))
      end if
      self%knows_delays = with_delays .or. self%given
      if (.not. self%given) then
         call problem%rhs(t, y, z, self%here)
         work%evaluations = work%evaluations + 1
         ! columns that share no equation are moved together
         apart = merge(1 + self%lower + self%upper, problem%n, self%banded)
         do group = 1, min(apart, problem%n)
            self%moved_y = y
            do j = group, problem%n, apart
               self%moved_y(j) = y(j) + difference*size_of(tolerance, j, y(j))
            end do
            call problem%rhs(t, self%moved_y, z, self%beside)
            work%evaluations = work%evaluations + 1
            do j = group, problem%n, apart
               call self%find_rows(j, first, last, shift)
               self%by_y(shift + first:shift + last, j) &
                  = (self%beside(first:last) - self%here(first:last))/(self%moved_y(j) - y(j))
            end do
         end do
         do group = 1, merge(maxval(self%group), 0, with_delays)
            self%moved_z = merge(z + difference*size_of(tolerance, problem%component, z), z, &
                                 self%group == group)
            call problem%rhs(t, y, self%moved_z, self%beside)
            work%evaluations = work%evaluations + 1
            do k = 1, size(z)
               if (self%group(k) /= group) cycle
               first = self%rows(1, k)
               last = self%rows(2, k)
               self%by_z(:last - first + 1, k) &
                  = (self%beside(first:last) - self%here(first:last))/(self%moved_z(k) - z(k))
            end do
         end do
      end if
      finite = all(ieee_is_finite(self%by_y))
      if (finite .and. with_delays) finite = all(ieee_is_finite(self%by_z))
   end subroutine evaluate

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
      call here%evaluate(problem, tolerance_type(problem%n, 1.0_wp, 1.0_wp), work, t, y, z, &
                         .true., finite)
      by_y = here%by_y
      by_z = here%by_z
   end subroutine find_jacobian

   !> Storage, when it is first needed.
   pure subroutine prepare(self, problem)
      class(jacobian_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      integer :: k, most_rows

      if (allocated(self%by_y)) return
      associate (n => problem%n, delays => size(problem%lag))
         self%banded = problem%lower >= 0
         self%lower = merge(problem%lower, n - 1, self%banded)
         self%upper = merge(problem%upper, n - 1, self%banded)
         allocate (self%by_y(merge(1 + self%lower + self%upper, n, self%banded), n), source=0.0_wp)
         allocate (self%rows(2, delays), self%group(delays))
         self%rows(1, :) = 1
         self%rows(2, :) = n
         self%group = [(k, k=1, delays)]
         if (allocated(problem%rows)) then
            self%rows = problem%rows
            call self%group_delays()
         end if
         ! without delays as high as a full one: the problem may fill n rows of no columns
         most_rows = n
         if (delays > 0) most_rows = maxval(self%rows(2, :) - self%rows(1, :)) + 1
         allocate (self%by_z(most_rows, delays), source=0.0_wp)
         allocate (self%here(n), self%beside(n), self%moved_y(n), self%moved_z(delays))
      end associate
   end subroutine prepare

   !> Each delayed value joins the first group whose last one ends above its rows.
   pure subroutine group_delays(self)
      class(jacobian_type), intent(inout) :: self
      integer, allocatable :: end_of(:)
      integer :: group, k

      allocate (end_of(size(self%group)), source=0)
      do k = 1, size(self%group)
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

   !> The largest sum of a row of absolute values.
   pure subroutine find_norm(self, norm)
      class(jacobian_type), intent(inout) :: self
      real(wp), intent(out) :: norm
      integer :: first, j, last, shift

      associate (sums => self%beside)
         sums = 0.0_wp
         do j = 1, size(sums)
            call self%find_rows(j, first, last, shift)
            sums(first:last) = sums(first:last) + abs(self%by_y(shift + first:shift + last, j))
         end do
         norm = maxval(sums)
      end associate
   end subroutine find_norm
end module dde_jacobian
