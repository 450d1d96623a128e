! SPDX-License-Identifier: BSD-3-Clause
!> What a command is asked: the text of a namelist, of a file or of a caller, in memory. A command
!> reads one group of it, &settings, into variables of derived types: the keys are their components,
!> as scene%t_end. A component without a value keeps its default, `missing` where it must be given.
!> So each key stands once, in its type. Histories are a group of their own.
module request
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use model_description, only: model_length => word_length
   use model_history, only: history_type, read_history
   use model_problem, only: model_type
   use progress_receiver, only: progress_receiver_type
   use recorded_signal, only: signal_type
   use value_checks, only: absent, check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: ask, ask_for_keys, elements, element_length, request_type, word_length

   !> Length of a word in a namelist: far above any that is allowed, so that one too long is met and
   !> refused instead of cut.
   integer, parameter :: word_length = 256
   !> Length of a word in a list.
   integer, parameter :: element_length = 32
   !> Length and usual number of lines that hold a namelist with all its keys.
   integer, parameter :: line_length = 1024, usual_lines = 2000
   !> Most values of all histories, and most names.
   integer, parameter :: most_values = 1000000, most_names = 64
   !> The group.
   character(len=*), parameter :: group = "settings"

   !> A request. The group is read from `lines`, and then written to `copy`, by which `check` finds
   !> what was not given.
   type :: request_type
      !> What stands before messages: the file and a colon; nothing for a caller
      character(len=:), allocatable :: place
      !> The text
      character(len=:), allocatable :: lines(:)
      !> The model, where a caller has it open
      type(model_type), pointer :: model => null()
      !> Who is told how much is done
      class(progress_receiver_type), allocatable :: progress
      !> Whether the keys are wanted and no results: `check` fails then
      logical :: wants_keys = .false.
      !> I/O status and message of the read
      integer :: status = 0
      character(len=256) :: reason = ""
      !> All keys with the values read
      character(len=line_length), allocatable :: copy(:)
   contains
      procedure :: check, has, keys, make_room, read_histories, read_signal
   end type request_type

contains

   !> Begin a request with a text.
   subroutine ask(given, place, words)
      class(request_type), intent(inout) :: given
      !> What stands before messages
      character(len=*), intent(in) :: place
      !> The text, lines of any length
      character(len=*), intent(in) :: words
      character(len=*), parameter :: line_end = new_line("a")
      integer :: at, i, length, longest, number

      given%place = place
      do i = 1, 2
         at = 0
         longest = 1
         number = 0
         do while (at < len(words))
            length = index(words(at + 1:), line_end) - 1
            if (length < 0) length = len(words) - at
            longest = max(longest, length)
            number = number + 1
            if (i == 2) given%lines(number) = words(at + 1:at + length)
            at = at + length + 1
         end do
         if (i == 1) allocate (character(len=longest) :: given%lines(max(1, number)))
         if (i == 1) given%lines = ""
      end do
      call given%make_room(usual_lines)
      if (.not. allocated(given%progress)) allocate (progress_receiver_type :: given%progress)
   end subroutine ask

   !> Begin a request for the keys of a command.
   subroutine ask_for_keys(given)
      class(request_type), intent(inout) :: given

      call ask(given, "", "&"//group//" /")
      given%wants_keys = .true.
   end subroutine ask_for_keys

   !> Make room for all keys.
   subroutine make_room(self, lines)
      class(request_type), intent(inout) :: self
      !> Number of lines that hold them
      integer, intent(in) :: lines

      if (allocated(self%copy)) deallocate (self%copy)
      allocate (self%copy(lines))
   end subroutine make_room

   !> Refuse a group that could not be read, and numbers that are missing or not finite.
   subroutine check(self, error)
      class(request_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: key, values
      integer :: at, i

      if (self%status /= 0) call read_nothing()
      if (self%status < 0 .or. .not. self%has(group)) then
         call raise(error, self%place//"namelist group &"//group//": not in the text, a value of " &
                    //"another type, too many values, or no / at the end")
      else if (self%status > 0) then
         call raise(error, self%place//"namelist group &"//group//": "//trim(self%reason))
      else if (self%wants_keys) then
         call raise(error, "keys")
      end if
      do i = 2, findloc(self%copy, " /", dim=1) - 1
         if (allocated(error)) return
         at = index(self%copy(i), "=")
         if (at > 0) key = in_small_letters(trim(adjustl(self%copy(i) (:at - 1))))
         ! copied: gfortran 12 gives an associated name the length of the whole line
         values = self%copy(i) (at + 1:)
         if (index(values, """") > 0) cycle
         if (index(values, "NaN") > 0) then
            call raise(error, self%place//key//" = NaN; expected a finite number " &
                       //"(NaN: missing, or not a number)")
         else if (index(values, "Inf") > 0) then
            call raise(error, self%place//key//" = "//trim(adjustl(values)) &
                       //" expected a finite number")
         else if (index(values, text(missing_count)) > 0) then
            call raise(error, self%place//key//" is missing; expected a whole number")
         end if
      end do
   end subroutine check

   !> Whether the text has a group: a read of a text in memory that has it not does not fail.
   pure logical function has(self, name) result(there)
      class(request_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: i

      there = any([(index(adjustl(in_small_letters(self%lines(i))), "&"//name) == 1, &
                    i=1, size(self%lines))])
   end function has

   !> Read a text: after a read that met the end of a text in memory, gfortran reads nothing of the
   !> next one, and says that it did.
   subroutine read_nothing()
      character(len=20) :: line(1)
      integer :: number, status
      namelist /settings/ number

      line = "&"//group//" /"
      read (line, nml=settings, iostat=status)
   end subroutine read_nothing

   !> All keys with their values, a line each.
   function keys(self) result(lines)
      class(request_type), intent(in) :: self
      character(len=:), allocatable :: lines
      character(len=:), allocatable :: value
      integer :: at, i

      lines = ""
      do i = 2, findloc(self%copy, " /", dim=1) - 1
         at = index(self%copy(i), "=")
         value = trim(self%copy(i) (at + 1:))
         if (index(value, "NaN") > 0 .or. index(value, text(missing_count)) > 0) then
            value = "must be given"
         end if
         lines = lines//in_small_letters(self%copy(i) (:at))//" "//value//new_line("a")
      end do
   end function keys

   !> Read and check the histories of a model, the group &histories: `names` of states or of their
   !> exponentials, and their `values`, of one name after another, block after block, history after
   !> history.
   subroutine read_histories(self, model, history, error)
      class(request_type), intent(inout) :: self
      !> The model with its parameters; it gets the past of the first history
      type(model_type), intent(inout) :: model
      type(history_type), intent(out) :: history
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      character(len=model_length) :: names(most_names)
      real(wp), allocatable :: values(:)
      namelist /histories/ names, values

      if (allocated(error)) return
      names = ""
      allocate (values(most_values), source=absent)
      self%reason = "not in the text"
      self%status = merge(0, 1, self%has("histories"))
      if (self%status == 0) read (self%lines, nml=histories, iostat=self%status, iomsg=self%reason)
      if (self%status /= 0) then
         call read_nothing()
         call raise(error, self%place//"namelist group &histories: "//trim(self%reason) &
                    //"; expected names and values before the initial time")
         return
      end if
      call read_history(self%place, model, pack(names, names /= ""), elements(values), history, &
                        error)
      if (allocated(error)) return
      ! copies, since it sets these
      call model%set((model%numbers), history%past(model, 1), (model%keeps_delays))
   end subroutine read_histories

   !> Read a signal of evenly spaced samples, the group &signal. Only the program has files of them.
   subroutine read_signal(self, path, block, recorded, error)
      class(request_type), intent(in) :: self
      !> Path of a file, and number of the block of a chain; none where a caller gives the samples
      character(len=*), intent(in) :: path
      integer, intent(in) :: block
      type(signal_type), intent(out) :: recorded
      !> It cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=model_length) :: name
      character(len=256) :: reason
      real(wp) :: interval
      real(wp), allocatable :: values(:)
      integer :: i, status
      namelist /signal/ name, interval, values

      reason = "expected name, interval and values of a signal in the text"
      status = merge(0, 1, path == "" .and. block == 1 .and. self%has("signal"))
      name = ""
      interval = missing
      ! a number and what parts it from the next have two letters at least
      allocate (values(len(self%lines)*size(self%lines)/2), source=absent)
      if (status == 0) read (self%lines, nml=signal, iostat=status, iomsg=reason)
      if (status /= 0) then
         call read_nothing()
         call raise(error, self%place//path//"namelist group &signal: "//trim(reason))
      end if
      call check_number(error, self%place, "interval", interval, above=0.0_wp)
      recorded%signal = name
      recorded%v = elements(values)
      recorded%sample_interval = interval
      recorded%t = [(interval*(i - 1), i=1, size(recorded%v))]
   end subroutine read_signal

   !> Text in small letters.
   pure function in_small_letters(words) result(small)
      character(len=*), intent(in) :: words
      character(len=len(words)) :: small
      integer :: i

      small = words
      do i = 1, len(words)
         if (lge(words(i:i), "A") .and. lle(words(i:i), "Z")) then
            small(i:i) = achar(iachar(words(i:i)) + iachar("a") - iachar("A"))
         end if
      end do
   end function in_small_letters

   !> The elements of a list that were given.
   pure function elements(list) result(given)
      !> The list, `absent` beyond its last element
      real(wp), intent(in) :: list(:)
      real(wp), allocatable :: given(:)

      given = pack(list, list < absent)
   end function elements
end module request
