! SPDX-License-Identifier: BSD-3-Clause
!> Characteristic roots of a linear delay system: Chebyshev collocation of the infinitesimal
!> generator (Breda, Maset and Vermiglio 2005), each eigenvalue refined by Newton's method on
!> det Delta(s). The number of nodes grows until the expected number of roots is found.
module characteristic_roots
   use dde, only: stop_requested
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use lapack_algebra, only: eigenvalues, solve
   use linear_system, only: linear_system_type
   implicit none (type, external)
   private
   public :: find_roots, most_roots

   !> Intervals between the nodes of the first try and of the last.
   integer, parameter :: first_intervals = 16, most_intervals = 512
   !> No more roots than these are found.
   integer, parameter :: most_roots = most_intervals
   !> Roots nearer than this, relative to 1 + |s|, are the same.
   real(wp), parameter :: same_root = 1.0e-8_wp
   !> Farthest way from an eigenvalue to its root, relative to 1 + |s|.
   real(wp), parameter :: longest_way = 0.1_wp
   !> Most iterations of Newton's method, and the step after which it ends, relative to 1 + |s|;
   !> it also ends where steps below `same_root` do not become smaller.
   integer, parameter :: most_iterations = 30
   real(wp), parameter :: last_step = 1.0e-14_wp
   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   !> All simple roots with real part above `bound`, the rightmost first; of a pair, the one above
   !> the real axis first.
   subroutine find_roots(system, bound, expected, rate, roots, error)
      !> The system
      type(linear_system_type), intent(in) :: system
      !> Least real part
      real(wp), intent(in) :: bound
      !> Number of roots by the principle of the argument
      integer, intent(in) :: expected
      !> The unit of frequency, a power of 2
      real(wp), intent(in) :: rate
      !> The roots
      complex(wp), allocatable, intent(out) :: roots(:)
      !> Another number is found
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: approximate(:)
      type(linear_system_type) :: scaled
      integer :: intervals

      scaled = linear_system_type(system%a/rate, system%lag*rate)
      intervals = first_intervals
      ! with one delayed component, fewer intervals do not resolve all roots
      do while (intervals < expected)
         intervals = 2*intervals
      end do
      allocate (roots(0))
      do while (intervals <= most_intervals)
         call approximate_roots(scaled, intervals, approximate, error)
         if (stop_requested /= 0) call raise(error, "roots: interrupted")
         if (allocated(error)) return
         roots = rate*refine_roots(scaled, bound/rate, approximate)
         if (size(roots) == expected) return
         intervals = 2*intervals
      end do
      call raise(error, "find_roots: "//text(size(roots))//" simple roots instead of " &
                 //text(expected)//" with real part above "//text(bound)//" are found with " &
                 //text(most_intervals)//" intervals and lag "//text(maxval(system%lag)) &
                 //"; a bound nearer to 0 expected")
   end subroutine find_roots

   !> The eigenvalues s of the scaled generator, M s x = G x.
   subroutine approximate_roots(system, intervals, approximate, error)
      type(linear_system_type), intent(in) :: system
      integer, intent(in) :: intervals
      complex(wp), allocatable, intent(out) :: approximate(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: divisor(:), matrix(:, :)
      real(wp) :: unit

      ! the unit of time is the longest lag
      unit = maxval(system%lag)
      if (unit > 0.0_wp) then
         matrix = generator(system, intervals, unit)
      else
         unit = 1.0_wp
         matrix = sum(system%a, dim=3)
      end if
      ! a row of large entries (a fast component) gets a small mass; otherwise its size would be
      ! that of the rounding errors of all roots
      divisor = max(1.0_wp, maxval(abs(matrix), dim=2))
      call eigenvalues(matrix/spread(divisor, 2, size(divisor)), 1.0_wp/divisor, approximate, error)
      approximate = approximate/unit
   end subroutine approximate_roots

   !> The generator on Chebyshev nodes from 0 back to the longest lag: the system itself at 0,
   !> differentiation of the history elsewhere. Only delayed components have a history.
   pure function generator(system, intervals, unit) result(matrix)
      type(linear_system_type), intent(in) :: system
      integer, intent(in) :: intervals
      real(wp), intent(in) :: unit
      real(wp), allocatable :: matrix(:, :)
      real(wp) :: row(0:intervals), weight(0:intervals), x(0:intervals)
      integer, allocatable :: delayed(:), place(:, :)
      integer :: i, j, k, n

      n = size(system%a, 1)
      delayed = delayed_components(system)
      ! column j of `place` holds the components at node j
      allocate (place(size(delayed), 0:intervals))
      place(:, 0) = delayed
      place(:, 1:) = reshape([(n + i, i=1, size(delayed)*intervals)], [size(delayed), intervals])
      allocate (matrix(n + size(delayed)*intervals, n + size(delayed)*intervals))
      matrix = 0.0_wp
      x = [(0.5_wp*(cos(pi*i/intervals) - 1.0_wp), i=0, intervals)]
      weight = [(1.0_wp - 2.0_wp*modulo(i, 2), i=0, intervals)]
      weight([0, intervals]) = 0.5_wp*weight([0, intervals])
      do k = 1, size(system%lag)
         if (system%lag(k) > 0.0_wp) then
            row = interpolation(x, weight, -system%lag(k)/unit)
            do j = 0, intervals
               matrix(:n, place(:, j)) = matrix(:n, place(:, j)) &
                                         + row(j)*unit*system%a(:, delayed, k)
            end do
         else
            matrix(:n, :n) = matrix(:n, :n) + unit*system%a(:, :, k)
         end if
      end do
      do i = 1, intervals
         row = 0.0_wp
         do j = 0, intervals
            if (j /= i) row(j) = weight(j)/(weight(i)*(x(i) - x(j)))
         end do
         row(i) = -sum(row)
         do j = 0, intervals
            do k = 1, size(delayed)
               matrix(place(k, i), place(k, j)) = row(j)
            end do
         end do
      end do
   end function generator

   !> Components with a delayed value in the system.
   pure function delayed_components(system) result(components)
      type(linear_system_type), intent(in) :: system
      integer, allocatable :: components(:)
      integer :: i, k

      components = pack([(i, i=1, size(system%a, 2))], &
                        [(any([(system%lag(k) > 0.0_wp .and. any(abs(system%a(:, i, k)) > 0.0_wp), &
                                k=1, size(system%lag))]), i=1, size(system%a, 2))])
   end function delayed_components

   !> Coefficients by which values at the nodes give the value between them.
   pure function interpolation(x, weight, at) result(row)
      real(wp), intent(in) :: x(:), weight(:), at
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
   function refine_roots(system, bound, approximate) result(roots)
      type(linear_system_type), intent(in) :: system
      real(wp), intent(in) :: bound
      complex(wp), intent(in) :: approximate(:)
      complex(wp), allocatable :: roots(:)
      complex(wp) :: s
      logical :: found
      integer :: after, i

      allocate (roots(0))
      do i = 1, size(approximate)
         if (real(approximate(i)) < bound - longest_way .or. aimag(approximate(i)) < 0.0_wp) cycle
         call follow_newton(system, approximate(i), s, found)
         if (.not. found .or. real(s) - bound <= last_step*(1.0_wp + abs(s))) cycle
         if (any(abs(s - roots) <= same_root*(1.0_wp + abs(s)))) cycle
         after = count(real(roots) >= real(s))
         roots = [roots(:after), s, roots(after + 1:)]
      end do
      ! those above the real axis with their partners
      roots = pack([(roots(i), conjg(roots(i)), i=1, size(roots))], &
                   [(.true., aimag(roots(i)) > 0.0_wp, i=1, size(roots))])
   end function refine_roots

   !> Newton's method on det Delta(s), whose logarithm has the derivative trace(Delta^-1 Delta').
   subroutine follow_newton(system, start, s, found)
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
      real(wp) :: before
      integer :: i, j

      s = start
      found = .false.
      before = huge(before)
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
         associate (share => abs(step)/(1.0_wp + abs(s)))
            found = share <= last_step .or. (share <= same_root .and. abs(step) > 0.5_wp*before)
         end associate
         if (found) exit
         before = abs(step)
      end do
      if (abs(aimag(s)) <= same_root*(1.0_wp + abs(s))) s = real(s)
      s = cmplx(real(s), abs(aimag(s)), kind=wp)
   end subroutine follow_newton
end module characteristic_roots
