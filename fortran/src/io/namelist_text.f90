!> The text of a namelist: a group and its keys may stand only once, and its numbers are finite. Of
!> a key that is given twice, Fortran's own reading takes the last value without a word.
module namelist_text
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: int64
   use value_checks, only: missing_count
   implicit none (type, external)
   private
   public :: check_given_once, check_numbers

   !> Most bytes of a namelist file: the largest that a program accepts, 1000 cases or 1000
   !> histories, has a quarter of it.
   integer, parameter :: most_bytes = 1000000
   !> Most keys that are compared: no group has more, and reading refuses an unknown key.
   integer, parameter :: most_keys = 100
   !> Most letters of a key: those of a name in Fortran.
   integer, parameter :: longest_key = 63
   !> What ends a line.
   character(len=*), parameter :: line_end = new_line("a")
   !> What may stand between a key and its equals sign.
   character(len=*), parameter :: blanks = " "//achar(9)//achar(13)//line_end
   !> Letters of a key; a percent sign stands before a component.
   character(len=*), parameter :: key_letters = "abcdefghijklmnopqrstuvwxyz0123456789_%"

contains

   !> Refuse a file in which a group, or a key of the group, is given twice. Elements of a list are
   !> given together, as key = value, value.
   subroutine check_given_once(path, group, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Namelist group, in small letters
      character(len=*), intent(in) :: group
      !> Error if the group is given twice, or not at all, or the file cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: bare, content, quoted
      integer :: first, second

      call read_file(path, content, error)
      if (allocated(error)) return
      content = in_small_letters(content)
      bare = blanked(content, strings=.true.)
      ! Fortran finds a group inside a string, too
      quoted = blanked(content, strings=.false.)
      first = place_of_group(quoted, group, 1)
      second = place_of_group(quoted, group, first + 1)
      if (first == 0) then
         call raise(error, path//": no complete namelist group &"//group//" in it")
      else if (second > 0) then
         call raise(error, path//": namelist group &"//group//" stands in lines " &
                    //text(line_of(first))//" and "//text(line_of(second)) &
                    //"; expected once; remove one of them")
      else
         call check_keys(bare(first:), error)
      end if

   contains

      !> Number of the line in which a letter of the file stands.
      pure integer function line_of(place) result(line)
         !> Index of the letter
         integer, intent(in) :: place
         integer :: i

         line = 1 + count([(content(i:i) == line_end, i=1, place - 1)])
      end function line_of

      !> Refuse a key that is given twice.
      subroutine check_keys(rest, error)
         !> The file from the group on, without comments and strings
         character(len=*), intent(in) :: rest
         !> A key is given twice
         type(error_type), allocatable, intent(out) :: error
         character(len=longest_key) :: keys(most_keys)
         integer :: at, i, last, n, places(most_keys)

         last = scan(rest(2:)//"/", "/&$")
         at = 0
         do n = 1, most_keys
            i = index(rest(at + 1:last), "=")
            if (i == 0) return
            at = at + i
            keys(n) = key_before(rest(:at - 1))
            places(n) = first + at - 1
            do i = 1, n - 1
               if (.not. overlap(trim(keys(i)), trim(keys(n)))) cycle
               call raise(error, path//": namelist group &"//group//": "//trim(keys(n)) &
                          //" stands in lines "//text(line_of(places(i)))//" and " &
                          //text(line_of(places(n)))//"; expected once; remove one of them")
               return
            end do
         end do
      end subroutine check_keys
   end subroutine check_given_once

   !> Refuse numbers that are not finite and integers that were not given.
   subroutine check_numbers(path, lines, error)
      !> Path of the file that was read
      character(len=*), intent(in) :: path
      !> All keys and their values, as Fortran writes a namelist with strings in quotes
      character(len=*), intent(in) :: lines(:)
      !> First such number
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: key, line, values
      integer :: at, i

      key = ""
      do i = 2, size(lines)
         line = in_small_letters(blanked(trim(lines(i)), strings=.true.))
         if (line == " /") return
         at = index(line, "=")
         if (at > 0) key = trim(adjustl(line(:at - 1)))
         values = line(at + 1:)
         if (index(values, "nan") > 0) then
            call raise(error, path//": "//key//" = NaN; expected a finite number " &
                       //"(NaN: missing, or not a number)")
         else if (index(values, "inf") > 0) then
            call raise(error, path//": "//key//" = "//trim(adjustl(values)) &
                       //" expected a finite number")
         else if (index(values, text(missing_count)) > 0) then
            call raise(error, path//": "//key//" is missing; expected a whole number")
         end if
         if (allocated(error)) return
      end do
   end subroutine check_numbers

   !> Read all of a file.
   subroutine read_file(path, content, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> All of it
      character(len=:), allocatable, intent(out) :: content
      !> Error if the file cannot be read, or is too long
      type(error_type), allocatable, intent(out) :: error
      character(len=256) :: reason
      integer(int64) :: length
      integer :: status, unit

      open (newunit=unit, file=path, status="old", action="read", access="stream", &
            form="unformatted", iostat=status, iomsg=reason)
      if (status == 0) then
         inquire (unit, size=length)
         if (length > most_bytes) then
            call raise(error, path//": size = "//text(length)//" bytes; expected a namelist of " &
                       //"at most "//text(most_bytes))
         else
            allocate (character(len=length) :: content)
            read (unit, iostat=status, iomsg=reason) content
         end if
         close (unit)
      end if
      if (status /= 0) call raise(error, path//": "//trim(reason))
   end subroutine read_file

   !> Text in small letters.
   pure function in_small_letters(words) result(small)
      !> The text
      character(len=*), intent(in) :: words
      character(len=:), allocatable :: small
      integer :: i

      small = words
      do i = 1, len(words)
         if (lge(words(i:i), "A") .and. lle(words(i:i), "Z")) then
            small(i:i) = achar(iachar(words(i:i)) + iachar("a") - iachar("A"))
         end if
      end do
   end function in_small_letters

   !> Text of the same length, with blanks for comments and, where wanted, for strings.
   pure function blanked(words, strings) result(bare)
      !> The text
      character(len=*), intent(in) :: words
      !> Whether strings are blanked
      logical, intent(in) :: strings
      character(len=:), allocatable :: bare
      character(len=1) :: before, letter, part, within
      integer :: i

      bare = words
      ! what ends the comment or string that goes on
      within = " "
      do i = 1, len(words)
         letter = words(i:i)
         before = within
         if (before == " ") then
            if (letter == "!") within = line_end
            if (letter == "'" .or. letter == """") within = letter
         else if (letter == before) then
            within = " "
         end if
         part = merge(within, before, before == " ")
         if (part == line_end .or. (strings .and. part /= " ")) bare(i:i) = " "
      end do
   end function blanked

   !> Index at which a group begins, at or after another index; 0 if there is none.
   pure integer function place_of_group(words, group, from) result(place)
      !> The file without comments
      character(len=*), intent(in) :: words
      !> The group
      character(len=*), intent(in) :: group
      !> First index
      integer, intent(in) :: from

      do place = from, len(words) - len(group)
         if (scan(words(place:place), "&$") == 0) cycle
         if (words(place + 1:place + len(group)) /= group) cycle
         if (place + len(group) == len(words)) return
         if (scan(words(place + len(group) + 1:place + len(group) + 1), key_letters) == 0) return
      end do
      place = 0
   end function place_of_group

   !> The key before an equals sign, without subscripts.
   pure function key_before(words) result(key)
      !> The text before the equals sign
      character(len=*), intent(in) :: words
      character(len=:), allocatable :: key
      integer :: depth, i

      key = ""
      depth = 0
      do i = len(words), 1, -1
         associate (letter => words(i:i))
            if (letter == ")") depth = depth + 1
            if (depth == 0) then
               if (scan(letter, key_letters) > 0 .and. len(key) < longest_key) then
                  key = letter//key
               else if (key /= "" .or. scan(letter, blanks) == 0) then
                  return
               end if
            end if
            if (letter == "(") depth = depth - 1
         end associate
      end do
   end function key_before

   !> Whether two keys set the same variable, or one a component of the other.
   pure logical function overlap(one, other) result(value)
      !> One key
      character(len=*), intent(in) :: one
      !> Another
      character(len=*), intent(in) :: other

      value = index(one//"%", other//"%") == 1 .or. index(other//"%", one//"%") == 1
   end function overlap
end module namelist_text
