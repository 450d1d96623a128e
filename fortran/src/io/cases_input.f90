!> Cases to measure, from the section `cases` of a namelist, an element a case.
module cases_input
   use block_parameters, only: missing_history, missing_parameters
   use dde_errors, only: error_type
   use measured_case, only: case_type
   use value_checks, only: check_number, missing, most_samples
   implicit none (type, external)
   private
   public :: check_cases, missing_case, most_cases

   !> Most cases in one file.
   integer, parameter :: most_cases = 1000
   !> A case that must be given, and has no name before.
   type(case_type), parameter :: &
      missing_case = case_type("", missing_parameters, missing_history, missing, missing)

contains

   !> Refuse cases without a meaning; keep an earlier error.
   subroutine check_cases(path, cases, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The cases
      type(case_type), intent(inout) :: cases(:)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      integer :: i

      do i = 1, size(cases)
         call cases(i)%parameters%check(path//": case '"//trim(cases(i)%name)//"'", error)
         call cases(i)%history%check(path//": case '"//trim(cases(i)%name)//"'", error)
         call check_number(error, path//": case '"//trim(cases(i)%name)//"'", "sample_interval", &
                           cases(i)%sample_interval, at_least=cases(i)%t_end/most_samples)
      end do
   end subroutine check_cases
end module cases_input
