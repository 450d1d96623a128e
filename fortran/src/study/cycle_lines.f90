!> Lines of a parameter on which cycles are followed, and the Hopf points on them: where the number
!> of unstable characteristic roots changes by a pair. This holds for every law and parameter.
module cycle_lines
   use block_family, only: along_epsilon, along_gamma, along_tau, along_xi, vector_of, with_vector
   use block_parameters, only: block_parameters_type, law_parameters
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use model_problem, only: model_type
   use root_counts, only: crossing_frequency, roots_right_of
   use spring_block, only: find_model
   implicit none (type, external)
   private
   public :: along_epsilon, along_gamma, along_tau, along_xi, cycle_line_type, find_hopf_starts, &
             hopf_start_type

   !> Places of a line at which unstable roots are counted
   integer, parameter :: scan_places = 4000
   !> An interval with one pair is halved to this length before Newton's method, one with several to
   !> that, in units of the window
   real(wp), parameter :: narrow = 1.0e-7_wp, narrowest = 1.0e-13_wp
   !> Newton's method ends when steps are below this share, or after so many steps
   real(wp), parameter :: accuracy = 1.0e-14_wp
   integer, parameter :: most_steps = 20

   !> A line.
   type :: cycle_line_type
      !> Number of the parameter that varies
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

contains

   !> All Hopf points on a line. Pairs that cross in and out between two places of the scan are
   !> missed.
   subroutine find_hopf_starts(line, starts, error)
      !> The line
      type(cycle_line_type), intent(in) :: line
      !> Hopf points, by the turns that the pair makes in a delay, and by frequency
      type(hopf_start_type), allocatable, intent(out) :: starts(:)
      !> A Hopf point was not found
      type(error_type), allocatable, intent(out) :: error
      type(model_type) :: model
      real(wp) :: here, next
      integer :: i, pairs_here, pairs_next

      allocate (starts(0))
      call find_model(place_on(line, line%window(1)), model)
      here = line%window(1)
      pairs_here = unstable_roots(here)
      do i = 1, scan_places
         next = line%window(1) + (line%window(2) - line%window(1))*i/scan_places
         pairs_next = unstable_roots(next)
         call search(here, next, pairs_here, pairs_next)
         if (allocated(error)) return
         here = next
         pairs_here = pairs_next
      end do

   contains

      !> The characteristic function at a place.
      type(characteristic_type) function function_at(x) result(c)
         real(wp), intent(in) :: x

         call model%set(law_parameters(place_on(line, x), model), model%past)
         c = characteristic_of(model)
      end function function_at

      !> Number of unstable roots at a place.
      integer function unstable_roots(x) result(number)
         real(wp), intent(in) :: x

         number = roots_right_of(function_at(x), 0.0_wp)
      end function unstable_roots

      !> Add the Hopf points of an interval. A change by one is a real root.
      recursive subroutine search(from, to, roots_from, roots_to)
         real(wp), intent(in) :: from, to
         !> Numbers of unstable roots at its ends
         integer, intent(in) :: roots_from, roots_to
         real(wp) :: middle
         integer :: roots_middle

         if (abs(roots_to - roots_from) < 2 .or. allocated(error)) return
         associate (share => (to - from)/(line%window(2) - line%window(1)))
            if (share > merge(narrow, narrowest, abs(roots_to - roots_from) == 2)) then
               middle = 0.5_wp*(from + to)
               roots_middle = unstable_roots(middle)
               call search(from, middle, roots_from, roots_middle)
               call search(middle, to, roots_middle, roots_to)
            else
               call add(from, to)
            end if
         end associate
      end subroutine search

      !> Add the Hopf point between two places by Newton's method for Delta(i omega) = 0.
      subroutine add(from, to)
         real(wp), intent(in) :: from, to
         type(characteristic_type) :: c
         complex(wp) :: by_omega, by_x, delta, s
         real(wp) :: omega, step(2), x
         integer :: i
         logical, allocatable :: earlier(:)

         ! off the ends, at which the pair may be on the axis
         omega = crossing_frequency(function_at(2.0_wp*from - to), function_at(2.0_wp*to - from))
         x = 0.5_wp*(from + to)
         do i = 1, most_steps
            c = function_at(x)
            s = cmplx(0.0_wp, omega, kind=wp)
            delta = c%value(s)
            by_omega = (0.0_wp, 1.0_wp)*c%by_s(s)
            by_x = c%by_parameter(line%along, s)
            step = -[aimag(conjg(by_x)*delta), -aimag(conjg(by_omega)*delta)] &
                   /aimag(conjg(by_x)*by_omega)
            omega = omega + step(1)
            x = x + step(2)
            if (all(abs(step) <= accuracy*abs([omega, x]))) exit
         end do
         if (.not. abs(x - 0.5_wp*(from + to)) <= 2.0_wp*(to - from) + accuracy*abs(x)) then
            call raise(error, "find_hopf_starts: a pair of roots crosses the axis between " &
                       //text(from)//" and "//text(to)//", and Newton's method does not find where")
            return
         end if
         associate (start => hopf_start_type(place_on(line, x), omega))
            earlier = [(is_before(starts(i), start), i=1, size(starts))]
            starts = [pack(starts, earlier), start, pack(starts, .not. earlier)]
         end associate
      end subroutine add
   end subroutine find_hopf_starts

   !> Parameters at a place of a line.
   pure type(block_parameters_type) function place_on(line, x) result(parameters)
      type(cycle_line_type), intent(in) :: line
      real(wp), intent(in) :: x
      real(wp), allocatable :: vector(:)

      vector = vector_of(line%parameters)
      vector(line%along) = x
      parameters = with_vector(line%parameters, vector)
   end function place_on

   !> Whether a Hopf point has fewer turns in a delay, or as many and a lower frequency.
   pure logical function is_before(one, other) result(value)
      type(hopf_start_type), intent(in) :: one, other
      real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)

      associate (k => nint(one%omega*one%parameters%tau/turn), &
                 other_k => nint(other%omega*other%parameters%tau/turn))
         value = k < other_k .or. (k == other_k .and. one%omega < other%omega)
      end associate
   end function is_before
end module cycle_lines
