! SPDX-License-Identifier: BSD-3-Clause
!> The solver for a model of your own: Mackey and Glass's equation (1977),
!>
!>     y' = 0.2 y(t - 17)/(1 + y(t - 17)^10) - 0.1 y,   y = 1.2 for t <= 0.
module mackey_glass_problem
   use dde, only: dde_problem_type, wp
   implicit none (type, external)
   private
   public :: mackey_glass

   !> The problem; its parameters would be further components.
   type, extends(dde_problem_type) :: mackey_glass
   contains
      procedure :: initial
      procedure :: history
      procedure :: rhs
   end type mackey_glass

contains

   pure subroutine initial(self, y)
      class(mackey_glass), intent(in) :: self
      real(wp), intent(out) :: y(self%n)
      y = 1.2_wp
   end subroutine initial

   pure real(wp) function history(self, t, component) result(value)
      class(mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      value = 1.2_wp
   end function history

   pure subroutine rhs(self, t, y, z, dydt)
      class(mackey_glass), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)
      dydt = 0.2_wp*z/(1.0_wp + z**10) - 0.1_wp*y
   end subroutine rhs
end module mackey_glass_problem

program mackey_glass_example
   use dde, only: error_type, integrate, integration_options, integration_result, &
                  table_sampler, wp
   use mackey_glass_problem, only: mackey_glass
   implicit none (type, external)
   type(error_type), allocatable :: error
   type(integration_result) :: outcome
   type(table_sampler) :: table
   integer :: i

   table = table_sampler([1], [(50.0_wp*i, i=0, 4)])
   call integrate(mackey_glass(n=1, lag=[17.0_wp], component=[1]), 0.0_wp, 200.0_wp, &
                  integration_options(relative=1.0e-10_wp, absolute=1.0e-10_wp), &
                  outcome, error, table)
   if (allocated(error)) error stop error%message
   print "(f6.1, f14.9)", (table%time(i), table%values(1, i), i=1, table%received)
   ! published
   if (any(abs(table%values(1, 2:5:3) - [1.060954362898_wp, 1.186718107117_wp]) > 1.0e-8_wp)) then
      error stop "expected 1.060954363 and 1.186718107"
   end if
end program mackey_glass_example
