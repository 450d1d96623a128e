! SPDX-License-Identifier: BSD-3-Clause
!> Cases to measure, from the section `cases` of a namelist, an element a case.
module cases_request
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use measured_case, only: case_type
   use model_description, only: word_length
   use model_history, only: read_history
   use model_settings, only: model_settings_type
   use request, only: elements, request_type
   use value_checks, only: absent, check_number, missing, most_samples
   implicit none (type, external)
   private
   public :: case_settings_type, lines_of_case, most_cases, open_cases

   !> Most cases in one file, lines of one in the copy of its namelist, and most states of a case.
   integer, parameter :: most_cases = 1000, lines_of_case = 60, most_states = 16

   !> The history of a case, as `&histories` has those of a scene.
   type :: histories_type
      !> Names of states or of their exponentials, and their values before the initial time
      character(len=word_length) :: names(most_states) = ""
      real(wp) :: values(most_states) = absent
   end type histories_type

   !> A case as the namelist gives it; all nondimensional.
   type :: case_settings_type
      !> Name
      character(len=256) :: name = ""
      !> The model with its parameters
      type(model_settings_type) :: model
      !> Its history
      type(histories_type) :: histories
      !> Last time, and time between samples
      real(wp) :: t_end = missing, sample_interval = missing
   end type case_settings_type

contains

   !> Open the models of cases. Refuse cases without a meaning; keep an earlier error.
   subroutine open_cases(given, settings, cases, error)
      class(request_type), intent(in) :: given
      !> The cases as they are given
      type(case_settings_type), intent(in) :: settings(:)
      type(case_type), allocatable, intent(out) :: cases(:)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: place
      integer :: i

      allocate (cases(size(settings)))
      do i = 1, size(settings)
         if (allocated(error)) return
         place = given%place//"case '"//trim(settings(i)%name)//"': "
         associate (one => settings(i), case => cases(i))
            case%name = one%name
            case%t_end = one%t_end
            case%sample_interval = one%sample_interval
            call one%model%open(place, case%model, error, opened=given%model)
            associate (past => one%histories)
               call read_history(place, case%model, pack(past%names, past%names /= ""), &
                                 elements(past%values), case%history, error)
            end associate
            call check_number(error, place, "t_end", one%t_end, at_least=0.0_wp)
            call check_number(error, place, "sample_interval", one%sample_interval, &
                              at_least=one%t_end/most_samples)
         end associate
      end do
   end subroutine open_cases
end module cases_request
