!> Lines of parameters of the block on which cycles are followed, and the Hopf points on them.
module cycle_lines
   use block_family, only: along_epsilon, along_gamma, along_tau, along_xi, vector_of
   use block_parameters, only: block_parameters_type
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use gsl_roots, only: find_root, scalar_function_type
   use hopf_condition, only: find_hopf_condition, hopf_condition_type, two_pi
   implicit none (type, external)
   private
   public :: along_epsilon, along_gamma, along_tau, along_xi, cycle_line_type, find_hopf_starts, &
             hopf_start_type

   !> Places at which a sign of the condition is looked for between frequencies 0 and the largest
   integer, parameter :: scan_places = 4000

   !> A line.
   type :: cycle_line_type
      !> along_tau, along_epsilon, along_xi or along_gamma
      integer :: along = along_epsilon
      !> The other parameters
      type(block_parameters_type) :: parameters
      !> Window on the parameter along it
      real(wp) :: window(2) = 0.0_wp
   end type cycle_line_type

   !> A Hopf point.
   type :: hopf_start_type
      !> Parameters of the Hopf point
      type(block_parameters_type) :: parameters
      !> Frequency of the pair
      real(wp) :: omega = 0.0_wp
   end type hopf_start_type

   !> By how much the Hopf condition misses the line, as a function of the frequency.
   type, extends(scalar_function_type) :: miss_type
      !> The line
      type(cycle_line_type) :: line
      !> Where the law has pairs i omega
      type(hopf_condition_type) :: condition
      !> Branch of equation (10); on lines along xi and gamma there is one for all
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
      real(wp) :: here, largest, next, omega, place(4)
      integer :: branches, i, k

      allocate (starts(0))
      miss%line = line
      call find_hopf_condition(line%parameters, miss%condition, error)
      if (allocated(error)) return
      if (line%along == along_gamma .and. .not. miss%condition%has_inertia) then
         call raise(error, "find_hopf_starts: along gamma, on which the law '" &
                    //trim(line%parameters%law)//"' does not depend; expected a law with inertia")
         return
      end if
      associate (p => line%parameters)
         largest = miss%condition%largest_omega(p%epsilon)
         select case (line%along)
         case (along_tau)
            branches = int(line%window(2)*largest/two_pi) + 1
         case (along_epsilon)
            largest = miss%condition%largest_omega(line%window(2))
            branches = int(p%tau*largest/two_pi) + 1
         case default
            branches = 0
         end select
         do k = 0, branches
            miss%k = k
            here = miss%value(largest/scan_places)
            do i = 1, scan_places - 1
               next = miss%value(largest*(i + 1)/scan_places)
               if (here < 0.0_wp .neqv. next < 0.0_wp) then
                  call find_root(miss, largest*i/scan_places, largest*(i + 1)/scan_places, omega, &
                                 error)
                  if (allocated(error)) return
                  start = hopf_start_type(at_frequency(miss, omega), omega)
                  place = vector_of(start%parameters)
                  if (place(line%along) >= line%window(1) .and. &
                      place(line%along) <= line%window(2) .and. &
                      start%parameters%tau >= 0.0_wp) starts = [starts, start]
               end if
               here = next
            end do
         end do
      end associate
   end subroutine find_hopf_starts

   !> Parameters of a pair i omega on the line.
   type(block_parameters_type) function at_frequency(miss, omega) result(parameters)
      type(miss_type), intent(in) :: miss
      real(wp), intent(in) :: omega

      parameters = miss%line%parameters
      associate (p => parameters, c => miss%condition)
         select case (miss%line%along)
         case (along_xi)
            p%xi = c%xi_at(omega, p%tau, p%gamma)
         case (along_gamma)
            p%gamma = c%gamma_at(omega, p%epsilon, p%tau, p%xi)
         case default
            p%epsilon = c%epsilon_at(omega, p%xi, p%gamma)
            p%tau = c%tau_at(omega, p%epsilon, p%xi, p%gamma, miss%k)
         end select
      end associate
   end function at_frequency

   !> By how much a pair i omega misses the line.
   real(wp) function miss_of_line(self, x) result(value)
      class(miss_type), intent(in) :: self
      real(wp), intent(in) :: x

      associate (p => self%line%parameters, c => self%condition)
         select case (self%line%along)
         case (along_tau)
            value = c%epsilon_at(x, p%xi, p%gamma) - p%epsilon
         case (along_epsilon)
            value = c%tau_at(x, c%epsilon_at(x, p%xi, p%gamma), p%xi, p%gamma, self%k) - p%tau
         case (along_xi)
            value = c%miss_along_xi(x, p%epsilon, p%tau, p%gamma)
         case default
            value = c%miss_along_gamma(x, p%epsilon, p%tau, p%xi)
         end select
      end associate
   end function miss_of_line
end module cycle_lines
