! SPDX-License-Identifier: BSD-3-Clause
!> Requests of the program: the text of a file, and signals of trajectories in files.
module file_request
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use netcdf, only: nf90_close, nf90_get_att, nf90_get_var, nf90_global, nf90_inq_dimid, &
                     nf90_inq_varid, nf90_inquire_dimension, nf90_inquire_variable, nf90_noerr, &
                     nf90_nowrite, nf90_open, nf90_strerror
   use program_arguments, only: check_input
   use recorded_signal, only: signal_type
   use request, only: request_type
   implicit none (type, external)
   private
   public :: file_request_type

   !> A request that may name files.
   type, extends(request_type) :: file_request_type
   contains
      procedure :: read_signal
   end type file_request_type

   !> What to do with a file that is damaged; the end of a message.
   character(len=*), parameter :: unread = &
      " cannot be read (remove the file; the next run makes it again)"

contains

   !> Read times and signal of a file, and its integral where the times are uneven.
   subroutine read_signal(self, path, block, recorded, error)
      class(file_request_type), intent(in) :: self
      character(len=*), intent(in) :: path
      !> Number of the block of a chain
      integer, intent(in) :: block
      !> What was read
      type(signal_type), intent(out) :: recorded
      !> Error if the file cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=64) :: integral
      integer :: dimension, file, length, status

      if (path == "") then
         call self%request_type%read_signal(path, block, recorded, error)
         return
      end if
      call check_input(path)
      call check(nf90_open(path, nf90_nowrite, file), &
                 "cannot be opened (remove it; the next run makes it again)")
      if (allocated(error)) return
      call check(nf90_get_att(file, nf90_global, "scene", recorded%scene), "attribute 'scene'")
      call check(nf90_get_att(file, nf90_global, "sample_interval", recorded%sample_interval), &
                 "attribute 'sample_interval'")
      call check(nf90_get_att(file, nf90_global, "t_transient", recorded%t_transient), &
                 "attribute 't_transient'")
      call check(nf90_inq_dimid(file, "t", dimension), "dimension 't'")
      if (.not. allocated(error)) then
         call check(nf90_inquire_dimension(file, dimension, len=length), "dimension 't'")
      end if
      call check(nf90_get_att(file, nf90_global, "signal", recorded%signal), "attribute 'signal'")
      call read_variable(trim(recorded%signal), recorded%v)
      call read_variable("t", recorded%t)
      if (.not. allocated(error)) then
         if ((length - 1.5_wp)*recorded%sample_interval > recorded%t(length)) then
            integral = ""
            call check(nf90_get_att(file, nf90_global, "integral", integral), &
                       "attribute 'integral'")
            call check(nf90_get_att(file, nf90_global, "integral_slope", &
                                    recorded%slope_at_rest), "attribute 'integral_slope'")
            if (.not. allocated(error)) call read_variable(trim(integral), recorded%u)
         end if
      end if
      status = nf90_close(file)

   contains

      !> Read one variable.
      subroutine read_variable(name, values)
         character(len=*), intent(in) :: name
         real(wp), allocatable, intent(out) :: values(:)
         integer :: dimensions, id

         call check(nf90_inq_varid(file, name, id), "holds no variable '"//name &
                    //"' (add it to the variables of its scene)")
         if (allocated(error)) return
         allocate (values(length))
         call check(nf90_inquire_variable(file, id, ndims=dimensions), "variable '"//name//"'")
         if (allocated(error)) return
         if (dimensions == 1) then
            call check(nf90_get_var(file, id, values), "variable '"//name//"'")
         else
            call check(nf90_get_var(file, id, values, start=[block, 1], count=[1, length]), &
                       "block "//text(block)//" of variable '"//name//"'")
         end if
         if (allocated(error)) return
         if (.not. all(ieee_is_finite(values))) then
            call raise(error, path//": variable '"//name//"' holds values that are not finite")
         end if
      end subroutine read_variable

      !> Keep the first error: what failed, and what to do where that does not say it.
      subroutine check(outcome, what)
         integer, intent(in) :: outcome
         character(len=*), intent(in) :: what
         character(len=:), allocatable :: words

         if (outcome == nf90_noerr .or. allocated(error)) return
         words = what
         if (index(what, "(") == 0) words = what//unread
         call raise(error, path//": "//words//": "//trim(nf90_strerror(outcome)))
      end subroutine check
   end subroutine read_signal
end module file_request
