!> Tangent vectors in the space of histories: a vector is a disturbance of the state and of what the
!> delays still reach of the delayed components, with the inner product
!>
!>     <a, b> = sum_i a_i(t) b_i(t) + sum_c 1/L_c integral from t - L_c to t of a_c b_c,
!>
!> c the delayed components and L_c the longest delay of each. The integral is exact but for
!> rounding: Gauss's rule on each step for products of the polynomials that the solver keeps.
module tangent_vectors
   use dde, only: continuation_type, dde_problem_type, elapsed, instant
   use dde_kinds, only: wp
   use tangent_problem, only: tangent_problem_type
   implicit none (type, external)
   private
   public :: orthonormalise, start_vectors

   !> Nodes of Gauss's rule of nine nodes on [0, 1], exact up to degree 17, and its weights.
   integer, parameter :: gauss_nodes = 9
   real(wp), parameter :: half_node(gauss_nodes) = 0.5_wp*[ &
      -0.96816023950762609_wp, -0.83603110732663579_wp, -0.61337143270059040_wp, &
      -0.32425342340380893_wp, 0.0_wp, 0.32425342340380893_wp, &
      0.61337143270059040_wp, 0.83603110732663579_wp, 0.96816023950762609_wp]
   real(wp), parameter :: weight(gauss_nodes) = 0.5_wp*[ &
      0.08127438836157441_wp, 0.18064816069485740_wp, 0.26061069640293546_wp, &
      0.31234707704000284_wp, 0.33023935500125976_wp, 0.31234707704000284_wp, &
      0.26061069640293546_wp, 0.18064816069485740_wp, 0.08127438836157441_wp]

   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   !> Carry a run of the undisturbed problem on with tangent vectors: vector j disturbs a delayed
   !> component by a cosine of j - 1 half waves over its past, and one of the others by 1.
   subroutine start_vectors(problem, undisturbed, continuation)
      !> The problem with its tangent vectors
      type(tangent_problem_type), intent(in) :: problem
      !> Where the run of the undisturbed problem ended
      type(continuation_type), intent(in) :: undisturbed
      !> The same with tangent vectors
      type(continuation_type), intent(out) :: continuation
      real(wp) :: phase, turned
      integer :: i, j, k, kept, row

      continuation = undisturbed
      associate (n => problem%base%n, m => problem%vectors)
         continuation%y = [undisturbed%y, (0.0_wp, i=1, n*m)]
         continuation%slope = [undisturbed%slope, (0.0_wp, i=1, n*m)]
         kept = size(undisturbed%kept)
         continuation%kept = [((undisturbed%kept(i) + j*n, i=1, kept), j=0, m)]
         deallocate (continuation%coefficients)
         allocate (continuation%coefficients(size(undisturbed%coefficients, 1), kept*(m + 1), &
                                             size(undisturbed%step_length)), source=0.0_wp)
         continuation%coefficients(:, :kept, :) = undisturbed%coefficients
         do j = 1, m
            continuation%y(j*n + 1 + modulo(j - 1, n)) = 1.0_wp
            do row = 1, kept
               i = undisturbed%kept(row)
               turned = pi*(j - 1)/longest_delay(problem%base, i)
               continuation%y(j*n + i) = cos(real(i, wp))
               do k = 1, size(undisturbed%step_length)
                  phase = i + turned*before(undisturbed, k)
                  continuation%coefficients(:, j*kept + row, k) = &
                     cosine(phase, turned*undisturbed%step_length(k), undisturbed%nodes(:, k))
               end do
            end do
         end do
      end associate
   end subroutine start_vectors

   !> Time from now to the start of kept step k, negative.
   pure real(wp) function before(continuation, k) result(value)
      !> The continuation
      type(continuation_type), intent(in) :: continuation
      !> Which step
      integer, intent(in) :: k

      associate (now => continuation%time, start => continuation%step_start(:, k))
         value = elapsed(instant(now(1), now(2)), instant(start(1), start(2)))
      end associate
   end function before

   !> Newton coefficients of cos(phase + turn s) for 0 <= s <= 1, as its Taylor polynomial of a
   !> degree that every method's nodes allow.
   pure function cosine(phase, turn, nodes) result(a)
      !> Angle at the start of the step
      real(wp), intent(in) :: phase
      !> Angle over the step
      real(wp), intent(in) :: turn
      !> Newton nodes of the step
      real(wp), intent(in) :: nodes(:)
      real(wp) :: a(0:size(nodes))
      integer, parameter :: degree = 4
      integer :: i, j

      a = 0.0_wp
      a(0) = cos(phase)
      do j = 1, degree
         a(j) = turn**j/gamma(real(j + 1, wp))*cos(phase + 0.5_wp*pi*j)
      end do
      ! powers of s to Newton form: divide by s - node again and again
      do i = 1, degree
         do j = degree - 1, i - 1, -1
            a(j) = a(j) + nodes(i)*a(j + 1)
         end do
      end do
   end function cosine

   !> Longest delay of a component.
   pure real(wp) function longest_delay(problem, component) result(value)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> Delayed component
      integer, intent(in) :: component

      value = maxval(problem%lag, mask=problem%component == component)
   end function longest_delay

   !> Replace the vectors by orthogonal ones of norm `size_after` that span the same, by Gram and
   !> Schmidt's procedure done twice; state, slope and past of a vector take part alike, so that the
   !> new ones are solutions as well.
   pure subroutine orthonormalise(problem, size_after, continuation, norm, share)
      !> The problem with its tangent vectors
      type(tangent_problem_type), intent(in) :: problem
      !> Norm that the vectors get
      real(wp), intent(in) :: size_after
      !> Where the run stands
      type(continuation_type), intent(inout) :: continuation
      !> Norm of the part of each vector that is orthogonal to those before it, shape (vectors)
      real(wp), intent(out) :: norm(:)
      !> Least share that such a part had of its vector
      real(wp), intent(out) :: share
      real(wp), allocatable :: columns(:, :)
      real(wp) :: whole
      integer :: i, j, kept, pass, rows

      associate (n => problem%base%n, m => problem%vectors, now => continuation)
         kept = size(now%kept)/(m + 1)
         rows = n + kept*gauss_nodes*size(now%step_length)
         allocate (columns(rows + 2*n + kept*size(now%coefficients, 1)*size(now%step_length), m))
         do j = 1, m
            columns(:, j) = [now%y(j*n + 1:(j + 1)*n), &
                             measured(problem%base, now, j*kept, kept), &
                             now%y(j*n + 1:(j + 1)*n), now%slope(j*n + 1:(j + 1)*n), &
                             now%coefficients(:, j*kept + 1:(j + 1)*kept, :)]
         end do
         share = 1.0_wp
         do j = 1, m
            whole = norm2(columns(:rows, j))
            do pass = 1, 2
               do i = 1, j - 1
                  columns(:, j) = columns(:, j) - columns(:, i) &
                                  *dot_product(columns(:rows, i), columns(:rows, j))
               end do
            end do
            norm(j) = norm2(columns(:rows, j))
            share = min(share, norm(j)/max(whole, tiny(1.0_wp)))
            columns(:, j) = columns(:, j)/max(norm(j), tiny(1.0_wp))
         end do
         columns = size_after*columns
         do j = 1, m
            now%y(j*n + 1:(j + 1)*n) = columns(rows + 1:rows + n, j)
            now%slope(j*n + 1:(j + 1)*n) = columns(rows + n + 1:rows + 2*n, j)
            now%coefficients(:, j*kept + 1:(j + 1)*kept, :) = &
               reshape(columns(rows + 2*n + 1:, j), &
                       [size(now%coefficients, 1), kept, size(now%step_length)])
         end do
         deallocate (now%rate)
         allocate (now%rate(0))
      end associate
   end subroutine orthonormalise

   !> The past of a vector at Gauss's nodes, times the roots of their weights: its part of an inner
   !> product is then a plain sum.
   pure function measured(base, continuation, first, kept) result(values)
      !> The undisturbed problem
      class(dde_problem_type), intent(in) :: base
      !> Where the run stands
      type(continuation_type), intent(in) :: continuation
      !> Kept components before the vector's
      integer, intent(in) :: first
      !> Number of its kept components
      integer, intent(in) :: kept
      real(wp) :: values(gauss_nodes, kept, size(continuation%step_length))
      real(wp) :: begins, delay, ends, reached, s(gauss_nodes), value(gauss_nodes)
      integer :: i, j, k

      do k = 1, size(continuation%step_length)
         associate (length => continuation%step_length(k), nodes => continuation%nodes(:, k))
            begins = before(continuation, k)
            ends = begins + length
            do i = 1, kept
               delay = longest_delay(base, continuation%kept(i))
               reached = max(0.0_wp, min(length, ends + delay))
               s = 1.0_wp - reached/length*(0.5_wp - half_node)
               associate (a => continuation%coefficients(:, first + i, k))
                  value = a(size(a))
                  do j = size(nodes), 1, -1
                     value = a(j) + (s - nodes(j))*value
                  end do
               end associate
               values(:, i, k) = sqrt(weight*reached/delay)*value
            end do
         end associate
      end do
   end function measured
end module tangent_vectors
