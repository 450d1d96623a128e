!> Lines of parameters of the block on which cycles are followed, and the Hopf points on them.
module cycle_lines
   use block_parameters, only: block_parameters_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use gsl_roots, only: find_root, scalar_function_type
   use hopf_condition, only: hopf_epsilon, hopf_tau, largest_omega, two_pi
   implicit none (type, external)
   private
   public :: along_epsilon, along_tau, cycle_line_type, find_hopf_starts, hopf_start_type

   !> Numbers of the parameters along which a line may run, in the order of the family of blocks.
   integer, parameter :: along_tau = 1, along_epsilon = 2
   !> Places at which a sign of the condition is looked for between frequencies 0 and the largest
   integer, parameter :: scan_places = 4000

   !> A line.
   type :: cycle_line_type
      !> along_tau or along_epsilon
      integer :: along = along_epsilon
      !> The other parameters
      type(block_parameters_type) :: parameters
      !> Window on the parameter along it
      real(wp) :: window(2) = 0.0_wp
   end type cycle_line_type

   !> A Hopf point.
   type :: hopf_start_type
      !> Its parameters
      type(block_parameters_type) :: parameters
      !> Frequency of the pair
      real(wp) :: omega = 0.0_wp
   end type hopf_start_type

   !> By how much a branch of the Hopf condition misses the line, as a function of the frequency.
   type, extends(scalar_function_type) :: miss_type
      !> The line
      type(cycle_line_type) :: line
      !> Branch of equation (10)
      integer :: k = 0
   contains
      procedure :: value => miss_of_line
   end type miss_type

contains

   !> All Hopf points on a line.
   subroutine find_hopf_starts(line, starts, error)
      !> The line
      type(cycle_line_type), intent(in) :: line
      !> Hopf points, branch by branch of equation (10)
      type(hopf_start_type), allocatable, intent(out) :: starts(:)
      !> A root was not found
      type(error_type), allocatable, intent(out) :: error
      type(hopf_start_type) :: start
      type(miss_type) :: miss
      real(wp) :: here, largest, longest_delay, next, omega
      integer :: i, k

      allocate (starts(0))
      miss%line = line
      associate (p => line%parameters)
         largest = largest_omega(p%epsilon)
         longest_delay = line%window(2)
         if (line%along == along_epsilon) then
            largest = largest_omega(line%window(2))
            longest_delay = p%tau
         end if
         do k = 0, int(longest_delay*largest/two_pi) + 1
            miss%k = k
            here = miss%value(largest/scan_places)
            do i = 1, scan_places - 1
               next = miss%value(largest*(i + 1)/scan_places)
               if (here < 0.0_wp .neqv. next < 0.0_wp) then
                  call find_root(miss, largest*i/scan_places, largest*(i + 1)/scan_places, omega, &
                                 error)
                  if (allocated(error)) return
                  start%omega = omega
                  start%parameters = p
                  start%parameters%tau = hopf_tau(omega, p%xi, p%gamma, k)
                  start%parameters%epsilon = hopf_epsilon(omega, p%xi, p%gamma)
                  if (is_on(line, start%parameters)) starts = [starts, start]
               end if
               here = next
            end do
         end do
      end associate
   end subroutine find_hopf_starts

   !> Whether a Hopf point is in the window.
   pure logical function is_on(line, parameters) result(value)
      !> The line
      type(cycle_line_type), intent(in) :: line
      !> Parameters of the point
      type(block_parameters_type), intent(in) :: parameters

      associate (x => merge(parameters%tau, parameters%epsilon, line%along == along_tau))
         value = x >= line%window(1) .and. x <= line%window(2) .and. parameters%tau >= 0.0_wp
      end associate
   end function is_on

   !> By how much a pair i omega misses the line.
   real(wp) function miss_of_line(self, x) result(value)
      !> The function
      class(miss_type), intent(in) :: self
      !> Frequency
      real(wp), intent(in) :: x

      associate (p => self%line%parameters)
         if (self%line%along == along_tau) then
            value = hopf_epsilon(x, p%xi, p%gamma) - p%epsilon
         else
            value = hopf_tau(x, p%xi, p%gamma, self%k) - p%tau
         end if
      end associate
   end function miss_of_line
end module cycle_lines
