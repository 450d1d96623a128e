! SPDX-License-Identifier: BSD-3-Clause
!> A drug in gut and blood, swallowed every 12 hours, absorbed half an hour later:
!>
!>     gut' = -1.2 gut,   blood' = 1.2 gut(t - 1/2) - 0.15 blood.
!>
!> A dose is a jump between two runs. Exact: each dose adds 100 (1.2/1.05) (exp(-0.15 s) -
!> exp(-1.2 s)) a time s after its absorption has begun (Bateman 1910).
module drug_problem
   use dde, only: dde_problem_type, wp
   implicit none (type, external)
   private
   public :: drug

   !> The problem
   type, extends(dde_problem_type) :: drug
   contains
      procedure :: initial, history, rhs
   end type drug

contains

   pure subroutine initial(self, y)
      class(drug), intent(in) :: self
      real(wp), intent(out) :: y(self%n)
      y = [100.0_wp, 0.0_wp]
   end subroutine initial

   pure real(wp) function history(self, t, component) result(value)
      class(drug), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      value = 0.0_wp
   end function history

   pure subroutine rhs(self, t, y, z, dydt)
      class(drug), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      dydt = [-1.2_wp*y(1), 1.2_wp*z(1) - 0.15_wp*y(2)]
   end subroutine rhs
end module drug_problem

program doses_example
   use dde, only: continuation_type, error_type, integrate, integration_options, &
                  integration_result, wp
   use drug_problem, only: drug
   implicit none (type, external)
   type(continuation_type) :: state
   type(error_type), allocatable :: error
   type(integration_result) :: outcome
   real(wp) :: expected, s
   integer :: dose

   expected = 0.0_wp
   do dose = 0, 3
      if (dose > 0) call state%change_state(outcome%y + [100.0_wp, 0.0_wp], error)
      if (.not. allocated(error)) then
         call integrate(drug(n=2, lag=[0.5_wp], component=[1]), 12.0_wp*dose, 12.0_wp*(dose + 1), &
                        integration_options(), outcome, error, continuation=state)
      end if
      if (allocated(error)) error stop error%message
      s = 12.0_wp*(dose + 1) - 0.5_wp
      expected = expected + 100.0_wp*1.2_wp/1.05_wp*(exp(-0.15_wp*s) - exp(-1.2_wp*s))
      print "(a, f4.0, a, f13.8)", "after ", outcome%t, " h in the blood ", outcome%y(2)
      if (abs(outcome%y(2) - expected) > 1.0e-7_wp) error stop "expected the sum over all doses"
   end do
end program doses_example
