!> Namelist groups whose keys are spoiled one by one, and what their reader must answer.
module namelist_refusals
   use, intrinsic :: ieee_exceptions, only: ieee_invalid, ieee_set_flag, ieee_set_halting_mode
   use dde_errors, only: failure_type => error_type
   use expectations, only: expect, expect_failure, expect_success
   use mctc_env_testing, only: error_type
   implicit none (type, external)
   private
   public :: above_0, above_minus_1, expect_refusals, from_0, from_0_count, from_1, from_2
   public :: line_length, of_block, of_spectrum, of_tolerance, spoiled_key

   !> Length of a line of a namelist group.
   integer, parameter :: line_length = 64
   !> File that the readers read.
   character(len=*), parameter :: path = "namelist_refusals.nml"

   !> A value that is refused.
   type :: spoiled_key
      !> Key
      character(len=24) :: key
      !> The value as it stands in the file
      character(len=160) :: value
      !> Words of the message
      character(len=96) :: words
   end type spoiled_key

   !> Words of ranges.
   character(len=*), parameter :: above_0 = "; expected a finite number > 0.0"
   character(len=*), parameter :: from_0 = "; expected a finite number >= 0.0"
   character(len=*), parameter :: above_minus_1 = "; expected a finite number > -1.0"
   character(len=*), parameter :: tolerances = "; expected a finite number >= 1.0E-013 <= 0.01"
   character(len=*), parameter :: from_1 = "; expected a whole number >= 1"
   character(len=*), parameter :: from_2 = "; expected a whole number >= 2"
   character(len=*), parameter :: from_0_count = "; expected a whole number >= 0"

   !> Refused values of the four parameters of the block.
   type(spoiled_key), parameter :: of_block(*) = [ &
      spoiled_key("tau", "-1.0", "tau = -1.0"//from_0), &
      spoiled_key("epsilon", "-1.0", "epsilon = -1.0"//above_minus_1), &
      spoiled_key("epsilon", "-2.0", "epsilon = -2.0"//above_minus_1), &
      spoiled_key("xi", "0.0", "xi = 0.0"//above_0), &
      spoiled_key("xi", "-1.0", "xi = -1.0"//above_0), &
      spoiled_key("gamma", "0.0", "gamma = 0.0"//above_0), &
      spoiled_key("gamma", "-1.0", "gamma = -1.0"//above_0)]
   !> Refused tolerances.
   type(spoiled_key), parameter :: of_tolerance(*) = [ &
      spoiled_key("tolerance", "0.0", "tolerance = 0.0"//tolerances), &
      spoiled_key("tolerance", "9.9e-14", "tolerance = 9.9E-014"//tolerances), &
      spoiled_key("tolerance", "0.0101", "tolerance = 0.0101"//tolerances)]

   !> Refused settings of a spectrum.
   type(spoiled_key), parameter :: of_spectrum(*) = [ &
      spoiled_key("window", "'other'", "window = 'other'; expected one of 'hann' 'boxcar'"), &
      spoiled_key("segments", "0", "segments = 0"//from_1), &
      spoiled_key("overlap", "-0.1", "overlap = -0.1"//from_0//" < 1.0"), &
      spoiled_key("overlap", "1.0", "overlap = 1.0"//from_0//" < 1.0"), &
      spoiled_key("peak_floor", "0.0", "peak_floor = 0.0"//above_0//" <= 1.0"), &
      spoiled_key("peak_floor", "1.1", "peak_floor = 1.1"//above_0//" <= 1.0"), &
      spoiled_key("peak_prominence", "0.9", "peak_prominence = 0.9; expected a finite")]

   interface
      !> Reads a file and keeps nothing but the error.
      subroutine reader_type(path, failure)
         import :: failure_type
         implicit none (type, external)
         !> Path of the file
         character(len=*), intent(in) :: path
         !> Why it is refused
         type(failure_type), allocatable, intent(out) :: failure
      end subroutine reader_type
   end interface

contains

   !> Good lines are accepted. The message says what is wrong with a file that is not there, without
   !> the group, with an unknown key, without one of the keys, with one of them twice, with a number
   !> that is not finite or is text, and with the values of the table.
   subroutine expect_refusals(error, reader, group, lines, spoiled)
      !> The first failure of the test
      type(error_type), allocatable, intent(inout) :: error
      !> Reads the file
      procedure(reader_type) :: reader
      !> Name of the group
      character(len=*), intent(in) :: group
      !> Its lines `key = value`; none of the keys has a default
      character(len=*), intent(in) :: lines(:)
      !> Values that are refused
      type(spoiled_key), intent(in) :: spoiled(:)
      type(failure_type), allocatable :: failure
      character(len=:), allocatable :: key
      logical :: kept(size(lines))
      integer :: i, j, reals

      call ask(reader, "no-such-file.nml", failure)
      call expect_failure(error, failure, "no-such-file.nml: ")
      call read_lines(reader, group, "", lines, failure)
      call expect_success(error, failure)
      call read_lines(reader, "other", "", lines, failure)
      call expect_failure(error, failure, path//": no complete namelist group &"//group//" in it")
      call read_lines(reader, group, "colour = 1.0", lines, failure)
      call expect_failure(error, failure, path//": namelist group &"//group//": ")
      call expect_failure(error, failure, "colour")
      reals = 0
      do i = 1, size(lines)
         key = key_of(lines(i))
         kept = lines /= lines(i)
         call read_lines(reader, group, "", pack(lines, kept), failure)
         call expect_failure(error, failure, key)
         call read_lines(reader, group, trim(lines(i)), lines, failure)
         call expect_failure(error, failure, path//": namelist group &"//group//": "//key &
                             //" stands in lines 2 and ")
         if (index(lines(i), ".") == 0 .or. index(lines(i), "'") > 0) cycle
         reals = reals + 1
         call read_spoiled("'much'")
         call expect_failure(error, failure, path//": ")
         call expect_failure(error, failure, "namelist group &"//group)
         call expect_not_finite("NaN", "NaN")
         call expect_not_finite("Infinity", "Inf")
         call expect_not_finite("-Infinity", "-Inf")
      end do
      call expect(error, reals > 0, "&"//group//" has real numbers")
      do i = 1, size(spoiled)
         key = trim(spoiled(i)%key)
         call expect(error, any([(key_of(lines(j)) == key, j=1, size(lines))]), &
                     key//" is a key of &"//group)
         ! a value may be followed by other keys
         kept = [(index(", "//key//" = "//trim(spoiled(i)%value), &
                        ", "//key_of(lines(j))//" = ") == 0, j=1, size(lines))]
         call read_spoiled(spoiled(i)%value)
         call expect_failure(error, failure, path//": ")
         call expect_failure(error, failure, trim(spoiled(i)%words))
      end do

   contains

      !> Read the lines that are kept, and the key with another value.
      subroutine read_spoiled(value)
         !> The value as it stands in the file
         character(len=*), intent(in) :: value

         call read_lines(reader, group, key//" = "//value, pack(lines, kept), failure)
      end subroutine read_spoiled

      !> A number that is not finite is refused.
      subroutine expect_not_finite(value, written)
         !> It as it stands in the file
         character(len=*), intent(in) :: value
         !> It as messages write it
         character(len=*), intent(in) :: written

         call read_spoiled(value)
         call expect_failure(error, failure, key)
         call expect_failure(error, failure, " = "//written//"; expected a finite number")
      end subroutine expect_not_finite
   end subroutine expect_refusals

   !> The key of a line.
   pure function key_of(line) result(key)
      !> A line `key = value`
      character(len=*), intent(in) :: line
      character(len=:), allocatable :: key

      key = line(:index(line, " ") - 1)
   end function key_of

   !> What a reader says of a file with one group.
   subroutine read_lines(reader, group, first_line, lines, failure)
      !> Reads the file
      procedure(reader_type) :: reader
      !> Name of the group
      character(len=*), intent(in) :: group
      !> Its first line, or blank
      character(len=*), intent(in) :: first_line
      !> Its other lines
      character(len=*), intent(in) :: lines(:)
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure
      integer :: i, unit

      open (newunit=unit, file=path, status="replace", action="write")
      write (unit, "(2a)") "&", group
      write (unit, "(a)") first_line, (trim(lines(i)), i=1, size(lines)), "/"
      close (unit)
      call ask(reader, path, failure)
      open (newunit=unit, file=path, status="old", action="readwrite")
      close (unit, status="delete")
   end subroutine read_lines

   !> Call a reader. A number that is missing is read as NaN, and the readers compare it: no trap.
   subroutine ask(reader, file, failure)
      !> Reads the file
      procedure(reader_type) :: reader
      !> Path of the file
      character(len=*), intent(in) :: file
      !> Why it is refused
      type(failure_type), allocatable, intent(out) :: failure

      call ieee_set_halting_mode(ieee_invalid, .false.)
      call reader(file, failure)
      call ieee_set_flag(ieee_invalid, .false.)
   end subroutine ask
end module namelist_refusals
