!> Reading a trajectory file back.
module trajectory_input
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use netcdf, only: nf90_close, nf90_get_att, nf90_get_var, nf90_global, nf90_inq_dimid, &
                     nf90_inq_varid, nf90_inquire_dimension, nf90_noerr, nf90_nowrite, nf90_open, &
                     nf90_strerror
   implicit none (type, external)
   private
   public :: read_trajectory, trajectory_type

   !> One variable of a trajectory.
   type :: trajectory_type
      !> Name of the scene
      character(len=64) :: scene = ""
      !> Time between samples
      real(wp) :: sample_interval = 0.0_wp
      !> Time up to which the transient lasts
      real(wp) :: t_transient = 0.0_wp
      !> Samples from t = 0 on
      real(wp), allocatable :: samples(:)
   end type trajectory_type

   !> What to do with a file that is damaged; the end of a message.
   character(len=*), parameter :: unread = &
      " cannot be read (remove the file; the next run makes it again)"

contains

   !> Read one variable.
   subroutine read_trajectory(path, variable, trajectory, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> 'theta', 'u' or 'v'
      character(len=*), intent(in) :: variable
      !> What was read
      type(trajectory_type), intent(out) :: trajectory
      !> Error if the file cannot be read
      type(error_type), allocatable, intent(out) :: error
      integer :: dimension, file, id, length, status

      call check(nf90_open(path, nf90_nowrite, file), &
                 "cannot be opened (remove it; the next run makes it again)")
      if (allocated(error)) return
      call check(nf90_inq_varid(file, variable, id), "holds no variable '"//variable &
                 //"' (add it to the variables of its scene)")
      call check(nf90_get_att(file, nf90_global, "scene", trajectory%scene), &
                 "attribute 'scene'"//unread)
      call check(nf90_get_att(file, nf90_global, "sample_interval", trajectory%sample_interval), &
                 "attribute 'sample_interval'"//unread)
      call check(nf90_get_att(file, nf90_global, "t_transient", trajectory%t_transient), &
                 "attribute 't_transient'"//unread)
      call check(nf90_inq_dimid(file, "t", dimension), "dimension 't'"//unread)
      if (.not. allocated(error)) then
         call check(nf90_inquire_dimension(file, dimension, len=length), "dimension 't'"//unread)
         allocate (trajectory%samples(length))
         call check(nf90_get_var(file, id, trajectory%samples), "variable '"//variable//"'"//unread)
      end if
      if (.not. allocated(error)) then
         if (.not. all(ieee_is_finite(trajectory%samples))) then
            call raise(error, path//": variable '"//variable//"' holds values that are not finite")
         end if
      end if
      status = nf90_close(file)

   contains

      !> Keep the first error.
      subroutine check(outcome, what)
         !> What a NetCDF call returned
         integer, intent(in) :: outcome
         !> What it was about
         character(len=*), intent(in) :: what

         if (outcome == nf90_noerr .or. allocated(error)) return
         call raise(error, path//": "//what//": "//trim(nf90_strerror(outcome)))
      end subroutine check
   end subroutine read_trajectory
end module trajectory_input
