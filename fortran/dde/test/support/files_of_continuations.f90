!> Continuations on disk, as a user may keep them.
module files_of_continuations
   use dde, only: continuation_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: through_file

contains

   !> What comes back from a file that was written and read.
   function through_file(kept, formatted) result(back)
      !> The continuation, filled
      type(continuation_type), intent(in) :: kept
      !> Whether the file is text, with all digits, or bits
      logical, intent(in) :: formatted
      type(continuation_type) :: back
      integer :: sizes(5), unit

      sizes = [size(kept%y), size(kept%passages), size(kept%kept), shape(kept%nodes)]
      allocate (back%y(sizes(1)), back%slope(sizes(1)), back%rate(sizes(1)))
      allocate (back%kink(2, sizes(2)), back%passages(sizes(2)), back%generation(sizes(2)))
      allocate (back%kept(sizes(3)))
      allocate (back%step_start(2, sizes(5)), back%step_length(sizes(5)), &
                   back%valid_for(sizes(5)))
      allocate (back%nodes(sizes(4), sizes(5)), back%coefficients(1 + sizes(4), sizes(3), sizes(5)))
      if (formatted) then
         open (newunit=unit, status="scratch", action="readwrite", form="formatted")
         write (unit, "(*(es27.17e4))") kept%time, kept%origin, kept%y, kept%slope, kept%rate, &
            kept%next_step, kept%kink, kept%step_start, kept%step_length, kept%valid_for, &
            kept%nodes, kept%coefficients
         write (unit, "(a, *(1x, i0))") kept%method, kept%passages, kept%generation, kept%kept
         rewind (unit)
         read (unit, *) back%time, back%origin, back%y, back%slope, back%rate, &
            back%next_step, back%kink, back%step_start, back%step_length, back%valid_for, &
            back%nodes, back%coefficients
         read (unit, *) back%method, back%passages, back%generation, back%kept
      else
         open (newunit=unit, status="scratch", action="readwrite", form="unformatted")
         write (unit) kept%time, kept%origin, kept%y, kept%slope, kept%rate, kept%next_step, &
            kept%kink, kept%step_start, kept%step_length, kept%valid_for, kept%nodes, &
            kept%coefficients, kept%method, kept%passages, kept%generation, kept%kept
         rewind (unit)
         read (unit) back%time, back%origin, back%y, back%slope, back%rate, back%next_step, &
            back%kink, back%step_start, back%step_length, back%valid_for, back%nodes, &
            back%coefficients, back%method, back%passages, back%generation, back%kept
      end if
      close (unit)
   end function through_file
end module files_of_continuations
