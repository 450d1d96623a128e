!> The linear systems of the simplified Newton iteration of a Radau IIA step. The stages part into
!> one real and some complex systems of size n (Hairer and Wanner 1996, sec. IV.8); where delayed
!> values lie in the step itself they do not, and one coupled system holds all stages.
module dde_stage_systems
   use dde_collocation, only: combined, lagrange_weights
   use dde_linear, only: factorise, solve
   use dde_radau_tableau, only: radau_tableau
   use kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: correct_real, stage_systems

   !> Factors for one Jacobian and one step length.
   type :: stage_systems
      !> Length that the factors belong to; 0 when there are none
      real(wp) :: h = 0.0_wp
      !> Whether the stages are coupled
      logical :: coupled = .false.
      !> Matrices factorised so far
      integer(int64) :: factorisations = 0
      !> Inverse of A
      real(wp), allocatable :: a_inverse(:, :)
      !> Factors of the real system, shape (n, n)
      real(wp), allocatable, private :: real_factors(:, :)
      !> Factors of the complex systems, shape (n, n, pairs)
      complex(wp), allocatable, private :: complex_factors(:, :, :)
      !> Factors of the coupled system, shape (n stages, n stages)
      real(wp), allocatable, private :: coupled_factors(:, :)
      !> Rows exchanged
      integer, allocatable, private :: real_pivot(:), complex_pivot(:, :), coupled_pivot(:)
   contains
      !> Factorise for a Jacobian and a length
      procedure :: prepare
      !> Newton correction of the transformed increments
      procedure :: correct
      !> Solution of the real system alone
      procedure :: filter
      procedure, private :: couple
   end type stage_systems

   interface stage_systems
      module procedure :: new_systems
   end interface stage_systems

contains

   !> Storage for n equations.
   pure function new_systems(method, n) result(systems)
      !> The method
      type(radau_tableau), intent(in) :: method
      !> Number of equations
      integer, intent(in) :: n
      type(stage_systems) :: systems

      associate (s => method%stages)
         allocate (systems%real_factors(n, n), systems%complex_factors(n, n, s/2))
         allocate (systems%real_pivot(n), systems%complex_pivot(n, s/2))
         allocate (systems%coupled_factors(n*s, n*s), systems%coupled_pivot(n*s))
         allocate (systems%a_inverse(s, s), source=inverse_of_a(method))
      end associate
   end function new_systems

   !> inverse(A) = T L inverse(T).
   pure function inverse_of_a(method) result(a_inverse)
      !> The method
      type(radau_tableau), intent(in) :: method
      real(wp) :: a_inverse(method%stages, method%stages)
      real(wp) :: blocks(method%stages, method%stages)
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
      a_inverse = transpose(combined(method%stages, method%stages, method%t, &
                                     combined(method%stages, method%stages, blocks, &
                                              transpose(method%t_inverse))))
   end function inverse_of_a

   !> Factorise the systems of a step of length `h`.
   pure subroutine prepare(self, method, h, by_y, by_z, component, own_place, singular)
      !> The systems
      class(stage_systems), intent(inout) :: self
      !> The method
      type(radau_tableau), intent(in) :: method
      !> Length of the step
      real(wp), intent(in) :: h
      !> Jacobian by y, shape (n, n)
      real(wp), intent(in) :: by_y(:, :)
      !> Jacobian by the delayed values, shape (n, delayed values)
      real(wp), intent(in) :: by_z(:, :)
      !> Component that each delayed value is
      integer, intent(in) :: component(:)
      !> Place of each stage's delayed values in the step, <= 0 in the past, as in the step
      real(wp), intent(in) :: own_place(:, :)
      !> Whether a system has no solution
      logical, intent(out) :: singular
      integer :: i, pair

      self%h = h
      self%coupled = any(own_place > 0.0_wp)
      self%real_factors = -by_y
      do i = 1, size(component)
         if (own_place(i, method%stages) > 0.0_wp) then
            associate (column => self%real_factors(:, component(i)))
               column = column - by_z(:, i)
            end associate
         end if
      end do
      do i = 1, size(by_y, 1)
         self%real_factors(i, i) = self%real_factors(i, i) + method%real_eigenvalue/h
      end do
      call factorise(self%real_factors, self%real_pivot, singular)
      self%factorisations = self%factorisations + 1
      if (singular) return
      if (self%coupled) then
         call self%couple(method, by_y, by_z, component, own_place, singular)
         return
      end if
      do pair = 1, size(method%complex_eigenvalues)
         associate (e => self%complex_factors(:, :, pair))
            e = cmplx(-by_y, kind=wp)
            do i = 1, size(by_y, 1)
               e(i, i) = e(i, i) + method%complex_eigenvalues(pair)/h
            end do
            call factorise(e, self%complex_pivot(:, pair), singular)
         end associate
         self%factorisations = self%factorisations + 1
         if (singular) return
      end do
   end subroutine prepare

   !> Factorise inverse(A)/h - J - (delayed part that lies in the step), all stages together.
   pure subroutine couple(self, method, by_y, by_z, component, own_place, singular)
      !> The systems
      class(stage_systems), intent(inout) :: self
      !> The method
      type(radau_tableau), intent(in) :: method
      !> Jacobian by y
      real(wp), intent(in) :: by_y(:, :)
      !> Jacobian by the delayed values
      real(wp), intent(in) :: by_z(:, :)
      !> Component that each delayed value is
      integer, intent(in) :: component(:)
      !> Place of each stage's delayed values in the step
      real(wp), intent(in) :: own_place(:, :)
      !> Whether it has no solution
      logical, intent(out) :: singular
      real(wp) :: weights(method%stages)
      integer :: column, i, j, k, n

      n = size(by_y, 1)
      self%coupled_factors = 0.0_wp
      do j = 1, method%stages
         do i = 1, method%stages
            do k = 1, n
               self%coupled_factors((i - 1)*n + k, (j - 1)*n + k) = self%a_inverse(i, j)/self%h
            end do
         end do
         associate (block => self%coupled_factors((j - 1)*n + 1:j*n, (j - 1)*n + 1:j*n))
            block = block - by_y
         end associate
      end do
      do i = 1, method%stages
         do k = 1, size(component)
            if (own_place(k, i) <= 0.0_wp) cycle
            weights = lagrange_weights([0.0_wp, method%c], own_place(k, i))
            do j = 1, method%stages
               column = (j - 1)*n + component(k)
               associate (part => self%coupled_factors((i - 1)*n + 1:i*n, column))
                  part = part - weights(j)*by_z(:, k)
               end associate
            end do
         end do
      end do
      call factorise(self%coupled_factors, self%coupled_pivot, singular)
      self%factorisations = self%factorisations + 1
   end subroutine couple

   !> Newton correction of the transforms inverse(T) Z of the increments Z.
   pure function correct(self, method, slopes, increments, transforms) result(change)
      !> The systems
      class(stage_systems), intent(in) :: self
      !> The method
      type(radau_tableau), intent(in) :: method
      !> Slopes at the stages, shape (n, stages)
      real(wp), intent(in) :: slopes(:, :)
      !> Increments Z, shape (n, stages)
      real(wp), intent(in) :: increments(:, :)
      !> Their transforms, shape (n, stages)
      real(wp), intent(in) :: transforms(:, :)
      real(wp) :: change(size(slopes, 1), size(slopes, 2))
      complex(wp) :: of_pair(size(slopes, 1))
      real(wp) :: all_stages(size(slopes))
      integer :: i, pair

      if (self%coupled) then
         all_stages = reshape(slopes - combined(size(slopes, 1), method%stages, self%a_inverse, &
                                                increments)/self%h, [size(slopes)])
         call solve(self%coupled_factors, self%coupled_pivot, all_stages)
         change = combined(size(slopes, 1), method%stages, method%t_inverse, all_stages)
         return
      end if
      change = combined(size(slopes, 1), method%stages, method%t_inverse, slopes)
      change(:, 1) = change(:, 1) - method%real_eigenvalue/self%h*transforms(:, 1)
      call solve(self%real_factors, self%real_pivot, change(:, 1))
      do pair = 1, size(method%complex_eigenvalues)
         i = 2*pair
         of_pair = cmplx(change(:, i), change(:, i + 1), wp) &
                   - method%complex_eigenvalues(pair)/self%h &
                   *cmplx(transforms(:, i), transforms(:, i + 1), wp)
         call solve(self%complex_factors(:, :, pair), self%complex_pivot(:, pair), of_pair)
         change(:, i) = real(of_pair)
         change(:, i + 1) = aimag(of_pair)
      end do
   end function correct

   !> Replace a vector by the solution of the real system for another Jacobian.
   pure subroutine correct_real(method, h, by_y, vector, singular)
      !> The method
      type(radau_tableau), intent(in) :: method
      !> Length of the step
      real(wp), intent(in) :: h
      !> Jacobian by y, shape (n, n); destroyed
      real(wp), intent(inout) :: by_y(:, :)
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), intent(inout) :: vector(:)
      !> Whether there is none
      logical, intent(out) :: singular
      integer :: i, pivot(size(vector))

      by_y = -by_y
      do i = 1, size(vector)
         by_y(i, i) = by_y(i, i) + method%real_eigenvalue/h
      end do
      call factorise(by_y, pivot, singular)
      if (.not. singular) call solve(by_y, pivot, vector)
   end subroutine correct_real

   !> Replace a vector by the solution of the real system: stiff components shrink, others stay.
   pure subroutine filter(self, vector)
      !> The systems
      class(stage_systems), intent(in) :: self
      !> Right-hand side, replaced by the solution, shape (n)
      real(wp), intent(inout) :: vector(:)

      call solve(self%real_factors, self%real_pivot, vector)
   end subroutine filter
end module dde_stage_systems
