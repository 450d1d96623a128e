!> Reading the velocity of a trajectory file back.
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

   !> The velocity of a trajectory.
   type :: trajectory_type
      !> Name of the scene
      character(len=64) :: scene = ""
      !> Longest time between samples
      real(wp) :: sample_interval = 0.0_wp
      !> Time up to which the transient lasts
      real(wp) :: t_transient = 0.0_wp
      !> Times of the samples, from t = 0 on
      real(wp), allocatable :: t(:)
      !> v there
      real(wp), allocatable :: v(:)
      !> u there, where times are uneven
      real(wp), allocatable :: u(:)
   end type trajectory_type

   !> What to do with a file that is damaged; the end of a message.
   character(len=*), parameter :: unread = &
      " cannot be read (remove the file; the next run makes it again)"

contains

   !> Read t and v, and u where the times are uneven.
   subroutine read_trajectory(path, trajectory, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> What was read
      type(trajectory_type), intent(out) :: trajectory
      !> Error if the file cannot be read
      type(error_type), allocatable, intent(out) :: error
      integer :: dimension, file, length, status

      call check(nf90_open(path, nf90_nowrite, file), &
                 "cannot be opened (remove it; the next run makes it again)")
      if (allocated(error)) return
      call check(nf90_get_att(file, nf90_global, "scene", trajectory%scene), &
                 "attribute 'scene'"//unread)
      call check(nf90_get_att(file, nf90_global, "sample_interval", trajectory%sample_interval), &
                 "attribute 'sample_interval'"//unread)
      call check(nf90_get_att(file, nf90_global, "t_transient", trajectory%t_transient), &
                 "attribute 't_transient'"//unread)
      call check(nf90_inq_dimid(file, "t", dimension), "dimension 't'"//unread)
      if (.not. allocated(error)) then
         call check(nf90_inquire_dimension(file, dimension, len=length), "dimension 't'"//unread)
      end if
      call read_variable("v", trajectory%v)
      call read_variable("t", trajectory%t)
      if (.not. allocated(error)) then
         if ((length - 1.5_wp)*trajectory%sample_interval > trajectory%t(length)) then
            call read_variable("u", trajectory%u)
         end if
      end if
      status = nf90_close(file)

   contains

      !> Read one variable.
      subroutine read_variable(name, values)
         character(len=*), intent(in) :: name
         real(wp), allocatable, intent(out) :: values(:)
         integer :: id

         call check(nf90_inq_varid(file, name, id), "holds no variable '"//name &
                    //"' (add it to the variables of its scene)")
         if (allocated(error)) return
         allocate (values(length))
         call check(nf90_get_var(file, id, values), "variable '"//name//"'"//unread)
         if (allocated(error)) return
         if (.not. all(ieee_is_finite(values))) then
            call raise(error, path//": variable '"//name//"' holds values that are not finite")
         end if
      end subroutine read_variable

      !> Keep the first error.
      subroutine check(outcome, what)
         integer, intent(in) :: outcome
         character(len=*), intent(in) :: what

         if (outcome == nf90_noerr .or. allocated(error)) return
         call raise(error, path//": "//what//": "//trim(nf90_strerror(outcome)))
      end subroutine check
   end subroutine read_trajectory
end module trajectory_input
