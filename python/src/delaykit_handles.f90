! SPDX-License-Identifier: BSD-3-Clause
!> What callers in C hold: models and results by handles, results read by names, messages as text.
module delaykit_handles
   use, intrinsic :: iso_c_binding, only: c_char, c_f_pointer, c_int, c_loc, c_null_char, &
                                          c_null_ptr, c_ptr
   use dde, only: error_type, methods, read_by_methods
   use model_library, only: open_object
   use model_problem, only: model_type
   use results, only: attribute_type, results_type, variable_type
   implicit none (type, external)
   private
   public :: message_of, model_of, string_of

contains

   !> Open a compiled model; 0 if it succeeded, else 1 with a message.
   integer(c_int) function dk_open(path, network, handle, message, length) result(status) bind(c)
      !> Paths of the object, and of the file of a network (generator/fortran/model_network.f90)
      type(c_ptr), value :: path, network
      !> The model
      type(c_ptr), intent(out) :: handle
      !> Room for a message and its size
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int), value :: length
      type(error_type), allocatable :: error
      type(model_type), pointer :: model

      allocate (model)
      call open_object(string_of(path), model, error, string_of(network))
      handle = c_loc(model)
      status = message_of(error, message, length)
   end function dk_open

   !> Give a model back.
   subroutine dk_close(handle) bind(c)
      type(c_ptr), value :: handle
      type(model_type), pointer :: model

      call c_f_pointer(handle, model)
      deallocate (model)
   end subroutine dk_close

   !> Give results back.
   subroutine dk_free(handle) bind(c)
      type(c_ptr), value :: handle
      type(results_type), pointer :: data

      call c_f_pointer(handle, data)
      deallocate (data)
   end subroutine dk_free

   !> The model of a handle, a copy.
   function model_of(handle) result(model)
      type(c_ptr), intent(in) :: handle
      type(model_type) :: model
      type(model_type), pointer :: held

      call c_f_pointer(handle, held)
      model = held
   end function model_of

   !> The values of a variable, and their number; null if there is none of this name.
   type(c_ptr) function dk_values(handle, name, length) result(address) bind(c)
      type(c_ptr), value :: handle, name
      integer(c_int), intent(out) :: length
      type(results_type), pointer :: data
      type(variable_type), pointer :: variable
      integer :: at

      call c_f_pointer(handle, data)
      address = c_null_ptr
      length = 0
      if (.not. allocated(data%variables)) return
      at = findloc(data%variables%name == string_of(name), .true., dim=1)
      if (at == 0) return
      variable => data%variables(at)
      if (allocated(variable%reals)) then
         length = size(variable%reals)
         if (length > 0) address = c_loc(variable%reals)
      else if (allocated(variable%integers)) then
         length = size(variable%integers)
         if (length > 0) address = c_loc(variable%integers)
      else
         length = len(variable%letters)
         if (length > 0) address = c_loc(variable%letters)
      end if
   end function dk_values

   !> What the results hold, a line each, words between tabs: `dimension NAME LENGTH`, `variable
   !> NAME KIND DIMENSION ...` with the slowest dimension first, and `attribute VARIABLE NAME KIND
   !> VALUE ...`, with no name of a variable where it belongs to the whole. The number of letters;
   !> they are written if there is room for them and a null character.
   integer(c_int) function dk_describe(handle, text, length) result(letters_needed) bind(c)
      type(c_ptr), value :: handle
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int), value :: length
      character(len=:), allocatable :: lines
      type(results_type), pointer :: data

      call c_f_pointer(handle, data)
      lines = description_of(data)
      letters_needed = len(lines)
      call copy(lines, text, length)
   end function dk_describe

   !> The methods of the solver, a line each: its name and, after a tab, what it reads of a model
   !> beside f: `jacobian`, `series`, or `f` alone. Returns and writes as dk_describe.
   integer(c_int) function dk_methods(text, length) result(letters_needed) bind(c)
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int), value :: length
      character(len=:), allocatable :: lines
      integer :: i

      lines = ""
      do i = 1, size(methods)
         lines = lines//trim(methods(i))//achar(9)//trim(read_by_methods(i))//new_line("a")
      end do
      letters_needed = len(lines)
      call copy(lines, text, length)
   end function dk_methods

   !> The lines of dk_describe.
   function description_of(data) result(lines)
      type(results_type), intent(in) :: data
      character(len=:), allocatable :: lines
      character(len=*), parameter :: tab = achar(9)
      integer :: i, k

      lines = ""
      if (allocated(data%dimensions)) then
         do i = 1, size(data%dimensions)
            associate (one => data%dimensions(i))
               lines = lines//"dimension"//tab//trim(one%name)//tab//digits(one%length) &
                       //new_line("a")
            end associate
         end do
      end if
      if (allocated(data%attributes)) call add("", data%attributes)
      if (.not. allocated(data%variables)) return
      do i = 1, size(data%variables)
         associate (one => data%variables(i))
            lines = lines//"variable"//tab//trim(one%name)//tab &
                    //kind_of(allocated(one%reals), allocated(one%integers))
            do k = size(one%dimensions), 1, -1
               lines = lines//tab//trim(data%dimensions(one%dimensions(k))%name)
            end do
            lines = lines//new_line("a")
            call add(trim(one%name), one%attributes)
         end associate
      end do

   contains

      !> Append lines of attributes.
      subroutine add(owner, attributes)
         character(len=*), intent(in) :: owner
         type(attribute_type), intent(in) :: attributes(:)
         integer :: j

         do j = 1, size(attributes)
            lines = lines//"attribute"//tab//owner//tab//trim(attributes(j)%name)//tab &
                    //kind_of(allocated(attributes(j)%number), &
                              allocated(attributes(j)%integers))//tab &
                    //value_of(attributes(j))//new_line("a")
         end do
      end subroutine add
   end function description_of

   !> The word for a kind of values.
   pure function kind_of(real_numbers, integers) result(word)
      !> Whether they are real numbers, or integers
      logical, intent(in) :: real_numbers, integers
      character(len=:), allocatable :: word

      word = "letters"
      if (real_numbers) word = "real"
      if (integers) word = "integer"
   end function kind_of

   !> The value of an attribute as words between tabs.
   function value_of(one) result(words)
      type(attribute_type), intent(in) :: one
      character(len=:), allocatable :: words
      character(len=40) :: number
      integer :: i

      words = ""
      if (allocated(one%text)) then
         words = one%text
      else if (allocated(one%number)) then
         write (number, "(es25.17e3)") one%number
         words = trim(adjustl(number))
      else
         do i = 1, size(one%integers)
            if (i > 1) words = words//achar(9)
            words = words//digits(one%integers(i))
         end do
      end if
   end function value_of

   !> An integer in digits.
   pure function digits(number) result(words)
      integer, intent(in) :: number
      character(len=:), allocatable :: words
      character(len=12) :: text

      write (text, "(i0)") number
      words = trim(text)
   end function digits

   !> 0, or 1 with the message of an error.
   integer(c_int) function message_of(error, message, length) result(status)
      !> The error
      type(error_type), allocatable, intent(in) :: error
      !> Room for its message and its size
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int), intent(in) :: length

      status = 0
      if (.not. allocated(error)) return
      status = 1
      call copy(error%message(:min(len(error%message), length - 1)), message, length)
   end function message_of

   !> Letters and a null character, if there is room.
   subroutine copy(line, text, length)
      character(len=*), intent(in) :: line
      character(kind=c_char), intent(inout) :: text(*)
      integer, intent(in) :: length
      integer :: i

      if (length <= len(line)) return
      do i = 1, len(line)
         text(i) = line(i:i)
      end do
      text(len(line) + 1) = c_null_char
   end subroutine copy

   !> A text that a caller owns.
   function string_of(address) result(words)
      type(c_ptr), intent(in) :: address
      character(len=:), allocatable :: words
      character(kind=c_char), pointer :: text(:)
      integer :: i, length

      call c_f_pointer(address, text, [huge(1)])
      length = 0
      do while (text(length + 1) /= c_null_char)
         length = length + 1
      end do
      allocate (character(len=length) :: words)
      do i = 1, length
         words(i:i) = text(i)
      end do
   end function string_of
end module delaykit_handles
