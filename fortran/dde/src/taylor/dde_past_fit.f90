! SPDX-License-Identifier: BSD-3-Clause
!> A delayed value over a step that spans several polynomials of the past, as one polynomial: a
!> truncated Chebyshev series through its values at Chebyshev nodes of the step (Trefethen 2013,
!> "Approximation Theory and Approximation Practice", ch. 3).
module dde_past_fit
   use dde_interpolant, only: series_value
   use dde_step_context, only: step_context
   use dde_time, only: elapsed
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: past_fit

   !> Least and most nodes. Fewer than the degree suffice: the series converges faster than powers.
   integer, parameter :: least_nodes = 7, most_nodes = 14
   !> Last coefficients that must vanish: the others then hold the past.
   integer, parameter :: vanishing = 2
   !> Sum of the Chebyshev coefficients that are left out, over the largest difference allowed.
   real(wp), parameter :: left_out = 0.5_wp

   !> Nodes and transformations.
   type :: past_fit
      !> Number of nodes
      integer :: nodes = 0
      !> Start, nodes and end as shares of the step
      real(wp), private :: places(0:most_nodes + 1) = 0.0_wp
      !> From values at the nodes to Chebyshev coefficients, and from these to powers of the share
      !> of the step; one coefficient a column, and one polynomial a column
      real(wp), private :: to_chebyshev(most_nodes, 0:most_nodes - 1) = 0.0_wp
      real(wp), private :: to_powers(0:most_nodes - 1, 0:most_nodes - 1) = 0.0_wp
   contains
      procedure :: fit
   end type past_fit

   interface past_fit
      module procedure :: new_fit
   end interface past_fit

contains

   !> Fits for series of a degree.
   pure type(past_fit) function new_fit(degree) result(self)
      integer, intent(in) :: degree
      real(wp) :: chebyshev(0:most_nodes - 1), x
      integer :: i, n

      self%nodes = max(least_nodes, min(most_nodes, degree - 4))
      self%places(self%nodes + 1) = 1.0_wp
      do i = 1, self%nodes
         x = -cos(acos(-1.0_wp)*(2*i - 1)/(2*self%nodes))
         self%places(i) = 0.5_wp*(1.0_wp + x)
         chebyshev(:1) = [1.0_wp, x]
         do n = 2, self%nodes - 1
            chebyshev(n) = 2.0_wp*x*chebyshev(n - 1) - chebyshev(n - 2)
         end do
         chebyshev(0) = 0.5_wp
         self%to_chebyshev(i, :self%nodes - 1) = 2.0_wp/self%nodes*chebyshev(:self%nodes - 1)
      end do
      associate (t => self%to_powers)
         t(0, 0) = 1.0_wp
         t(:1, 1) = [-1.0_wp, 2.0_wp]
         do n = 2, self%nodes - 1
            t(:n, n) = -2.0_wp*t(:n, n - 1) - t(:n, n - 2)
            t(1:n, n) = t(1:n, n) + 4.0_wp*t(:n - 1, n - 1)
         end do
      end associate
   end function new_fit

   !> Fit delayed value k over a step. It is compared with the past at the ends of the step, near
   !> which it may bend, and where polynomials of the past begin: a transient has left short ones.
   pure subroutine fit(self, context, k, h, agreement, coefficients, misfit)
      class(past_fit), intent(in) :: self
      type(step_context), intent(inout) :: context
      integer, intent(in) :: k
      !> Length of the step
      real(wp), intent(in) :: h
      !> Largest difference from the past, over the tolerance
      real(wp), intent(in) :: agreement
      !> Coefficients of the powers of the share of the step
      real(wp), contiguous, intent(out) :: coefficients(0:)
      !> Largest difference that is seen, over the largest allowed
      real(wp), intent(out) :: misfit
      real(wp) :: allowed, chebyshev(0:most_nodes - 1), place, tail, values(1, 0:most_nodes + 1)
      integer(int64) :: step
      integer :: degree, n

      associate (nodes => self%nodes, past => context%past, cursor => context%cursor)
         step = past%oldest
         if (.not. cursor%before_origin(k)) step = cursor%step(k) + 1
         call cursor%values_of(context%problem, past, k, nodes + 2, h*self%places(:nodes + 1), 1, &
                               1, values)
         allowed = agreement*context%tolerance%of_component(context%problem%component(k), &
                                                              values(1, 0))
         do n = 0, nodes - 1
            chebyshev(n) = dot_product(self%to_chebyshev(:nodes, n), values(1, 1:nodes))
         end do
         degree = nodes - 1
         tail = 0.0_wp
         do while (degree > 0)
            if (tail + abs(chebyshev(degree)) > left_out*allowed) exit
            tail = tail + abs(chebyshev(degree))
            degree = degree - 1
         end do
         misfit = sum(abs(chebyshev(nodes - vanishing:nodes - 1)))/(left_out*allowed)
         if (degree >= nodes - vanishing) return
         coefficients = 0.0_wp
         do n = 0, degree
            coefficients(:n) = coefficients(:n) + chebyshev(n)*self%to_powers(:n, n)
         end do
         misfit = max(abs(coefficients(0) - values(1, 0)), &
                      abs(sum(coefficients(:degree)) - values(1, nodes + 1)))/allowed
         do while (step <= past%newest)
            place = elapsed(cursor%delayed_start(k), past%start_of(step))/h
            if (place >= 1.0_wp) exit
            misfit = max(misfit, abs(series_value(degree, coefficients, place) &
                                     - past%value(step, k, 0.0_wp))/allowed)
            step = step + 1
         end do
      end associate
   end subroutine fit
end module dde_past_fit
