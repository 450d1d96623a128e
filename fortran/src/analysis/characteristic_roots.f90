!> Characteristic roots of a linear delay system: Chebyshev collocation of the infinitesimal
!> generator (Breda, Maset and Vermiglio 2005), each eigenvalue refined by Newton's method on
!> det Delta(s), with so many nodes that twice as many change nothing.
module characteristic_roots
   use delay_equation, only: linear_system_type
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use lapack, only: eigenvalues, solve
   implicit none (type, external)
   private
   public :: find_roots

   !> Intervals between the nodes of the first try and of the last.
   integer, parameter :: first_intervals = 16, most_intervals = 256
   !> Roots nearer than this, relative to 1 + |s|, are the same.
   real(wp), parameter :: same_root = 1.0e-8_wp
   !> Farthest way from an eigenvalue to its root, relative to 1 + |s|.
   real(wp), parameter :: longest_way = 0.1_wp
   !> Most iterations of Newton's method, and the step after which it ends, relative to 1 + |s|.
   integer, parameter :: most_iterations = 30
   real(wp), parameter :: last_step = 1.0e-14_wp
   !> Half a turn.
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   !> All simple roots with real part above `bound`, the rightmost first; of a pair, the one above
   !> the real axis first.
   subroutine find_roots(system, bound, roots, error)
      !> The system
      type(linear_system_type), intent(in) :: system
      !> Least real part
      real(wp), intent(in) :: bound
      !> The roots
      complex(wp), allocatable, intent(out) :: roots(:)
      !> Not the same with twice as many nodes
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: approximate(:), before(:)
      integer :: intervals

      if (maxval(system%lag) <= 0.0_wp) then
         call eigenvalues(sum(system%a, dim=3), approximate, error)
         if (.not. allocated(error)) roots = refined(system, bound, approximate)
         return
      end if
      intervals = first_intervals
      do while (intervals <= most_intervals)
         call eigenvalues(generator(system, intervals), approximate, error)
         if (allocated(error)) return
         roots = refined(system, bound, approximate)
         if (allocated(before)) then
            if (size(before) == size(roots)) then
               if (all(abs(roots - before) <= same_root*(1.0_wp + abs(roots)))) return
            end if
         end if
         call move_alloc(roots, before)
         intervals = 2*intervals
      end do
      call raise(error, "find_roots: roots with real part above "//text(bound) &
                 //" are not settled with "//text(most_intervals)//" intervals and lag " &
                 //text(maxval(system%lag))//"; a bound nearer to 0 expected")
   end subroutine find_roots

   !> The generator on Chebyshev nodes from 0 back to the longest lag: the system itself at 0,
   !> differentiation of the history elsewhere.
   pure function generator(system, intervals) result(matrix)
      !> The system
      type(linear_system_type), intent(in) :: system
      !> Intervals between the nodes
      integer, intent(in) :: intervals
      real(wp), allocatable :: matrix(:, :)
      real(wp) :: row(0:intervals), weight(0:intervals), x(0:intervals)
      integer :: i, j, k, n

      n = size(system%a, 1)
      allocate (matrix(n*(intervals + 1), n*(intervals + 1)))
      matrix = 0.0_wp
      associate (longest => maxval(system%lag))
         x = [(0.5_wp*longest*(cos(pi*i/intervals) - 1.0_wp), i=0, intervals)]
      end associate
      weight = [(1.0_wp - 2.0_wp*modulo(i, 2), i=0, intervals)]
      weight([0, intervals]) = 0.5_wp*weight([0, intervals])
      do k = 1, size(system%lag)
         row = interpolation(x, weight, -system%lag(k))
         do j = 0, intervals
            associate (block => matrix(:n, j*n + 1:(j + 1)*n))
               block = block + row(j)*system%a(:, :, k)
            end associate
         end do
      end do
      do i = 1, intervals
         row = 0.0_wp
         do j = 0, intervals
            if (j /= i) row(j) = weight(j)/(weight(i)*(x(i) - x(j)))
         end do
         row(i) = -sum(row)
         do j = 0, intervals
            do k = 1, n
               matrix(i*n + k, j*n + k) = row(j)
            end do
         end do
      end do
   end function generator

   !> Coefficients by which values at the nodes give the value between them.
   pure function interpolation(x, weight, at) result(row)
      !> Nodes
      real(wp), intent(in) :: x(:)
      !> Their barycentric weights
      real(wp), intent(in) :: weight(:)
      !> Where
      real(wp), intent(in) :: at
      real(wp) :: row(size(x))
      integer :: nearest

      nearest = minloc(abs(x - at), dim=1)
      if (abs(x(nearest) - at) <= epsilon(1.0_wp)*maxval(abs(x))) then
         row = 0.0_wp
         row(nearest) = 1.0_wp
      else
         row = weight/(at - x)
         row = row/sum(row)
      end if
   end function interpolation

   !> The roots that approximate ones lead to, each once.
   function refined(system, bound, approximate) result(roots)
      !> The system
      type(linear_system_type), intent(in) :: system
      !> Least real part
      real(wp), intent(in) :: bound
      !> Approximations
      complex(wp), intent(in) :: approximate(:)
      complex(wp), allocatable :: roots(:)
      complex(wp) :: s
      logical :: found
      integer :: after, i

      allocate (roots(0))
      do i = 1, size(approximate)
         if (real(approximate(i)) < bound - longest_way .or. aimag(approximate(i)) < 0.0_wp) cycle
         call follow_newton(system, approximate(i), s, found)
         if (.not. found .or. real(s) <= bound) cycle
         if (any(abs(s - roots) <= same_root*(1.0_wp + abs(s)))) cycle
         after = count(real(roots) >= real(s))
         roots = [roots(:after), s, roots(after + 1:)]
      end do
      roots = [(with_partner(roots(i)), i=1, size(roots))]
   end function refined

   !> A root above the real axis and its conjugate, or a real root alone.
   pure function with_partner(s) result(both)
      !> The root
      complex(wp), intent(in) :: s
      complex(wp), allocatable :: both(:)

      if (aimag(s) > 0.0_wp) then
         both = [s, conjg(s)]
      else
         both = [s]
      end if
   end function with_partner

   !> Newton's method on det Delta(s), whose logarithm has the derivative trace(Delta^-1 Delta').
   subroutine follow_newton(system, start, s, found)
      !> The system
      type(linear_system_type), intent(in) :: system
      !> Where to start, on or above the real axis
      complex(wp), intent(in) :: start
      !> The root, on or above the real axis
      complex(wp), intent(out) :: s
      !> Whether there is one near the start
      logical, intent(out) :: found
      complex(wp), dimension(size(system%a, 1), size(system%a, 1)) :: ratio
      complex(wp) :: step, trace
      type(error_type), allocatable :: singular
      integer :: i, j

      s = start
      found = .false.
      do i = 1, most_iterations
         call solve(system%characteristic_matrix(s), system%characteristic_slope(s), ratio, &
                    singular)
         found = allocated(singular)
         if (found) exit
         trace = sum([(ratio(j, j), j=1, size(ratio, 1))])
         if (.not. abs(trace) > tiny(1.0_wp)) exit
         step = -1.0_wp/trace
         s = s + step
         if (abs(s - start) > longest_way*(1.0_wp + abs(start))) exit
         found = abs(step) <= last_step*(1.0_wp + abs(s))
         if (found) exit
      end do
      if (abs(aimag(s)) <= same_root*(1.0_wp + abs(s))) s = real(s)
      s = cmplx(real(s), abs(aimag(s)), kind=wp)
   end subroutine follow_newton
end module characteristic_roots
