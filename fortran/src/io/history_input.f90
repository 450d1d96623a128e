! SPDX-License-Identifier: BSD-3-Clause
!> Histories, from the namelist group `history` of a file.
module history_input
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use model_description, only: word_length
   use model_history, only: history_type, read_history
   use model_problem, only: model_type
   use namelist_input, only: elements, help
   use value_checks, only: absent
   implicit none (type, external)
   private
   public :: read_histories

   !> Most values of all histories, and most names.
   integer, parameter :: most_values = 1000000, most_names = 64

contains

   !> Read and check the histories of a model: `names` of states or of their exponentials, and their
   !> `values`, of one name after another, block after block, history after history. A model with a
   !> history of its own has none in the file.
   subroutine read_histories(path, model, history, error)
      character(len=*), intent(in) :: path
      !> The model with its parameters; it gets the past of the first history
      type(model_type), intent(inout) :: model
      type(history_type), intent(out) :: history
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      character(len=word_length) :: names(most_names)
      character(len=256) :: reason
      real(wp), allocatable :: values(:)
      integer :: status, unit
      namelist /histories/ names, values

      if (allocated(error) .or. path == help) return
      names = ""
      allocate (values(most_values), source=absent)
      open (newunit=unit, file=path, status="old", action="read", iostat=status, iomsg=reason)
      if (status == 0) read (unit, nml=histories, iostat=status, iomsg=reason)
      close (unit)
      if (status /= 0) then
         call raise(error, path//": namelist group &histories: "//trim(reason) &
                    //"; expected names and values before the initial time")
         return
      end if
      call read_history(path, model, pack(names, names /= ""), elements(values), history, error)
      if (allocated(error)) return
      ! copies, since it sets these
      call model%set((model%numbers), history%past(model, 1), (model%keeps_delays))
   end subroutine read_histories
end module history_input
