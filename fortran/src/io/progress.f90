! SPDX-License-Identifier: BSD-3-Clause
!> Progress of a long program on standard error: a line after a second, with a forecast, and one
!> every 5 %. Short programs write nothing.
module progress
   use, intrinsic :: iso_fortran_env, only: error_unit
   use dde_errors, only: text
   use dde_kinds, only: int64, wp
   use progress_receiver, only: progress_receiver_type
   implicit none (type, external)
   private
   public :: progress_type

   !> Seconds before the first line.
   integer, parameter :: patience = 1
   !> Per cent between two lines.
   integer, parameter :: step = 5
   !> Looks at the clock in one part of the work, at least.
   integer, parameter :: looks = 1000

   !> Progress of work.
   type, extends(progress_receiver_type) :: progress_type
      private
      !> What is being done
      character(len=:), allocatable :: label
      !> Number of parts, and the one being worked on
      integer :: parts = 1, part = 1
      !> Whether writing to standard error failed
      logical :: silent = .false.
      !> When the work began, in ticks of the clock
      integer(int64) :: begun = 0
      !> Ticks in a second
      integer(int64) :: ticks = 1
      !> Pieces done when the clock is looked at next
      integer :: next = 0
      !> Per cent in the last line, -`step` before the first
      integer :: percent = -step
   contains
      procedure :: begin, begin_part, advance
   end type progress_type

contains

   !> Work begins now.
   subroutine begin(self, label, parts)
      class(progress_type), intent(inout) :: self
      !> What is being done
      character(len=*), intent(in) :: label
      !> Number of parts; one if it is left out
      integer, intent(in), optional :: parts

      self%label = label
      self%parts = 1
      if (present(parts)) self%parts = parts
      self%part = 1
      self%next = 0
      self%percent = -step
      call system_clock(self%begun, self%ticks)
   end subroutine begin

   !> Begin another part.
   subroutine begin_part(self, part)
      class(progress_type), intent(inout) :: self
      !> Number of the part, from 1
      integer, intent(in) :: part

      self%part = part
      self%next = 0
   end subroutine begin_part

   !> Report how much of a part is done, if a line is due.
   subroutine advance(self, done, total)
      class(progress_type), intent(inout) :: self
      !> Number of pieces done, 0..total
      integer, intent(in) :: done
      !> Number of pieces in all, at least 1
      integer, intent(in) :: total
      character(len=:), allocatable :: line
      integer :: percent, status
      integer(int64) :: all_pieces, now, pieces
      real(wp) :: taken

      if (self%silent .or. (done < self%next .and. done < total)) return
      ! the first pieces may take long
      self%next = done + max(1, min(done, total/looks))
      call system_clock(now)
      ! as if all parts had as many pieces as this one
      pieces = (self%part - 1)*int(total, int64) + done
      all_pieces = self%parts*int(total, int64)
      percent = int(100*pieces/all_pieces)
      if (now - self%begun < patience*self%ticks .or. percent/step <= self%percent/step) return
      self%percent = percent
      line = self%label//": "//text(percent)//" %, "
      if (self%parts > 1) line = line//"part "//text(self%part)//" of "//text(self%parts)//", "
      line = line//text(done)//" of "//text(total)//", "
      taken = real(now - self%begun, wp)/self%ticks
      if (pieces == all_pieces) then
         line = line//duration(taken)//" in all"
      else
         line = line//duration(taken/pieces*(all_pieces - pieces))//" left"
      end if
      write (error_unit, "(a)", iostat=status) line
      if (status == 0) flush (error_unit, iostat=status)
      self%silent = status /= 0
   end subroutine advance

   !> A time in its two largest units.
   pure function duration(time) result(words)
      !> Seconds
      real(wp), intent(in) :: time
      character(len=:), allocatable :: words
      integer(int64) :: seconds

      seconds = nint(time, int64)
      if (seconds < 60) then
         words = text(seconds)//" s"
      else if (seconds < 3600) then
         words = text(seconds/60)//" min "//text(modulo(seconds, 60_int64))//" s"
      else
         words = text(seconds/3600)//" h "//text(modulo(seconds, 3600_int64)/60)//" min"
      end if
   end function duration
end module progress
