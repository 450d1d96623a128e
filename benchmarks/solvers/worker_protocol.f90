! SPDX-License-Identifier: BSD-3-Clause
!> What the workers in Fortran share (workers.py): a task and requests from standard input, answers
!> to standard output. Task and samples are global, as Hairer's codes call back without them.
module worker_protocol
   use, intrinsic :: iso_fortran_env, only: iostat_end
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: answer_requests, read_task, sample_is_due

   !> Numbers of the problem
   real(wp), allocatable, public, protected :: parameters(:)
   !> End of the run; time between samples, 0 if none are wanted
   real(wp), public, protected :: t_end, interval
   !> The rows to write, as columns: times from 0 on, each with the state; not allocated if none are
   !> wanted
   real(wp), allocatable, public :: samples(:, :)
   !> The number of the next sample
   integer, public :: next_sample

   abstract interface
      !> Run the task once, and fill `samples` if they are allocated.
      subroutine run_task(tolerance, failure)
         import :: wp
         implicit none (type, external)
         !> Relative and absolute tolerance
         real(wp), intent(in) :: tolerance
         !> Why there is no solution
         character(len=:), allocatable, intent(out) :: failure
      end subroutine run_task
   end interface

contains

   !> Read the task: parameters, the end, and the time between samples.
   subroutine read_task()
      integer, parameter :: most = 100
      character(len=4096) :: line
      integer :: n, status
      real(wp) :: numbers(most)

      read (*, "(a)") line
      do n = 0, most - 1
         read (line, *, iostat=status) numbers(:n + 1)
         if (status /= 0) exit
      end do
      if (n < 2) error stop "worker: task: the end and the time between samples are expected"
      parameters = numbers(:n - 2)
      t_end = numbers(n - 1)
      interval = numbers(n)
   end subroutine read_task

   !> Run the task as often as the requests ask.
   subroutine answer_requests(version, n, run_once)
      !> Version of the solver
      character(len=*), intent(in) :: version
      !> Number of equations
      integer, intent(in) :: n
      !> One run
      procedure(run_task) :: run_once
      character(len=1024) :: request
      character(len=:), allocatable :: failure
      integer :: i, runs, status
      real(wp) :: finish, start, tolerance

      print "(a)", "answer: "//version
      flush (6)
      do
         read (*, "(a)", iostat=status) request
         if (status == iostat_end) exit
         read (request, *) tolerance, runs
         ! the first run after another tolerance prepares the storage of RETARD, which takes longer
         if (runs > 0) call run_once(tolerance, failure)
         if (runs == 0) call begin_samples(n)
         call cpu_time(start)
         do i = 1, max(runs, 1)
            call run_once(tolerance, failure)
            if (allocated(failure)) exit
         end do
         call cpu_time(finish)
         if (runs == 0) call write_samples(trim(request(index(request, " 0 ") + 3:)))
         if (allocated(failure)) then
            print "(a)", "answer: 0 "//failure
         else
            print "(a, es15.8, a)", "answer: ", (finish - start)/max(runs, 1), " ok"
         end if
         flush (6)
      end do
   end subroutine answer_requests

   !> Whether the next sample is due in a step to t.
   logical function sample_is_due(t) result(due)
      real(wp), intent(in) :: t

      due = next_sample <= ubound(samples, 2)
      if (due) due = samples(0, next_sample) <= t + 1e-13_wp*t_end
   end function sample_is_due

   !> Room for the samples, with their times.
   subroutine begin_samples(n)
      integer, intent(in) :: n
      integer :: i

      allocate (samples(0:n, 0:merge(nint(t_end/max(interval, tiny(1.0_wp))), -1, interval > 0)))
      samples(0, :) = [(min(i*interval, t_end), i=0, ubound(samples, 2))]
   end subroutine begin_samples

   !> Write the rows, and forget them.
   subroutine write_samples(file_path)
      character(len=*), intent(in) :: file_path
      integer :: i, unit

      open (newunit=unit, file=file_path, action="write", status="replace")
      do i = lbound(samples, 2), ubound(samples, 2)
         write (unit, "(*(es25.17e3, :, 1x))") samples(:, i)
      end do
      close (unit)
      deallocate (samples)
   end subroutine write_samples
end module worker_protocol
