! SPDX-License-Identifier: BSD-3-Clause
!> The linear systems of the simplified Newton iteration of a Radau IIA step. The stages part into
!> one real and some complex systems of size n (Hairer and Wanner 1996, sec. IV.8). Delayed values
!> that lie in the step itself couple these systems. Then there is one system for all stages.
module dde_stage_systems
   use dde_jacobian, only: jacobian_type
   use dde_radau_tableau, only: blocks_of, most_stages, radau_tableau
   use dde_systems, only: complex_system, real_system
   use dde_work, only: work_type
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: fill_end, stage_systems

   !> Factors for one Jacobian and one step length.
   type :: stage_systems
      !> Length that the factors belong to; 0 when there are none
      real(wp) :: h = 0.0_wp
      !> Whether delayed values lie in the step
      logical :: coupled = .false.
      !> The real system
      type(real_system) :: of_real
      !> The complex systems, shape (pairs)
      type(complex_system), allocatable :: of_pairs(:)
      !> Right-hand side of one of them, shape (n)
      complex(wp), allocatable, private :: pair_side(:)
      !> The system of all stages if they are coupled: (j - 1) stages + i is the transform i of
      !> equation j
      type(real_system), allocatable :: of_all
      !> Its right-hand side, shape (stages, n)
      real(wp), allocatable, private :: all_sides(:, :)
   contains
      procedure :: couple, prepare, solve
      procedure, private :: add_delayed
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
         allocate (systems%of_pairs(s/2), systems%pair_side(n))
      end associate
   end function new_systems

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
      if (self%coupled) then
         call self%couple(method, jacobian, component, own_place, own_weights)
         call self%of_all%factorise(singular)
         call work%count_factors(self%of_all%factor_operations)
         if (singular) return
      else
         call fill_end(self%of_real, method, h, jacobian, component, own_place)
      end if
      call self%of_real%factorise(singular)
      call work%count_factors(self%of_real%factor_operations)
      if (singular .or. self%coupled) return
      do pair = 1, size(self%of_pairs)
         call self%of_pairs(pair)%fill(jacobian, &
                                       cmplx(real(method%complex_eigenvalues(pair))/h, &
                                             aimag(method%complex_eigenvalues(pair))/h, wp))
         call self%of_pairs(pair)%factorise(singular)
         call work%count_factors(self%of_pairs(pair)%factor_operations)
         if (singular) return
      end do
   end subroutine prepare

   !> The real system, in which delayed values in the step count as the state at its end.
   pure subroutine fill_end(system, method, h, jacobian, component, own_place)
      type(real_system), intent(inout) :: system
      type(radau_tableau), intent(in) :: method
      real(wp), intent(in) :: h
      type(jacobian_type), intent(in) :: jacobian
      integer, intent(in) :: component(:)
      !> As for `prepare`
      real(wp), intent(in) :: own_place(:, :)
      real(wp) :: derivative
      integer(int64) :: at
      integer :: above, below, i, k

      below = jacobian%lower
      above = jacobian%upper
      do k = 1, size(component)
         if (.not. own_place(k, method%stages) > 0.0_wp) cycle
         below = max(below, jacobian%rows(2, k) - component(k))
         above = max(above, component(k) - jacobian%rows(1, k))
      end do
      call system%reshape(size(jacobian%by_y, 2), below, above)
      call system%fill(jacobian, method%real_eigenvalue/h)
      do k = 1, size(component)
         if (.not. own_place(k, method%stages) > 0.0_wp) cycle
         at = system%column(component(k))
         do i = jacobian%rows(1, k), jacobian%rows(2, k)
            derivative = jacobian%by_z(1 + i - jacobian%rows(1, k), k)
            system%a(at + i) = system%a(at + i) - derivative
            system%row_scale(i) = system%row_scale(i)/(1.0_wp + abs(derivative)*system%row_scale(i))
         end do
      end do
   end subroutine fill_end

   !> Fill the real system and that of all stages, for a step of length `h`.
   pure subroutine couple(self, method, jacobian, component, own_place, own_weights)
      class(stage_systems), intent(inout) :: self
      type(radau_tableau), intent(in) :: method
      type(jacobian_type), intent(in) :: jacobian
      integer, intent(in) :: component(:)
      real(wp), intent(in) :: own_place(:, :), own_weights(:, :, :)
      real(wp), dimension(method%stages, method%stages) :: blocks
      integer(int64) :: at
      integer :: first, i, j, k, last, shift

      call fill_end(self%of_real, method, self%h, jacobian, component, own_place)
      blocks = blocks_of(method)/self%h
      associate (n => size(jacobian%by_y, 2), s => method%stages)
         if (.not. allocated(self%of_all)) allocate (self%of_all, self%all_sides(s, n))
         call self%of_all%reshape(n*s, (self%of_real%layout%lower + 1)*s - 1, &
                                  (self%of_real%layout%upper + 1)*s - 1)
         self%of_all%a = 0.0_wp
         do j = 1, n
            call jacobian%find_rows(j, first, last, shift)
            do k = 1, s
               at = self%of_all%column((j - 1)*s + k)
               do i = first, last
                  self%of_all%a(at + (i - 1)*s + k) = -jacobian%by_y(shift + i, j)
               end do
               at = at + (j - 1)*s
               self%of_all%a(at + 1:at + s) = self%of_all%a(at + 1:at + s) + blocks(:, k)
            end do
         end do
         do k = 1, size(component)
            if (own_place(k, s) > 0.0_wp) then
               call self%add_delayed(method, jacobian, component(k), k, own_place(k, :), &
                                     own_weights(:, k, :))
            end if
         end do
         self%of_all%row_scale = [spread(self%of_real%row_scale, 1, s)]
      end associate
   end subroutine couple

   !> Add delayed value k, which lies in the step, to the matrix of all stages.
   pure subroutine add_delayed(self, method, jacobian, component, k, place, weights)
      class(stage_systems), intent(inout) :: self
      type(radau_tableau), intent(in) :: method
      type(jacobian_type), intent(in) :: jacobian
      !> Component that it is, and its number
      integer, intent(in) :: component, k
      !> Place in the step at each stage, and weights of the increments there, one row an increment
      real(wp), intent(in) :: place(:), weights(:, :)
      !> W T, where row i of W has the weights at stage i; then a column of inverse(T) W T
      real(wp) :: by_stages(most_stages, most_stages), transforms(most_stages)
      integer(int64) :: at
      integer :: i, j, m

      associate (s => method%stages, first => jacobian%rows(1, k), last => jacobian%rows(2, k))
         by_stages = 0.0_wp
         do i = 1, s
            if (.not. place(i) > 0.0_wp) cycle
            do j = 1, s
               do m = 1, s
                  by_stages(i, j) = by_stages(i, j) + weights(m, i)*method%t(m, j)
               end do
            end do
         end do
         transforms = 0.0_wp
         do j = 1, s
            do i = 1, s
               transforms(i) = method%t_inverse(i, 1)*by_stages(1, j)
               do m = 2, s
                  transforms(i) = transforms(i) + method%t_inverse(i, m)*by_stages(m, j)
               end do
            end do
            at = self%of_all%column((component - 1)*s + j)
            do i = first, last
               associate (block => self%of_all%a(at + (i - 1)*s + 1:at + i*s))
                  block = block - jacobian%by_z(1 + i - first, k)*transforms(:s)
               end associate
            end do
         end do
      end associate
   end subroutine add_delayed

   !> Solution of the systems of all stages.
   pure subroutine solve(self, x, work)
      class(stage_systems), intent(inout) :: self
      !> Right-hand sides of the transforms, replaced by the solutions, shape (n, stages)
      real(wp), contiguous, intent(inout) :: x(:, :)
      type(work_type), intent(inout) :: work
      integer :: i, pair

      if (self%coupled) then
         self%all_sides = transpose(x)
         call self%of_all%solve(self%all_sides)
         work%operations = work%operations + self%of_all%solve_operations
         x = transpose(self%all_sides)
         return
      end if
      call self%of_real%solve(x(:, 1))
      work%operations = work%operations + self%of_real%solve_operations
      do pair = 1, size(self%of_pairs)
         i = 2*pair
         self%pair_side(:) = cmplx(x(:, i), x(:, i + 1), wp)
         call self%of_pairs(pair)%solve(self%pair_side)
         work%operations = work%operations + self%of_pairs(pair)%solve_operations
         x(:, i) = real(self%pair_side)
         x(:, i + 1) = aimag(self%pair_side)
      end do
   end subroutine solve
end module dde_stage_systems
