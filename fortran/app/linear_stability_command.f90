!> Linear stability of a model at rest, at one set of parameters.
module linear_stability_command
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use hopf_lines, only: find_hopf_on_line, hopf_on_line_type
   use linear_stability_files, only: changes_type, linear_stability_settings_type, &
                                     read_linear_stability, write_linear_stability
   use model_problem, only: model_type
   use model_roots, only: count_roots, find_model_roots
   use program_arguments, only: stop_on
   use root_counts, only: roots_right_of
   implicit none (type, external)
   private
   public :: run_linear_stability

   !> Places of a line at which unstable roots are counted.
   integer, parameter :: places = 1000

contains

   !> Linear stability of a model at rest, at one set of parameters.
   subroutine run_linear_stability(namelist_path, output_path)
      !> Path of the namelist
      character(len=*), intent(in) :: namelist_path
      !> Path of the file to write
      character(len=*), intent(in) :: output_path
      type(changes_type), allocatable :: changes(:)
      type(error_type), allocatable :: error
      type(linear_stability_settings_type) :: settings
      type(model_type) :: model
      complex(wp), allocatable :: roots(:)
      integer :: i

      call read_linear_stability(namelist_path, settings, model, error)
      call stop_on(error)
      call find_model_roots(model, settings%root_bound, roots, error)
      call stop_on(error)
      allocate (changes(count(settings%along /= "")))
      do i = 1, size(changes)
         changes(i)%along = model%number_of(settings%along(i))
         call find_changes(model, settings%windows(:, i), changes(i), error)
         call stop_on(error)
      end do
      call write_linear_stability(output_path, settings, model, roots, &
                                  [count_roots(model, 0.0_wp), without_delay(model)]/2, changes, &
                                  error)
      call stop_on(error)
   end subroutine run_linear_stability

   !> Changes of stability of all modes along a parameter, ascending.
   subroutine find_changes(model, window, changes, error)
      type(model_type), intent(in) :: model
      !> Window on the parameter
      real(wp), intent(in) :: window(2)
      type(changes_type), intent(inout) :: changes
      type(error_type), allocatable, intent(out) :: error
      type(hopf_on_line_type), allocatable :: of_mode(:), points(:)
      real(wp) :: from(size(model%numbers)), to(size(model%numbers))
      integer :: i, j, k, l

      from = model%numbers
      to = model%numbers
      from(changes%along) = window(1)
      to(changes%along) = window(2)
      allocate (points(0))
      do i = 1, model%modes()
         call find_hopf_on_line(model%mode(i), from, to, places, of_mode, error)
         if (allocated(error)) return
         do j = 1, size(of_mode)
            associate (a => changes%along)
               k = count([(points(l)%numbers(a) < of_mode(j)%numbers(a), l=1, size(points))])
            end associate
            points = [points(:k), of_mode(j), points(k + 1:)]
         end do
      end do
      call move_alloc(points, changes%points)
   end subroutine find_changes

   !> Number of unstable roots without delays, of all modes.
   integer function without_delay(model) result(number)
      type(model_type), intent(in) :: model
      type(characteristic_type) :: c
      integer :: i

      number = 0
      do i = 1, model%modes()
         c = characteristic_of(model%mode(i))
         c%delay = 0.0_wp
         number = number + roots_right_of(c, 0.0_wp)
      end do
   end function without_delay
end module linear_stability_command
