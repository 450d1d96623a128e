!> Uncoupled copies of one equation, all but the first at rest: the first is solved as if it were
!> alone, however many they are.
module test_dde_copies
   use dde, only: dde_problem_type, integrate, integration_result
   use dde_errors, only: failure_type => error_type, text
   use dde_kinds, only: wp
   use expectations, only: expect, expect_close, expect_success
   use mctc_env_testing, only: error_type, new_unittest, unittest_type
   use solving, only: at_tolerance
   implicit none (type, external)
   private
   public :: collect_dde_copies

   !> y_i' = 1.8 y_i (1 - y_i(t - 1)), y_i = 1 up to t = 0 but for y_1 = 1.5.
   type, extends(dde_problem_type) :: logistic_copies
   contains
      procedure :: initial => first_differs
      procedure :: history => first_differed
      procedure :: rhs => logistic_rhs
      procedure :: series => logistic_series
      procedure :: past_series => constant_series
   end type logistic_copies

   !> y_i' = -1e4 (y_i - a_i cos t) - a_i sin t, y_i(0) = a_i: a_i cos t, with a = 1, 0, 0, ....
   type, extends(dde_problem_type) :: stiff_copies
   contains
      procedure :: initial => only_first
      procedure :: history => no_history
      procedure :: rhs => relax_to_cosine
   end type stiff_copies

   !> Methods, and copies of the delayed equation for each: implicit steps may be longer than the
   !> delay only with 64 delayed values at most.
   character(len=8), parameter :: methods(6) = [character(len=8) :: "explicit", "taylor", "auto", &
                                                "radau5", "radau9", "radau13"]
   integer, parameter :: copies(6) = [10000, 10000, 10000, 50, 50, 50]

contains

   !> All tests of this suite.
   subroutine collect_dde_copies(testsuite)
      type(unittest_type), allocatable, intent(out) :: testsuite(:)

      testsuite = [new_unittest("a delayed equation", test_delayed), &
                   new_unittest("a stiff equation", test_stiff)]
   end subroutine collect_dde_copies

   !> A limit cycle.
   subroutine test_delayed(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: digits, i

      do i = 1, size(methods)
         do digits = 4, 8, 2
            call compare(error, new_logistic(1), new_logistic(copies(i)), methods(i), &
                         10.0_wp**(-digits))
         end do
      end do
   end subroutine test_delayed

   !> A component that the embedded error of the implicit methods overlooks.
   subroutine test_stiff(error)
      type(error_type), allocatable, intent(out) :: error
      integer :: digits, i

      do i = 4, size(methods)
         do digits = 4, 8, 2
            call compare(error, new_stiff(1), new_stiff(60), methods(i), 10.0_wp**(-digits))
         end do
      end do
   end subroutine test_stiff

   !> The first of several copies is solved by the same steps as alone, and at rest stays at rest.
   subroutine compare(error, alone, among, method, tolerance)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> One copy
      class(dde_problem_type), intent(in) :: alone
      !> Several copies
      class(dde_problem_type), intent(in) :: among
      !> Method
      character(len=*), intent(in) :: method
      !> Relative and absolute tolerance
      real(wp), intent(in) :: tolerance
      type(failure_type), allocatable :: failure
      type(integration_result) :: first, known
      character(len=:), allocatable :: name

      name = trim(method)//" at "//text(tolerance)
      call integrate(alone, 0.0_wp, 20.0_wp, at_tolerance(tolerance, method), known, failure)
      call expect_success(error, failure)
      call integrate(among, 0.0_wp, 20.0_wp, at_tolerance(tolerance, method), first, failure)
      call expect_success(error, failure)
      if (allocated(error)) return
      call expect(error, first%accepted == known%accepted .and. first%rejected == known%rejected, &
                  name//": "//text(first%accepted)//" steps, "//text(first%rejected) &
                  //" rejected; alone "//text(known%accepted)//", "//text(known%rejected))
      call expect_close(error, first%y(1), known%y(1), 1.0e-3_wp*tolerance, name)
   end subroutine compare

   !> n copies.
   type(logistic_copies) function new_logistic(n) result(problem)
      integer, intent(in) :: n
      integer :: i

      problem%n = n
      allocate (problem%lag(n), source=1.0_wp)
      allocate (problem%component(n))
      do i = 1, n
         problem%component(i) = i
      end do
      problem%analytic = .true.
   end function new_logistic

   !> n copies.
   type(stiff_copies) function new_stiff(n) result(problem)
      integer, intent(in) :: n

      problem%n = n
      allocate (problem%lag(0), problem%component(0))
   end function new_stiff

   pure subroutine first_differs(self, y)
      class(logistic_copies), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = 1.0_wp
      y(1) = 1.5_wp
   end subroutine first_differs

   pure function first_differed(self, t, component) result(value)
      class(logistic_copies), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = merge(1.5_wp, 1.0_wp, component == 1)
   end function first_differed

   pure subroutine logistic_rhs(self, t, y, z, dydt)
      class(logistic_copies), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = 1.8_wp*y*(1.0_wp - z)
   end subroutine logistic_rhs

   pure subroutine logistic_series(self, t, unit, degree, z, y)
      class(logistic_copies), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: degree
      real(wp), intent(in) :: z(0:degree, size(self%lag))
      real(wp), intent(inout) :: y(0:degree, self%n)
      integer :: i, k

      do i = 1, self%n
         do k = 0, degree - 1
            y(k + 1, i) = unit/(k + 1)*1.8_wp*(y(k, i) - sum(y(0:k, i)*z(k:0:-1, i)))
         end do
      end do
   end subroutine logistic_series

   pure subroutine constant_series(self, t, component, unit, y)
      class(logistic_copies), intent(in) :: self
      real(wp), intent(in) :: t, unit
      integer, intent(in) :: component
      real(wp), intent(out) :: y(0:)

      y = 0.0_wp
      y(0) = self%history(t, component)
   end subroutine constant_series

   pure subroutine only_first(self, y)
      class(stiff_copies), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = 0.0_wp
      y(1) = 1.0_wp
   end subroutine only_first

   pure function no_history(self, t, component) result(value)
      class(stiff_copies), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = 0.0_wp
   end function no_history

   pure subroutine relax_to_cosine(self, t, y, z, dydt)
      class(stiff_copies), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = -1.0e4_wp*y
      dydt(1) = dydt(1) + 1.0e4_wp*cos(t) - sin(t)
   end subroutine relax_to_cosine
end module test_dde_copies
