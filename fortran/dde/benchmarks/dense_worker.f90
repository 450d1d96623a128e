! SPDX-License-Identifier: BSD-3-Clause
!> Errors of dense output on layers (dense.py). Standard input: lines of a method, a layer, a
!> tolerance and a rate. Prints for each the largest error at the ends of steps and between them, of
!> the component where the second exceeds the first, or the tolerance, by the largest factor.
program dense_worker
   use, intrinsic :: iso_fortran_env, only: iostat_end
   use dde, only: integration_options
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use layer_problems, only: layer, measure_errors, relaxation, solved
   implicit none (type, external)
   !> Share of a step between two samples
   real(wp), parameter :: between = 1.0_wp/16
   character(len=16) :: method, name
   character(len=256) :: message
   class(solved), allocatable :: problem
   integer :: i, status
   real(wp) :: rate, tolerance
   real(wp), allocatable :: at_steps(:), within(:)
   type(error_type), allocatable :: error
   type(integration_options) :: options

   do
      read (*, *, iostat=status, iomsg=message) method, name, tolerance, rate
      if (status == iostat_end) exit
      if (status /= 0) error stop "dense_worker: "//trim(message)
      options = integration_options(method=method, relative=tolerance, absolute=tolerance)
      if (allocated(problem)) deallocate (problem)
      select case (name)
      case ("decay")
         allocate (problem, source=relaxation(rate))
      case ("switch")
         allocate (problem, source=relaxation(rate, 1.0_wp))
         ! as documented for a series, which shows no jump
         if (method == "taylor") options%break_at = [1.0_wp]
      case ("pulse")
         allocate (problem, source=layer(rate))
      case default
         allocate (problem, source=layer(rate, 0.5_wp))
      end select
      problem%analytic = method == "taylor"
      call measure_errors(problem, 3.7_wp, options, 1.0_wp, at_steps, error)
      if (.not. allocated(error)) then
         call measure_errors(problem, 3.7_wp, options, between, within, error)
      end if
      if (allocated(error)) error stop "dense_worker: "//error%message
      i = maxloc(within/max(at_steps, tolerance), dim=1)
      print "(2es24.16)", at_steps(i), within(i)
   end do
end program dense_worker
