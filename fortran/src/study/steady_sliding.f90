!> Whether a block approaches steady sliding, and the exponents there: the real parts of the roots
!> of (5).
module steady_sliding
   use block_parameters, only: block_parameters_type
   use chain, only: mode_eigenvalue
   use characteristic_function, only: characteristic_type
   use block_roots, only: roots_of_block
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type
   use exponent_averages, only: exponent_type
   use dde_kinds, only: wp
   use root_counts, only: roots_right_of
   use spring_block, only: block_characteristic, components_of_block, index_of_ln_v, &
                           spring_block_type
   implicit none (type, external)
   private
   public :: comes_to_rest, settles, sliding_exponents

   !> A block approaches steady sliding if, in the second half of the observation, |ln v| is at most
   !> `small`, or at most `near` and at most `shrunk` times its maximum in the first half.
   real(wp), parameter :: small = 1.0e-3_wp, near = 0.2_wp, shrunk = 0.8_wp
   !> First bound above which roots of (5) are sought, and the last.
   real(wp), parameter :: first_bound = -1.0_wp/64.0_wp, last_bound = -8.0_wp
   !> Halvings of the interval between a bound with too few roots and one with many.
   integer, parameter :: most_halvings = 20
   !> Samples of a motion that may come to rest: of all blocks, and at least of each.
   integer, parameter :: samples_of_rest = 10000, least_samples = 500

contains

   !> Whether the blocks of their own histories come to rest: ln v settles between two times, and
   !> steady sliding is stable to all modes of the chain.
   subroutine comes_to_rest(block_model, t_begin, t_end, options, rest, error)
      !> The blocks and their histories
      type(spring_block_type), intent(in) :: block_model
      !> Time from which it is looked at, and time up to which
      real(wp), intent(in) :: t_begin, t_end
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Whether they come to rest
      logical, intent(out) :: rest
      !> The run ended before its time, or the roots of (5) cannot be found
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      integer :: first, i, last, mode

      rest = .false.
      last = max(least_samples, samples_of_rest/block_model%parameters%blocks)
      samples = table_sampler([(i, i=index_of_ln_v, block_model%n, components_of_block)], &
                              [(t_begin + (t_end - t_begin)*i/last, i=1, last - 1)])
      call integrate(block_model, 0.0_wp, t_end, options, outcome, error, sampler=samples)
      if (allocated(error)) return
      if (.not. settles(maxval(abs(samples%values), dim=1))) return
      associate (p => block_model%parameters)
         first = merge(1, 0, p%ends == "plate")
         do mode = first, first + p%blocks - 1
            call sliding_exponents(block_of_mode(p, mode), 1, exponents, error)
            if (allocated(error)) return
            if (any(exponents%value >= 0.0_wp)) return
         end do
      end associate
      rest = .true.
   end subroutine comes_to_rest

   !> The block whose linear equations are those of a mode of a chain; a block alone has mode 0.
   pure type(block_parameters_type) function block_of_mode(p, mode) result(one)
      !> Parameters of the chain
      type(block_parameters_type), intent(in) :: p
      !> Number of the mode: from 0, with plates at the ends from 1
      integer, intent(in) :: mode
      real(wp) :: s

      s = 1.0_wp + p%kappa*mode_eigenvalue(mode, p%blocks, p%ends)
      one = p
      one%xi = s*p%xi
      one%gamma = sqrt(s)*p%gamma
      one%blocks = 1
      one%kappa = 0.0_wp
      one%ends = "free"
   end function block_of_mode

   !> Whether ln v stays close to 0 or decays towards it; steady sliding is the attractor if it is
   !> stable, too.
   pure logical function settles(w) result(value)
      !> Samples of ln v
      real(wp), intent(in) :: w(:)

      ! one sample shows no approach
      value = size(w) > 1
      if (.not. value) return
      associate (half => size(w)/2)
         associate (first => maxval(abs(w(:half))), second => maxval(abs(w(half + 1:))))
            value = second <= small .or. (second <= near .and. second <= shrunk*first)
         end associate
      end associate
   end function settles

   !> The real parts of the rightmost roots of (5); fewer where there are no more to be found.
   subroutine sliding_exponents(p, count, exponents, error)
      !> Parameters of the block
      type(block_parameters_type), intent(in) :: p
      !> How many
      integer, intent(in) :: count
      !> Exponents, descending, without error
      type(exponent_type), allocatable, intent(out) :: exponents(:)
      !> The roots cannot be found
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: roots(:)
      integer :: i

      call roots_of_block(p, bound_for(p, count), roots, error)
      if (allocated(error)) return
      exponents = [(exponent_type(value=real(roots(i))), i=1, min(count, size(roots)))]
   end subroutine sliding_exponents

   !> A bound with at least this number of roots of (5) above it, not many more; or the last bound.
   real(wp) function bound_for(p, count) result(bound)
      type(block_parameters_type), intent(in) :: p
      integer, intent(in) :: count
      type(characteristic_type) :: c
      real(wp) :: nearer
      integer :: i, number, there

      c = block_characteristic(p)
      bound = first_bound
      nearer = bound
      number = roots_right_of(c, bound)
      do while (number < count .and. bound > last_bound)
         nearer = bound
         bound = 2.0_wp*bound
         number = roots_right_of(c, bound)
      end do
      do i = 1, most_halvings
         if (number <= 2*count .or. nearer <= bound) exit
         associate (middle => 0.5_wp*(nearer + bound))
            there = roots_right_of(c, middle)
            if (there < count) then
               nearer = middle
            else
               bound = middle
               number = there
            end if
         end associate
      end do
   end function bound_for
end module steady_sliding
