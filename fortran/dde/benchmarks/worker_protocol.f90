! SPDX-License-Identifier: BSD-3-Clause
!> What the workers in Fortran share (workers.py): a scene and requests from standard input, answers
!> to standard output. Scene and samples are global, as Hairer's codes call back without them.
module worker_protocol
   use, intrinsic :: iso_fortran_env, only: iostat_end
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: answer_requests, read_scene, sample_time

   !> Parameters of the block, nondimensional
   real(wp), public, protected :: tau, epsilon, xi, gamma
   !> State theta, u, ln v for t <= 0
   real(wp), public, protected :: past(3)
   !> End of the run
   real(wp), public, protected :: t_end
   !> Samples of the state in the order of their times, from 0 on; not allocated if none wanted
   real(wp), allocatable, public :: samples(:, :)
   real(wp) :: interval

   abstract interface
      !> Integrate the scene once, and fill `samples` if they are allocated.
      subroutine integrate_scene(tolerance, failure)
         import :: wp
         implicit none (type, external)
         !> Relative and absolute tolerance
         real(wp), intent(in) :: tolerance
         !> Why there is no solution
         character(len=:), allocatable, intent(out) :: failure
      end subroutine integrate_scene
   end interface

contains

   !> Read the scene.
   subroutine read_scene()
      character(len=1024) :: message
      integer :: status

      read (*, *, iostat=status, iomsg=message) tau, epsilon, xi, gamma, past, t_end, interval
      if (status /= 0) error stop "worker: scene: "//trim(message)
   end subroutine read_scene

   !> Run the scene as often as the requests ask.
   subroutine answer_requests(version, n, integrate_once)
      !> Version of the solver
      character(len=*), intent(in) :: version
      !> Number of equations
      integer, intent(in) :: n
      !> One integration
      procedure(integrate_scene) :: integrate_once
      character(len=1024) :: message, request
      character(len=:), allocatable :: failure
      integer :: i, runs, status
      real(wp) :: finish, start, tolerance

      print "(a)", "answer: "//version
      flush (6)
      do
         read (*, "(a)", iostat=status, iomsg=message) request
         if (status == iostat_end) exit
         if (status == 0) read (request, *, iostat=status, iomsg=message) tolerance, runs
         if (status /= 0) error stop "worker: request: "//trim(message)
         if (runs == 0) then
            allocate (samples(n, 0:nint(t_end/interval)))
            call integrate_once(tolerance, failure)
            call write_samples(trim(request(index(request, " 0 ") + 3:)))
            deallocate (samples)
         end if
         ! the first run after another tolerance prepares the storage of RETARD, which takes longer
         if (runs > 0) call integrate_once(tolerance, failure)
         call cpu_time(start)
         do i = 1, runs
            call integrate_once(tolerance, failure)
            if (allocated(failure)) exit
         end do
         call cpu_time(finish)
         if (allocated(failure)) then
            print "(a)", "answer: 0 "//failure
         else
            print "(a, es15.8, a)", "answer: ", (finish - start)/max(runs, 1), " ok"
         end if
         flush (6)
      end do
   end subroutine answer_requests

   !> Time of a sample, counted from 0.
   elemental function sample_time(i) result(t)
      integer, intent(in) :: i
      real(wp) :: t

      t = min(i*interval, t_end)
   end function sample_time

   !> Write the samples, a row a time.
   subroutine write_samples(file_path)
      character(len=*), intent(in) :: file_path
      character(len=1024) :: message
      integer :: i, status, unit

      open (newunit=unit, file=file_path, action="write", status="replace", iostat=status, &
            iomsg=message)
      if (status /= 0) error stop "worker: "//trim(message)
      do i = 0, ubound(samples, 2)
         write (unit, "(*(es25.17e3, :, 1x))") sample_time(i), samples(:, i)
      end do
      close (unit, iostat=status, iomsg=message)
      if (status /= 0) error stop "worker: "//trim(message)
   end subroutine write_samples
end module worker_protocol
