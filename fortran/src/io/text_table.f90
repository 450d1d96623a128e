! SPDX-License-Identifier: BSD-3-Clause
!> Results over one dimension as a table of text, which appears only when it is complete: a column a
!> variable, with tabs between them. Real numbers have 20 digits, more than double precision holds.
module text_table
   use dde_errors, only: text
   use results, only: written_type
   use unfinished_file, only: unfinished_type
   implicit none (type, external)
   private
   public :: text_table_type

   !> Between columns, and between rows.
   character(len=*), parameter :: tab = achar(9), line_end = new_line("a")
   !> Letters that hold a number.
   integer, parameter :: number_length = 40

   !> A table.
   type, extends(written_type) :: text_table_type
      private
      !> Where it stands
      type(unfinished_type) :: place
   contains
      procedure :: begin, finish, discard
      procedure, private :: cell, width
   end type text_table_type

contains

   !> Begin the file: another run of the same path sees it.
   subroutine begin(self)
      class(text_table_type), intent(inout) :: self

      call self%place%begin(self%path, self%error)
   end subroutine begin

   !> Write the table.
   subroutine finish(self)
      class(text_table_type), intent(inout) :: self
      character(len=:), allocatable :: content
      integer :: i, k, rows, used, width

      associate (first => self%variables(1)%dimensions)
         rows = self%dimensions(first(size(first)))%length
      end associate
      width = sum([(1 + self%width(k), k=1, size(self%variables))])
      allocate (character(len=(rows + 1)*width) :: content)
      used = 0
      do i = 0, rows
         do k = 1, size(self%variables)
            call append(self%cell(i, k)//merge(tab, line_end, k < size(self%variables)))
         end do
      end do
      call self%place%publish(content(:used), self%error)

   contains

      !> Append to the content.
      subroutine append(words)
         character(len=*), intent(in) :: words

         content(used + 1:used + len(words)) = words
         used = used + len(words)
      end subroutine append
   end subroutine finish

   !> Letters that hold any cell of a column.
   pure integer function width(self, column) result(letters)
      class(text_table_type), intent(in) :: self
      integer, intent(in) :: column

      associate (variable => self%variables(column))
         letters = max(number_length, len_trim(variable%name))
         if (size(variable%dimensions) > 1) then
            letters = max(letters, self%dimensions(variable%dimensions(1))%length)
         end if
      end associate
   end function width

   !> A cell; in row 0 the name of the column.
   pure function cell(self, row, column) result(words)
      class(text_table_type), intent(in) :: self
      integer, intent(in) :: row, column
      character(len=:), allocatable :: words
      character(len=number_length) :: number
      integer :: length

      associate (variable => self%variables(column))
         if (row == 0) then
            words = trim(variable%name)
         else if (allocated(variable%letters)) then
            length = self%dimensions(variable%dimensions(1))%length
            words = variable%letters(length*(row - 1) + 1:length*row)
            words = words(:verify(words, achar(0), back=.true.))
         else
            write (number, "(es0."//text(variable%digits)//"e4)") variable%reals(row)
            words = trim(number)
         end if
      end associate
   end function cell

   !> Leave nothing behind.
   subroutine discard(self)
      class(text_table_type), intent(inout) :: self

      call self%place%discard()
   end subroutine discard
end module text_table
