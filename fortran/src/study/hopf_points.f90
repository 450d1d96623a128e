!> What happens along Hopf curves: the first Lyapunov coefficient and the pairs that are unstable
!> beside the one on the axis, and the points at which the kind of the bifurcation changes.
module hopf_points
   use block_equation, only: block_equation_type
   use block_family, only: along_tau
   use block_parameters, only: block_parameters_type
   use dde_errors, only: error_type
   use gsl_roots, only: find_falling_root, find_root, scalar_function_type
   use hopf_condition, only: hopf_condition_type, two_pi
   use hopf_curves, only: curve_point_type
   use hopf_planes, only: curve_plane_type
   use hopf_unfoldings, only: unfold_double_hopf, unfold_generalised_hopf, unfolding_type
   use dde_kinds, only: wp
   use normal_form, only: first_lyapunov_coefficient
   use root_counts, only: pairs_beside
   use spring_block, only: block_characteristic
   use stability_changes, only: angle_above, omega_function_type
   implicit none (type, external)
   private
   public :: find_hopf_points, hopf_point_type, judge_points, kind_length

   !> Letters of a kind of point.
   integer, parameter :: kind_length = 20
   !> Marks a function that meets no branch.
   integer, parameter :: no_branch = -1
   !> The coefficient passes through 0, not through a pole, where it is this small.
   real(wp), parameter :: small_coefficient = 1.0e-7_wp

   !> A point at which two pairs of roots are imaginary, or the coefficient is 0, or the delay is 0.
   type :: hopf_point_type
      !> 'generalised_hopf', 'double_hopf' or 'hopf_without_delay'
      character(len=kind_length) :: kind = ""
      !> Parameters, nondimensional
      type(block_parameters_type) :: parameters
      !> Frequency of the pair, and of the second one (0: none)
      real(wp) :: omega(2) = 0.0_wp
      !> Branches of equation (10) (-1: none)
      integer :: branch(2) = -1
      !> First Lyapunov coefficients of the pairs
      real(wp) :: l1(2) = 0.0_wp
      !> Unstable pairs beside these
      integer :: unstable_pairs = 0
      !> Normal form of a generalised or double Hopf point
      type(unfolding_type) :: unfolding
   end type hopf_point_type

   !> Along a branch the first Lyapunov coefficient (0 if there is none, which `add_point` then
   !> reports), or the number of the branch that a second frequency would be on, less a given one.
   type, extends(scalar_function_type) :: branch_function_type
      !> The plane
      type(curve_plane_type) :: plane
      !> Branch
      integer :: k = 0
      !> The branch to meet, or `no_branch` for the coefficient
      integer :: other = no_branch
   contains
      procedure :: value => value_along_branch
   end type branch_function_type

contains

   !> First Lyapunov coefficients and numbers of unstable pairs of points on curves.
   subroutine judge_points(points, error)
      !> The points
      type(curve_point_type), intent(inout) :: points(:)
      !> No coefficient: another root at 2 i omega
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(points)
         associate (point => points(i))
            call first_lyapunov_coefficient(block_equation_type(point%parameters), point%omega, &
                                            point%l1, error)
            if (allocated(error)) return
            point%unstable_pairs = pairs_beside(block_characteristic(point%parameters), &
                                                [point%omega])
         end associate
      end do
   end subroutine judge_points

   !> All special points on curves that have been judged.
   subroutine find_hopf_points(plane, points, found, error)
      !> The plane
      type(curve_plane_type), intent(in) :: plane
      !> Points of its curves
      type(curve_point_type), intent(in) :: points(:)
      !> Special points
      type(hopf_point_type), allocatable, intent(out) :: found(:)
      !> A root was not found
      type(error_type), allocatable, intent(out) :: error
      type(branch_function_type) :: coefficient, meeting
      real(wp) :: x
      integer :: i, m

      allocate (found(0))
      coefficient%plane = plane
      meeting%plane = plane
      call find_start(plane, found, error)
      do i = 1, size(points) - 1
         if (allocated(error)) return
         associate (p => points(i), q => points(i + 1))
            if (p%piece /= q%piece) cycle
            coefficient%k = p%branch
            if (p%l1 < 0.0_wp .neqv. q%l1 < 0.0_wp) then
               call find_root(coefficient, place(p), place(q), x, error)
               if (allocated(error)) return
               if (abs(coefficient%value(x)) <= small_coefficient) then
                  call add_point(found, "generalised_hopf", plane, x, [p%branch], error)
               end if
            end if
            ! of two frequencies at the same parameters, the lower one's pair becomes stable
            if (p%crossing > 0 .or. q%crossing > 0) cycle
            meeting%k = p%branch
            meeting%other = 0
            associate (here => meeting%value(place(p)), there => meeting%value(place(q)))
               do m = max(0, ceiling(min(here, there))), floor(max(here, there))
                  if (m == p%branch .or. allocated(error)) cycle
                  meeting%other = m
                  call find_root(meeting, place(p), place(q), x, error)
                  if (allocated(error)) return
                  call add_point(found, "double_hopf", plane, x, [p%branch, m], error)
               end do
            end associate
         end associate
      end do

   contains

      !> Where a point is on its branch: its frequency, or its ordinate.
      pure real(wp) function place(point) result(x)
         type(curve_point_type), intent(in) :: point

         x = merge(point%omega, plane%ordinate(point%parameters), plane%by_frequency())
      end function place
   end subroutine find_hopf_points

   !> The point without delay, where the plane shows it.
   subroutine find_start(plane, found, error)
      type(curve_plane_type), intent(in) :: plane
      type(hopf_point_type), allocatable, intent(inout) :: found(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: omega

      if (plane%along /= along_tau .or. plane%ordinate_window(1) > 0.0_wp) return
      ! omega tau falls from pi/2 as omega grows
      call find_falling_root(omega_function_type(angle_above, plane%fixed, plane%condition), &
                             1.0_wp, omega, error)
      if (allocated(error)) return
      associate (p => plane%at(omega, 0), window => plane%epsilon_window)
         if (p%epsilon < window(1) .or. p%epsilon > window(2)) return
      end associate
      call add_point(found, "hopf_without_delay", plane, omega, [0], error)
   end subroutine find_start

   !> Append a point with its coefficients and its normal form.
   subroutine add_point(found, kind, plane, x, branch, error)
      type(hopf_point_type), allocatable, intent(inout) :: found(:)
      character(len=*), intent(in) :: kind
      type(curve_plane_type), intent(in) :: plane
      !> Where the point is on the first branch
      real(wp), intent(in) :: x
      !> Branches, that of the lower frequency first
      integer, intent(in) :: branch(:)
      type(error_type), allocatable, intent(out) :: error
      type(hopf_condition_type) :: condition
      type(hopf_point_type) :: point
      real(wp) :: omega(size(branch))
      integer :: i

      point%kind = kind
      point%parameters = plane%at(x, branch(1), omega(1))
      call plane%condition_at(point%parameters, condition, error)
      if (allocated(error)) return
      associate (p => point%parameters)
         omega(2:) = condition%partner_omega(omega(1), p%epsilon, p%xi, p%gamma)
      end associate
      point%parameters%tau = max(point%parameters%tau, 0.0_wp)
      point%unstable_pairs = pairs_beside(block_characteristic(point%parameters), omega)
      do i = 1, size(omega)
         point%omega(i) = omega(i)
         point%branch(i) = branch(i)
         call first_lyapunov_coefficient(block_equation_type(point%parameters), omega(i), &
                                         point%l1(i), error)
         if (allocated(error)) return
      end do
      select case (kind)
      case ("generalised_hopf")
         call unfold_generalised_hopf(plane, x, branch(1), point%unfolding, error)
      case ("double_hopf")
         call unfold_double_hopf(plane, point%parameters, point%omega, point%unfolding, error)
      case default
      end select
      found = [found, point]
   end subroutine add_point

   !> The coefficient, or 0 where the second frequency is one of the other branch, too.
   real(wp) function value_along_branch(self, x) result(value)
      class(branch_function_type), intent(in) :: self
      real(wp), intent(in) :: x
      type(block_parameters_type) :: p
      type(error_type), allocatable :: error
      type(hopf_condition_type) :: c
      real(wp) :: omega, partner

      p = self%plane%at(x, self%k, omega)
      if (self%other == no_branch) then
         call first_lyapunov_coefficient(block_equation_type(p), omega, value, error)
      else
         call self%plane%condition_at(p, c, error)
         partner = c%partner_omega(omega, p%epsilon, p%xi, p%gamma)
         value = partner*(p%tau - c%tau_at(partner, p%epsilon, p%xi, p%gamma, 0))/two_pi &
                 - self%other
      end if
   end function value_along_branch
end module hopf_points
