!> The delays and the sensitivities epsilon at which a pair of characteristic roots crosses the
!> imaginary axis, all else kept: equations (7) and (10), solved for the frequency.
module stability_changes
   use block_family, only: along_epsilon, along_tau
   use block_parameters, only: block_parameters_type
   use characteristic_function, only: characteristic_type
   use dde_errors, only: error_type
   use gsl_roots, only: find_falling_root, find_root, scalar_function_type
   use hopf_condition, only: find_hopf_condition, hopf_condition_type
   use dde_kinds, only: wp
   use root_counts, only: pairs_beside
   use spring_block, only: block_characteristic
   implicit none (type, external)
   private
   public :: angle_above, changes_with_epsilon, changes_with_tau, find_on_branch, &
             omega_function_type, &
             stability_change_type

   !> A crossing.
   type :: stability_change_type
      !> Parameters, nondimensional
      type(block_parameters_type) :: parameters
      !> Frequency of the pair
      real(wp) :: omega = 0.0_wp
      !> Unstable pairs before and after it
      integer :: pairs_before = 0, pairs_after = 0
   end type stability_change_type

   !> Functions of omega: epsilon less a given one; the other frequency of the same epsilon less
   !> this one, which falls as omega grows; omega tau of a branch less that of a given delay, which
   !> falls and has one root.
   integer, parameter :: epsilon_above = 1, partner_above = 2, angle_above = 3

   !> One of these functions.
   type, extends(scalar_function_type) :: omega_function_type
      !> epsilon_above, partner_above or angle_above
      integer :: quantity = 0
      !> Parameters, with the given epsilon or delay
      type(block_parameters_type) :: p
      !> Where the law has pairs i omega
      type(hopf_condition_type) :: condition
      !> Branch
      integer :: k = 0
   contains
      procedure :: value => value_at_omega
   end type omega_function_type

contains

   !> All crossings at delays from above 0 up to a bound, ascending.
   subroutine changes_with_tau(p, tau_most, changes, error)
      !> Parameters; tau does not matter
      type(block_parameters_type), intent(in) :: p
      !> Longest delay
      real(wp), intent(in) :: tau_most
      !> Crossings
      type(stability_change_type), allocatable, intent(out) :: changes(:)
      !> A root was not found
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: there
      type(hopf_condition_type) :: condition
      type(omega_function_type) :: excess
      real(wp) :: bottom, lower, omega(2), upper
      integer :: i, k

      allocate (changes(0))
      call find_hopf_condition(p, condition, error)
      if (allocated(error)) return
      ! epsilon is least where both frequencies of an epsilon are the same
      call find_falling_root(omega_function_type(partner_above, p, condition), p%gamma, bottom, &
                             error)
      if (allocated(error)) return
      excess = omega_function_type(epsilon_above, p, condition)
      if (excess%value(bottom) >= 0.0_wp) return
      lower = bottom
      do while (excess%value(lower) <= 0.0_wp)
         lower = 0.5_wp*lower
      end do
      upper = bottom
      do while (excess%value(upper) <= 0.0_wp)
         upper = 2.0_wp*upper
      end do
      call find_root(excess, lower, bottom, omega(1), error)
      if (.not. allocated(error)) call find_root(excess, bottom, upper, omega(2), error)
      if (allocated(error)) return
      there = p
      do i = 1, 2
         k = 0
         do
            there%tau = condition%tau_at(omega(i), p%epsilon, p%xi, p%gamma, k)
            if (there%tau > tau_most) exit
            k = k + 1
            if (there%tau <= 0.0_wp) cycle
            call insert_change(changes, change_at(there, omega(i), along_tau), &
                               changes%parameters%tau < there%tau)
         end do
      end do
   end subroutine changes_with_tau

   !> All crossings at epsilons from above -1 up to a bound, ascending.
   subroutine changes_with_epsilon(p, epsilon_most, changes, error)
      !> Parameters; epsilon does not matter
      type(block_parameters_type), intent(in) :: p
      !> Largest epsilon
      real(wp), intent(in) :: epsilon_most
      !> Crossings
      type(stability_change_type), allocatable, intent(out) :: changes(:)
      !> A root was not found
      type(error_type), allocatable, intent(out) :: error
      type(block_parameters_type) :: there
      type(hopf_condition_type) :: condition
      type(omega_function_type) :: angle
      real(wp) :: omega, omega_most

      allocate (changes(0))
      call find_hopf_condition(p, condition, error)
      if (allocated(error)) return
      angle = omega_function_type(angle_above, p, condition)
      omega_most = condition%largest_omega(epsilon_most)
      there = p
      do
         call find_on_branch(angle, omega_most, omega, error)
         if (allocated(error)) return
         if (omega <= 0.0_wp) exit
         angle%k = angle%k + 1
         there%epsilon = condition%epsilon_at(omega, p%xi, p%gamma)
         if (there%epsilon > epsilon_most) cycle
         call insert_change(changes, change_at(there, omega, along_epsilon), &
                            changes%parameters%epsilon < there%epsilon)
      end do
   end subroutine changes_with_epsilon

   !> The frequency at which a branch has a given delay.
   subroutine find_on_branch(angle, omega_most, omega, error)
      !> `angle_above` with the branch and the delay
      type(omega_function_type), intent(in) :: angle
      !> Largest frequency
      real(wp), intent(in) :: omega_most
      !> The frequency; 0 if there is none
      real(wp), intent(out) :: omega
      !> A root was not found
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: lower

      omega = 0.0_wp
      if (angle%value(omega_most) >= 0.0_wp) return
      lower = 0.5_wp*omega_most
      do while (angle%value(lower) <= 0.0_wp)
         lower = 0.5_wp*lower
      end do
      call find_root(angle, lower, omega_most, omega, error)
   end subroutine find_on_branch

   !> A crossing at the pair i omega.
   type(stability_change_type) function change_at(p, omega, parameter) result(change)
      type(block_parameters_type), intent(in) :: p
      real(wp), intent(in) :: omega
      !> Number of the parameter that grows
      integer, intent(in) :: parameter
      type(characteristic_type) :: c
      real(wp) :: speed
      integer :: beside

      c = block_characteristic(p)
      speed = real(c%root_by(parameter, cmplx(0.0_wp, omega, kind=wp)))
      beside = pairs_beside(c, [omega])
      change = stability_change_type(p, omega, beside, beside)
      if (speed > 0.0_wp) then
         change%pairs_after = beside + 1
      else
         change%pairs_before = beside + 1
      end if
   end function change_at

   !> Put a crossing in its place.
   pure subroutine insert_change(changes, change, earlier)
      type(stability_change_type), allocatable, intent(inout) :: changes(:)
      type(stability_change_type), intent(in) :: change
      !> Which of the others come first; they are ascending
      logical, intent(in) :: earlier(:)
      integer :: n

      n = count(earlier)
      changes = [changes(:n), change, changes(n + 1:)]
   end subroutine insert_change

   !> Value of the function.
   real(wp) function value_at_omega(self, x) result(value)
      class(omega_function_type), intent(in) :: self
      real(wp), intent(in) :: x

      associate (p => self%p, c => self%condition, &
                 epsilon => self%condition%epsilon_at(x, self%p%xi, self%p%gamma))
         select case (self%quantity)
         case (epsilon_above)
            value = epsilon - p%epsilon
         case (partner_above)
            value = c%partner_omega(x, epsilon, p%xi, p%gamma) - x
         case default
            value = x*(c%tau_at(x, epsilon, p%xi, p%gamma, self%k) - p%tau)
         end select
      end associate
   end function value_at_omega
end module stability_changes
