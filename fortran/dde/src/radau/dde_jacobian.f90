!> The Jacobian of a problem at one place. The problem gives it, or it is found by forward
!> differences. A banded Jacobian costs one evaluation for each diagonal (Curtis, Powell and Reid
!> 1974, "On the estimation of sparse Jacobian matrices", J. Inst. Maths Applics 13, 117).
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
      !> By the delayed values, shape (n, delayed values)
      real(wp), allocatable :: by_z(:, :)
      !> Whether the Jacobian by y is banded, its diagonals below and above the main one
      logical :: banded = .false.
      integer :: lower = 0, upper = 0
      !> Whether `by_z` is known
      logical :: knows_delays = .false.
      !> False once the problem is known not to give it
      logical, private :: given = .true.
      !> The right-hand side at the place, and beside it, shape (n)
      real(wp), allocatable, private :: here(:), beside(:)
      !> Moved arguments, shapes (n) and (delayed values)
      real(wp), allocatable, private :: moved_y(:), moved_z(:)
   contains
      procedure :: evaluate, find_norm, find_rows
      procedure, private :: prepare
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

      call self%prepare(problem, with_delays)
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
         do k = 1, merge(size(z), 0, with_delays)
            self%moved_z = z
            self%moved_z(k) = z(k) + difference*size_of(tolerance, problem%component(k), z(k))
            call problem%rhs(t, y, self%moved_z, self%beside)
            work%evaluations = work%evaluations + 1
            self%by_z(:, k) = (self%beside - self%here)/(self%moved_z(k) - z(k))
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
      !> The problem, its Jacobian not banded
      class(dde_problem_type), intent(in) :: problem
      !> Time
      real(wp), intent(in) :: t
      !> State, shape (n)
      real(wp), intent(in) :: y(:)
      !> Delayed values, shape (delayed values)
      real(wp), intent(in) :: z(:)
      !> Derivatives by y, shape (n, n)
      real(wp), intent(out) :: by_y(:, :)
      !> Derivatives by the delayed values, shape (n, delayed values)
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
   pure subroutine prepare(self, problem, with_delays)
      class(jacobian_type), intent(inout) :: self
      class(dde_problem_type), intent(in) :: problem
      logical, intent(in) :: with_delays

      if (.not. allocated(self%by_y)) then
         self%banded = problem%lower >= 0
         if (self%banded) then
            self%given = .false.
            self%lower = min(problem%lower, problem%n - 1)
            self%upper = min(problem%upper, problem%n - 1)
            allocate (self%by_y(1 + self%lower + self%upper, problem%n), source=0.0_wp)
         else
            allocate (self%by_y(problem%n, problem%n))
         end if
         allocate (self%here(problem%n), self%beside(problem%n), self%moved_y(problem%n))
         allocate (self%moved_z(size(problem%lag)))
      end if
      if ((with_delays .or. self%given) .and. .not. allocated(self%by_z)) then
         allocate (self%by_z(problem%n, size(problem%lag)))
      end if
   end subroutine prepare

   !> Size of a component, to which its difference is proportional.
   pure real(wp) function size_of(tolerance, i, value) result(size)
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
