! SPDX-License-Identifier: BSD-3-Clause
!> What the program `linear_stability` reads and writes: a model; its roots and stability changes.
module linear_stability_files
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use model_attributes, only: put_model
   use model_problem, only: model_type
   use model_settings, only: model_settings_type
   use namelist_input, only: namelist_file_type, word_length
   use output_file, only: output_file_type
   use stability_changes, only: changes_type
   use value_checks, only: check_choice, missing
   implicit none (type, external)
   private
   public :: linear_stability_settings_type, read_linear_stability, write_linear_stability

   !> Most parameters along which changes are looked for.
   integer, parameter :: most = 16

   !> Model and bounds; all nondimensional.
   type :: linear_stability_settings_type
      !> The model with its parameters
      type(model_settings_type) :: model
      !> Roots with a real part above this are kept
      real(wp) :: root_bound = missing
      !> Parameters along which changes of stability are looked for, and windows on them
      character(len=word_length) :: along(most) = ""
      real(wp) :: windows(2, most) = 0.0_wp
   end type linear_stability_settings_type

contains

   !> Read and check model and bounds.
   subroutine read_linear_stability(path, linear_stability, model, error)
      character(len=*), intent(in) :: path
      type(linear_stability_settings_type), intent(out) :: linear_stability
      type(model_type), intent(out) :: model
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      integer :: i
      namelist /settings/ linear_stability

      call file%open(path)
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      if (allocated(error)) return
      call linear_stability%model%open(path, model, error, keep_delays=.true., at_rest=.true.)
      do i = 1, count(linear_stability%along /= "")
         if (.not. allocated(error)) then
            call check_choice(error, path, "along", linear_stability%along(i), model%names)
         end if
      end do
   end subroutine read_linear_stability

   !> Write roots and changes of stability.
   subroutine write_linear_stability(path, settings, model, roots, numbers, changes, error)
      character(len=*), intent(in) :: path
      !> What was asked for
      type(linear_stability_settings_type), intent(in) :: settings
      type(model_type), intent(in) :: model
      !> Roots, the rightmost first
      complex(wp), intent(in) :: roots(:)
      !> Number of unstable roots, and the same without delay
      integer, intent(in) :: numbers(2)
      !> Changes along each parameter
      type(changes_type), intent(in) :: changes(:)
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: i, rows

      call file%create(path, "Linear stability of a model at rest")
      call put_model(file, model)
      call file%attribute("root_bound", settings%root_bound)
      call file%attribute("unstable_roots", int(numbers(1), int64))
      call file%attribute("unstable_roots_without_delay", int(numbers(2), int64))
      rows = file%dimension("root", size(roots), prefix="root_")
      call file%column(rows, "real", real(roots), "real part of a characteristic root")
      call file%column(rows, "imag", aimag(roots), "its imaginary part")
      do i = 1, size(changes)
         call put_changes(file, trim(model%names(changes(i)%along)), settings%windows(2, i), &
                          changes(i))
      end do
      call file%finish(error)
   end subroutine write_linear_stability

   !> Changes of stability along one parameter.
   subroutine put_changes(file, name, most, changes)
      type(output_file_type), intent(inout) :: file
      !> Name of the parameter, and the end of its window
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: most
      type(changes_type), intent(in) :: changes
      integer :: i, rows

      call file%attribute(name//"_most", most)
      associate (points => changes%points)
         rows = file%dimension("change_with_"//name, size(points), prefix=name//"_")
         call file%column(rows, "of_change", &
                          [(points(i)%numbers(changes%along), i=1, size(points))], &
                          name//" at which a pair crosses the axis")
         call file%column(rows, "change_omega", points%omega, "its frequency")
         call file%column(rows, "change_roots_before", points%roots_before, "unstable roots below")
         call file%column(rows, "change_roots_after", points%roots_behind, "unstable roots above")
      end associate
   end subroutine put_changes
end module linear_stability_files
