!> Whether a block approaches steady sliding, and the exponents there: the real parts of the roots
!> of (5).
module steady_sliding
   use block_roots, only: roots_of_block
   use dde_errors, only: error_type
   use exponent_averages, only: exponent_type
   use dde_kinds, only: wp
   use root_counts, only: roots_right_of
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: settles, sliding_exponents

   !> A block approaches steady sliding if, in the second half of the observation, |ln v| is at most
   !> `small`, or at most `near` and at most `shrunk` times its maximum in the first half.
   real(wp), parameter :: small = 1.0e-3_wp, near = 0.2_wp, shrunk = 0.8_wp
   !> First bound above which roots of (5) are sought, and the last.
   real(wp), parameter :: first_bound = -1.0_wp/64.0_wp, last_bound = -8.0_wp

contains

   !> Whether ln v stays close to 0 or decays towards it; steady sliding is the attractor if it is
   !> stable, too.
   pure logical function settles(w) result(value)
      !> Samples of ln v
      real(wp), intent(in) :: w(:)

      associate (half => size(w)/2)
         associate (first => maxval(abs(w(:half))), second => maxval(abs(w(half + 1:))))
            value = second <= small .or. (second <= near .and. second <= shrunk*first)
         end associate
      end associate
   end function settles

   !> The real parts of the rightmost roots of (5); fewer where there are no more to be found.
   subroutine sliding_exponents(block_model, count, exponents, error)
      !> The block
      type(spring_block_type), intent(in) :: block_model
      !> How many
      integer, intent(in) :: count
      !> Exponents, descending, without error
      type(exponent_type), allocatable, intent(out) :: exponents(:)
      !> The roots cannot be found
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: roots(:)
      real(wp) :: bound
      integer :: i

      associate (p => block_model%parameters)
         bound = first_bound
         do while (bound > last_bound .and. roots_right_of(p, bound) < count)
            bound = 2.0_wp*bound
         end do
         call roots_of_block(p, bound, roots, error)
      end associate
      if (allocated(error)) return
      exponents = [(exponent_type(value=real(roots(i))), i=1, min(count, size(roots)))]
   end subroutine sliding_exponents
end module steady_sliding
