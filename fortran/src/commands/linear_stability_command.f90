! SPDX-License-Identifier: BSD-3-Clause
!> Linear stability of a model at rest, at one set of parameters: its roots and stability changes.
module linear_stability_command
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   use model_attributes, only: put_model
   use model_problem, only: model_type
   use model_roots, only: count_roots, find_model_roots
   use model_settings, only: model_settings_type
   use request, only: request_type, word_length
   use results, only: results_type
   use stability_changes, only: changes_type, find_changes, roots_without_delay
   use value_checks, only: check_choice, missing
   implicit none (type, external)
   private
   public :: run_linear_stability

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

   !> Run the command.
   subroutine run_linear_stability(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(changes_type), allocatable :: changes(:)
      type(linear_stability_settings_type) :: settings
      type(model_type) :: model
      complex(wp), allocatable :: roots(:)
      integer :: i

      call read_linear_stability(given, settings, model, error)
      if (allocated(error)) return
      call find_model_roots(model, settings%root_bound, roots, error)
      if (allocated(error)) return
      allocate (changes(count(settings%along /= "")))
      do i = 1, size(changes)
         changes(i)%along = model%number_of(settings%along(i))
         call find_changes(model, settings%windows(:, i), changes(i), error)
         if (allocated(error)) return
      end do
      call put_stability(data, settings, model, roots, &
                         [count_roots(model, 0.0_wp), roots_without_delay(model)], changes)
   end subroutine run_linear_stability

   !> Read and check model and bounds.
   subroutine read_linear_stability(given, linear_stability, model, error)
      class(request_type), intent(inout) :: given
      type(linear_stability_settings_type), intent(out) :: linear_stability
      type(model_type), intent(out) :: model
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      namelist /settings/ linear_stability

      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      write (given%copy, nml=settings, delim="quote")
      call given%check(error)
      if (allocated(error)) return
      call linear_stability%model%open(given%place, model, error, keep_delays=.true., &
                                       at_rest=.true., opened=given%model)
      do i = 1, count(linear_stability%along /= "")
         if (.not. allocated(error)) then
            call check_choice(error, given%place, "along", linear_stability%along(i), &
                              model%names)
         end if
      end do
   end subroutine read_linear_stability

   !> Roots and changes of stability.
   subroutine put_stability(data, settings, model, roots, numbers, changes)
      class(results_type), intent(inout) :: data
      !> What was asked for
      type(linear_stability_settings_type), intent(in) :: settings
      type(model_type), intent(in) :: model
      !> Roots, the rightmost first
      complex(wp), intent(in) :: roots(:)
      !> Number of unstable roots, and the same without delay
      integer, intent(in) :: numbers(2)
      !> Changes along each parameter
      type(changes_type), intent(in) :: changes(:)
      integer :: i, rows

      call data%attribute("title", "Linear stability of a model at rest")
      call put_model(data, model)
      call data%attribute("root_bound", settings%root_bound)
      call data%attribute("unstable_roots", int(numbers(1), int64))
      call data%attribute("unstable_roots_without_delay", int(numbers(2), int64))
      rows = data%dimension("root", size(roots), prefix="root_")
      call data%column(rows, "real", real(roots), "real part of a characteristic root")
      call data%column(rows, "imag", aimag(roots), "its imaginary part")
      do i = 1, size(changes)
         call put_changes(data, trim(model%names(changes(i)%along)), settings%windows(2, i), &
                          changes(i))
      end do
   end subroutine put_stability

   !> Changes of stability along one parameter.
   subroutine put_changes(data, name, most, changes)
      class(results_type), intent(inout) :: data
      !> Name of the parameter, and the end of its window
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: most
      type(changes_type), intent(in) :: changes
      integer :: i, rows

      call data%attribute(name//"_most", most)
      associate (points => changes%points)
         rows = data%dimension("change_with_"//name, size(points), prefix=name//"_")
         call data%column(rows, "of_change", &
                          [(points(i)%numbers(changes%along), i=1, size(points))], &
                          name//" at which a pair crosses the axis")
         call data%column(rows, "change_omega", points%omega, "its frequency")
         call data%column(rows, "change_roots_before", points%roots_before, "unstable roots below")
         call data%column(rows, "change_roots_after", points%roots_behind, "unstable roots above")
      end associate
   end subroutine put_changes
end module linear_stability_command
