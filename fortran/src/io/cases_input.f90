!> Cases to measure, from the sections `cases`, `parameters` and `histories` of a namelist: one list
!> a key, one element a case.
module cases_input
   use block_parameters, only: block_history_type, block_parameters_type
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use measured_case, only: case_name_length, case_type
   use namelist_input, only: word_length
   use value_checks, only: check_number, missing
   implicit none (type, external)
   private
   public :: case_section_type, join_cases, keep_given, most_cases

   !> Most cases in one file.
   integer, parameter :: most_cases = 1000
   !> Most samples of a case.
   real(wp), parameter :: most_samples = 1.0e6_wp

   !> The section `cases`: of each case what is neither a parameter nor a history.
   type :: case_section_type
      !> Name
      character(len=word_length) :: name = ""
      !> Last time
      real(wp) :: t_end = missing
      !> Time between samples
      real(wp) :: sample_interval = missing
   end type case_section_type

contains

   !> Keep the cases that were given: those with a name.
   pure subroutine keep_given(cases, parameters, histories)
      !> The section `cases`
      type(case_section_type), allocatable, intent(inout) :: cases(:)
      !> The section `parameters`
      type(block_parameters_type), allocatable, intent(inout) :: parameters(:)
      !> The section `histories`
      type(block_history_type), allocatable, intent(inout) :: histories(:)
      integer :: n

      n = count(cases%name /= "")
      cases = cases(:n)
      parameters = parameters(:n)
      histories = histories(:n)
   end subroutine keep_given

   !> The cases with all that belongs to each; those that cannot be solved are refused.
   subroutine join_cases(path, cases, parameters, histories, joined, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The section `cases`
      type(case_section_type), intent(in) :: cases(:)
      !> The section `parameters`
      type(block_parameters_type), intent(in) :: parameters(:)
      !> The section `histories`
      type(block_history_type), intent(in) :: histories(:)
      !> The cases
      type(case_type), allocatable, intent(out) :: joined(:)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      integer :: i

      if (allocated(error)) return
      joined = [(case_type(cases(i)%name(:case_name_length), parameters(i), histories(i), &
                           cases(i)%t_end, cases(i)%sample_interval), i=1, size(cases))]
      if (size(joined) == 0) call raise(error, path//": name: no case; expected at least one")
      if (any(len_trim(cases%name) > case_name_length)) then
         call raise(error, path//": name of "//text(maxval(len_trim(cases%name))) &
                    //" letters; expected 1 to "//text(case_name_length))
      end if
      do i = 1, size(joined)
         call check_case(path//": case '"//trim(joined(i)%name)//"'", joined(i), error)
         if (allocated(error)) return
         if (any(joined(:i - 1)%name == joined(i)%name)) then
            call raise(error, path//": name = '"//trim(joined(i)%name) &
                       //"' twice; expected each once")
         end if
      end do
   end subroutine join_cases

   !> Refuse what cannot be solved.
   pure subroutine check_case(place, case, error)
      character(len=*), intent(in) :: place
      type(case_type), intent(in) :: case
      type(error_type), allocatable, intent(inout) :: error

      call case%parameters%check(place, error)
      call case%history%check(place, error)
      call check_number(error, place, "t_end", case%t_end, above=0.0_wp)
      call check_number(error, place, "sample_interval", case%sample_interval, above=0.0_wp, &
                        at_most=case%t_end)
      if (allocated(error)) return
      call check_number(error, place, "number of samples t_end/sample_interval", &
                        case%t_end/case%sample_interval, at_most=most_samples)
   end subroutine check_case
end module cases_input
