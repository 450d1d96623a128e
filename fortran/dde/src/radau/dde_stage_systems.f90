!> The linear systems of the simplified Newton iteration of a Radau IIA step. The stages part into
!> one real and some complex systems of size n (Hairer and Wanner 1996, sec. IV.8). Delayed values
!> that lie in the step itself couple these systems. They are additional unknowns.
module dde_stage_systems
   use dde_collocation, only: combine, in_lanes, stage_lanes
   use dde_coupling, only: coupling_type
   use dde_jacobian, only: jacobian_type
   use dde_radau_tableau, only: radau_tableau
   use dde_systems, only: complex_system, real_system
   use dde_work, only: work_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: stage_systems

   !> Factors for one Jacobian and one step length.
   type :: stage_systems
      !> Length that the factors belong to; 0 when there are none
      real(wp) :: h = 0.0_wp
      !> Whether delayed values lie in the step
      logical :: coupled = .false.
      !> T of the method, its inverse, and inverse(A), shape (stage_lanes, stages)
      real(wp), allocatable, dimension(:, :) :: t, t_inverse, a_inverse
      !> The real system
      type(real_system), private :: of_real
      !> The complex systems, shape (pairs)
      type(complex_system), allocatable, private :: of_pairs(:)
      !> Right-hand side of one of them, shape (n)
      complex(wp), allocatable, private :: pair_side(:)
      !> Right-hand sides of all stages for one delayed value, shape (n, stages)
      real(wp), allocatable, private :: solution(:, :)
      !> Delayed values of all stages, and those at the end of the step for the real system alone
      !> (allocatable: of two components of one type, gfortran frees only the first with the step)
      type(coupling_type), allocatable, private :: of_stages, of_end
   contains
      procedure :: prepare, correct, filter
      procedure, private :: couple, solve_stages
   end type stage_systems

   interface stage_systems
      module procedure :: new_systems
   end interface stage_systems

contains

   !> Storage for n equations.
   pure function new_systems(method, n) result(systems)
      type(radau_tableau), intent(in) :: method
      integer, intent(in) :: n
      type(stage_systems) :: systems

      associate (s => method%stages)
         allocate (systems%of_pairs(s/2), systems%pair_side(n), systems%solution(n, s))
         systems%t = in_lanes(method%t)
         systems%t_inverse = in_lanes(method%t_inverse)
         systems%a_inverse = inverse_of_a(method)
      end associate
   end function new_systems

   !> inverse(A) = T L inverse(T).
   pure function inverse_of_a(method) result(a_inverse)
      type(radau_tableau), intent(in) :: method
      real(wp) :: a_inverse(stage_lanes, method%stages)
      real(wp), dimension(method%stages, method%stages) :: blocks, first, second
      integer :: i, pair

      blocks = 0.0_wp
      blocks(1, 1) = method%real_eigenvalue
      do pair = 1, size(method%complex_eigenvalues)
         i = 2*pair
         associate (alpha => real(method%complex_eigenvalues(pair)), &
                    beta => aimag(method%complex_eigenvalues(pair)))
            blocks(i:i + 1, i) = [alpha, beta]
            blocks(i:i + 1, i + 1) = [-beta, alpha]
         end associate
      end do
      associate (s => method%stages)
         call combine(s, s, in_lanes(blocks), transpose(method%t_inverse), first)
         call combine(s, s, in_lanes(method%t), first, second)
         a_inverse = in_lanes(transpose(second))
      end associate
   end function inverse_of_a

   !> Factorise the systems of a step of length `h`.
   pure subroutine prepare(self, method, h, jacobian, component, own_place, own_weights, work, &
                           singular)
      class(stage_systems), intent(inout) :: self
      type(radau_tableau), intent(in) :: method
      real(wp), intent(in) :: h
      type(jacobian_type), intent(in) :: jacobian
      integer, intent(in) :: component(:)
      !> Place of each stage's delayed values in the step, <= 0 in the past, shape (delayed values,
      !> stages)
      real(wp), intent(in) :: own_place(:, :)
      !> Weights of the stage increments in those, shape (stages, delayed values, stages)
      real(wp), intent(in) :: own_weights(:, :, :)
      type(work_type), intent(inout) :: work
      logical, intent(out) :: singular
      integer :: pair

      self%h = h
      self%coupled = any(own_place > 0.0_wp)
      call self%of_real%prepare(jacobian, method%real_eigenvalue/h, singular)
      work%factorisations = work%factorisations + 1
      work%operations = work%operations + self%of_real%factor_operations
      if (singular) return
      do pair = 1, size(self%of_pairs)
         call self%of_pairs(pair)%prepare(jacobian, method%complex_eigenvalues(pair)/h, singular)
         work%factorisations = work%factorisations + 1
         work%operations = work%operations + self%of_pairs(pair)%factor_operations
         if (singular) return
      end do
      if (self%coupled) then
         call self%couple(method, jacobian%by_z, component, own_place, own_weights, work, singular)
      end if
   end subroutine prepare

   !> Make the delayed values that lie in the step unknowns. The others have weight 0.
   pure subroutine couple(self, method, by_z, component, own_place, own_weights, work, singular)
      class(stage_systems), intent(inout) :: self
      type(radau_tableau), intent(in) :: method
      real(wp), intent(in) :: by_z(:, :)
      integer, intent(in) :: component(:)
      real(wp), intent(in) :: own_place(:, :), own_weights(:, :, :)
      type(work_type), intent(inout) :: work
      logical, intent(out) :: singular
      integer :: i, j, k, unknown

      if (.not. allocated(self%of_stages)) then
         self%of_stages = coupling_type(size(by_z, 1)*method%stages, size(component)*method%stages)
         self%of_end = coupling_type(size(by_z, 1), size(component))
      end if
      call self%of_stages%clear()
      call self%of_end%clear()
      associate (n => size(by_z, 1), s => method%stages, last => method%stages)
         do k = 1, size(component)
            do i = 1, s
               unknown = (k - 1)*s + i
               if (.not. own_place(k, i) > 0.0_wp) cycle
               do j = 1, s
                  self%of_stages%weights((j - 1)*n + component(k), unknown) &
                     = sum(own_weights(:, k, i)*self%t(:s, j))
                  self%solution(:, j) = self%t_inverse(j, i)*by_z(:, k)
               end do
               call self%solve_stages(self%solution, work)
               self%of_stages%solutions(:, unknown) = reshape(self%solution, [n*s])
            end do
            if (own_place(k, last) > 0.0_wp) then
               self%of_end%weights(component(k), k) = 1.0_wp
               self%of_end%solutions(:, k) = by_z(:, k)
               call self%of_real%solve(self%of_end%solutions(:, k))
            end if
         end do
      end associate
      call self%of_end%prepare(singular)
      work%factorisations = work%factorisations + 1
      if (singular) return
      call self%of_stages%prepare(singular)
      work%factorisations = work%factorisations + 1
   end subroutine couple

   !> Solution of the real and the complex systems, for transformed stages.
   pure subroutine solve_stages(self, x, work)
      class(stage_systems), intent(inout) :: self
      !> Right-hand sides, replaced by the solutions, shape (n, stages)
      real(wp), contiguous, intent(inout) :: x(:, :)
      type(work_type), intent(inout) :: work
      integer :: i, pair

      call self%of_real%solve(x(:, 1))
      work%operations = work%operations + self%of_real%solve_operations
      do pair = 1, size(self%of_pairs)
         i = 2*pair
         self%pair_side = cmplx(x(:, i), x(:, i + 1), wp)
         call self%of_pairs(pair)%solve(self%pair_side)
         work%operations = work%operations + self%of_pairs(pair)%solve_operations
         x(:, i) = real(self%pair_side)
         x(:, i + 1) = aimag(self%pair_side)
      end do
   end subroutine solve_stages

   !> Newton correction of the transforms inverse(T) Z of the increments Z.
   pure subroutine correct(self, method, slopes, transforms, work, change)
      class(stage_systems), intent(inout) :: self
      type(radau_tableau), intent(in) :: method
      !> Slopes at the stages, shape (n, stages)
      real(wp), contiguous, intent(in) :: slopes(:, :)
      !> Transforms of the increments, shape (n, stages)
      real(wp), intent(in) :: transforms(:, :)
      type(work_type), intent(inout) :: work
      !> The correction, shape (n, stages)
      real(wp), contiguous, intent(out) :: change(:, :)
      complex(wp) :: eigenvalue
      integer :: i, pair

      call combine(size(slopes, 1), method%stages, self%t_inverse, slopes, change)
      change(:, 1) = change(:, 1) - method%real_eigenvalue/self%h*transforms(:, 1)
      do pair = 1, size(method%complex_eigenvalues)
         i = 2*pair
         eigenvalue = method%complex_eigenvalues(pair)/self%h
         change(:, i) = change(:, i) - (real(eigenvalue)*transforms(:, i) &
                                        - aimag(eigenvalue)*transforms(:, i + 1))
         change(:, i + 1) = change(:, i + 1) - (real(eigenvalue)*transforms(:, i + 1) &
                                                + aimag(eigenvalue)*transforms(:, i))
      end do
      call self%solve_stages(change, work)
      if (self%coupled) call self%of_stages%complete(change)
   end subroutine correct

   !> Replace a vector by the solution of the real system. Only its stiff components shrink.
   pure subroutine filter(self, vector)
      class(stage_systems), intent(inout) :: self
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), contiguous, intent(inout) :: vector(:)

      call self%of_real%solve(vector)
      if (self%coupled) call self%of_end%complete(vector)
   end subroutine filter
end module dde_stage_systems
