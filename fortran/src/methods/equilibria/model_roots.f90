! SPDX-License-Identifier: BSD-3-Clause
!> Characteristic roots of a model at rest: counted, and found, in two independent ways.
module model_roots
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use characteristic_function, only: characteristic_of, characteristic_type
   use characteristic_roots, only: find_roots, most_roots
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use linear_system, only: linear_part
   use model_description, only: description_type
   use model_modes, only: mode_of
   use model_problem, only: model_type
   use root_counts, only: has_more_roots, no_count, roots_right_of, slowest_rate
   implicit none (type, external)
   private
   public :: check_rest, count_roots, find_model_roots, find_rightmost

   !> First bound above which rightmost roots are sought, in units of the slowest rate, and how
   !> often it is doubled: roots without delay are up to 2**34 times as fast.
   real(wp), parameter :: first_bound = -1.0_wp/64.0_wp
   integer, parameter :: most_doublings = 40
   !> Halvings of the interval between a bound with too few roots and one with many.
   integer, parameter :: most_halvings = 20

contains

   !> Refuse parameters at which a model has no state at rest, or no finite linear part or a
   !> delay below 0 there.
   subroutine check_rest(model, error)
      !> The model, of a chain a block
      class(model_type), intent(in) :: model
      !> None is found
      type(error_type), allocatable, intent(out) :: error
      type(description_type) :: about
      character(len=:), allocatable :: words
      integer :: i

      if (ieee_is_finite(slowest_rate(characteristic_of(model)))) return
      about = model%describe()
      words = ""
      do i = 1, size(model%numbers)
         words = words//", "//trim(model%names(i))//" = "//text(model%numbers(i))
      end do
      call raise(error, "no state at rest "//trim(about%rest)//words//"; expected one with " &
                 //"finite derivatives and delays >= 0: other parameters or a nearer guess")
   end subroutine check_rest

   !> Number of roots with real part above `bound`, of all modes of a chain, or `no_count`.
   integer function count_roots(model, bound) result(number)
      !> The model
      class(model_type), intent(in) :: model
      !> Real part of a line on which no root lies
      real(wp), intent(in) :: bound
      integer :: i, of_mode

      number = 0
      do i = 1, model%shape%blocks
         of_mode = roots_right_of(characteristic_of(mode_of(model, i)), bound)
         number = merge(no_count, number + of_mode, min(number, of_mode) < 0)
      end do
   end function count_roots

   !> All roots with real part above `bound`, the rightmost first.
   subroutine find_model_roots(model, bound, roots, error)
      !> The model
      class(model_type), intent(in) :: model
      !> Least real part
      real(wp), intent(in) :: bound
      !> The roots
      complex(wp), allocatable, intent(out) :: roots(:)
      !> Too many, or not as many found as the principle of the argument says
      type(error_type), allocatable, intent(out) :: error
      type(characteristic_type) :: c
      type(model_type) :: block
      complex(wp), allocatable :: of_mode(:)
      integer :: expected, i, j, k

      allocate (roots(0))
      do i = 1, model%shape%blocks
         block = mode_of(model, i)
         call check_rest(block, error)
         if (allocated(error)) return
         c = characteristic_of(block)
         expected = no_count
         if (.not. has_more_roots(c, bound, most_roots)) expected = roots_right_of(c, bound)
         if (expected < 0 .or. expected > most_roots) then
            call raise(error, "roots: more than "//text(most_roots)//" above "//text(bound) &
                       //"; a bound nearer to 0 expected")
            return
         end if
         call find_roots(linear_part(block), bound, expected, slowest_rate(c), of_mode, error)
         if (allocated(error)) return
         do j = 1, size(of_mode)
            k = count(real(roots) >= real(of_mode(j)))
            roots = [roots(:k), of_mode(j), roots(k + 1:)]
         end do
      end do
   end subroutine find_model_roots

   !> The rightmost roots; fewer where there are no more to be found.
   subroutine find_rightmost(model, wanted, roots, error)
      !> The model
      class(model_type), intent(in) :: model
      !> How many
      integer, intent(in) :: wanted
      !> The roots, the rightmost first
      complex(wp), allocatable, intent(out) :: roots(:)
      !> The roots cannot be found
      type(error_type), allocatable, intent(out) :: error

      call find_model_roots(model, bound_for(model, wanted), roots, error)
      if (.not. allocated(error)) roots = roots(:min(wanted, size(roots)))
   end subroutine find_rightmost

   !> A bound with at least this number of roots above it, not many more; or the last bound.
   real(wp) function bound_for(model, wanted) result(bound)
      class(model_type), intent(in) :: model
      integer, intent(in) :: wanted
      real(wp) :: nearer
      integer :: i, number, there

      bound = first_bound*slowest_rate(characteristic_of(mode_of(model, 1)))
      nearer = bound
      number = count_roots(model, bound)
      do i = 1, most_doublings
         if (number >= wanted) exit
         there = count_roots(model, 2.0_wp*bound)
         if (there < 0) exit
         nearer = bound
         bound = 2.0_wp*bound
         number = there
      end do
      do i = 1, most_halvings
         if (number <= 2*wanted .or. nearer <= bound) exit
         associate (middle => 0.5_wp*(nearer + bound))
            there = count_roots(model, middle)
            if (there < wanted) then
               nearer = middle
            else
               bound = middle
               number = there
            end if
         end associate
      end do
   end function bound_for
end module model_roots
