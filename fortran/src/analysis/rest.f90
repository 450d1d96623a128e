!> A block that comes to rest, to steady sliding: its exponents are the roots of (5).
module rest
   use block_roots, only: roots_of_block
   use characteristic_function, only: block_parameters
   use dde_errors, only: error_type
   use exponent_averages, only: exponent_type
   use dde_kinds, only: wp
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: comes_to_rest, exponents_at_rest

   !> A block comes to rest when ln v stays within the first of these in the second half of its
   !> observation, or within the second and within this share of what it was in the first half.
   real(wp), parameter :: at_rest = 1.0e-3_wp, near_rest = 0.2_wp, shrunk = 0.8_wp
   !> First bound above which roots of (5) are sought, and the last.
   real(wp), parameter :: first_bound = -1.0_wp/64.0_wp, last_bound = -8.0_wp

contains

   !> Whether ln v stays close to 0 or closes in; it rests there if steady sliding is stable.
   pure logical function comes_to_rest(w) result(value)
      !> Samples of ln v
      real(wp), intent(in) :: w(:)

      associate (half => size(w)/2)
         associate (first => maxval(abs(w(:half))), second => maxval(abs(w(half + 1:))))
            value = second <= at_rest .or. (second <= near_rest .and. second <= shrunk*first)
         end associate
      end associate
   end function comes_to_rest

   !> The real parts of the rightmost roots of (5); fewer where there are no more to be found.
   subroutine exponents_at_rest(block_model, count, exponents, error)
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

      bound = first_bound
      do
         associate (b => block_model)
            call roots_of_block(block_parameters(sum(b%lag), b%epsilon, b%xi, b%gamma), bound, &
                                roots, error)
         end associate
         if (allocated(error)) return
         if (size(roots) >= count .or. bound <= last_bound) exit
         bound = 2.0_wp*bound
      end do
      exponents = [(exponent_type(value=real(roots(i))), i=1, min(count, size(roots)))]
   end subroutine exponents_at_rest
end module rest
