! SPDX-License-Identifier: BSD-3-Clause
!> What a run has computed so far.
module dde_work
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: work_type

   !> Additions and multiplications that cost as much as one evaluation by the explicit pair, for
   !> each equation.
   real(wp), parameter :: operations_of_evaluation = 200.0_wp

   !> Counts of one run. Methods add to the first three.
   type :: work_type
      !> Evaluations of the right-hand side, or of the Taylor series
      integer(int64) :: evaluations = 0
      !> Matrices factorised
      integer(int64) :: factorisations = 0
      !> Additions and multiplications of factorisations and solutions
      real(wp) :: operations = 0.0_wp
      !> Number of equations
      integer :: equations = 1
      !> Cost of one evaluation by the method in use
      real(wp), private :: cost = 1.0_wp
      !> Evaluations by earlier methods, and their cost
      integer(int64), private :: earlier_evaluations = 0
      real(wp), private :: earlier_cost = 0.0_wp
   contains
      procedure :: count_factors, in_systems, set_cost, total
   end type work_type

contains

   !> One more matrix is factorised.
   pure subroutine count_factors(self, operations)
      class(work_type), intent(inout) :: self
      !> Additions and multiplications
      real(wp), intent(in) :: operations

      self%factorisations = self%factorisations + 1
      self%operations = self%operations + operations
   end subroutine count_factors

   !> Another method takes over, whose evaluations have another cost.
   pure subroutine set_cost(self, cost)
      class(work_type), intent(inout) :: self
      !> Cost of one evaluation, in evaluations of the explicit pair
      real(wp), intent(in) :: cost

      self%earlier_cost = self%earlier_cost &
                          + self%cost*(self%evaluations - self%earlier_evaluations)
      self%earlier_evaluations = self%evaluations
      self%cost = cost
   end subroutine set_cost

   !> All work, in evaluations of the explicit pair.
   pure real(wp) function total(self) result(all_work)
      class(work_type), intent(in) :: self

      all_work = self%earlier_cost + self%cost*(self%evaluations - self%earlier_evaluations) &
                 + self%in_systems()
   end function total

   !> Work in linear systems, in evaluations of the explicit pair.
   pure real(wp) function in_systems(self) result(work)
      class(work_type), intent(in) :: self

      work = self%operations/(operations_of_evaluation*self%equations)
   end function in_systems
end module dde_work
