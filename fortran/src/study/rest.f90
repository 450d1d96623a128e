! SPDX-License-Identifier: BSD-3-Clause
!> Whether a motion comes to rest, and the exponents there: the real parts of the characteristic
!> roots.
module rest
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use exponent_averages, only: exponent_type
   use model_levels, only: rest_level
   use model_problem, only: model_type
   use model_roots, only: count_roots, find_rightmost
   implicit none (type, external)
   private
   public :: comes_to_rest, exponents_at_rest, settles

   !> A motion approaches rest if, in the second half of the observation, the component of the
   !> signal differs from its value at rest by at most `small`, or by at most `near` and at most
   !> `shrunk` times the largest difference in the first half.
   real(wp), parameter :: small = 1.0e-3_wp, near = 0.2_wp, shrunk = 0.8_wp
   !> Samples of a motion that may come to rest: of all blocks, and at least of each.
   integer, parameter :: samples_of_rest = 10000, least_samples = 500

contains

   !> Whether a motion from the model's own past comes to rest: its signal settles between two
   !> times, and rest is stable, for a chain to all of its modes.
   subroutine comes_to_rest(model, t_begin, t_end, options, rest, error)
      !> The model and its past
      class(model_type), intent(in) :: model
      !> Time from which it is looked at, and time up to which
      real(wp), intent(in) :: t_begin, t_end
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Whether it comes to rest
      logical, intent(out) :: rest
      !> The run ended before its time
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      integer :: i, last

      rest = .false.
      last = max(least_samples, samples_of_rest/model%shape%blocks)
      samples = table_sampler([(i, i=model%sizes%observed%component, model%n, model%states())], &
                              [(t_begin + (t_end - t_begin)*i/last, i=1, last - 1)])
      call integrate(model, 0.0_wp, t_end, options, outcome, error, sampler=samples)
      if (allocated(error)) return
      if (.not. settles(maxval(abs(samples%values - rest_level(model)), dim=1), model)) return
      rest = count_roots(model, 0.0_wp) == 0
   end subroutine comes_to_rest

   !> Whether differences from rest stay small or decay; rest is the attractor if it is stable, too.
   pure logical function settles(differences, model) result(value)
      !> Samples of the component of the signal less its value at rest
      real(wp), intent(in) :: differences(:)
      !> The model; its unit is the signal at rest or, if that is larger, in the motion
      class(model_type), intent(in), optional :: model
      real(wp) :: unit

      unit = 1.0_wp
      if (present(model)) then
         if (model%own_units .and. .not. model%sizes%observed%is_exponential) then
            unit = max(abs(rest_level(model)), maxval(abs(differences)))
         end if
      end if
      ! one sample shows no approach
      value = size(differences) > 1
      if (.not. value) return
      associate (half => size(differences)/2)
         associate (first => maxval(abs(differences(:half))), &
                    second => maxval(abs(differences(half + 1:))))
            value = second <= small*unit .or. (second <= near*unit .and. second <= shrunk*first)
         end associate
      end associate
   end function settles

   !> The real parts of the rightmost roots; fewer where there are no more to be found.
   subroutine exponents_at_rest(model, wanted, exponents, error)
      class(model_type), intent(in) :: model
      !> How many
      integer, intent(in) :: wanted
      !> Exponents, descending, without error
      type(exponent_type), allocatable, intent(out) :: exponents(:)
      !> The roots cannot be found
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable :: roots(:)
      integer :: i

      call find_rightmost(model, wanted, roots, error)
      if (allocated(error)) return
      exponents = [(exponent_type(value=real(roots(i))), i=1, size(roots))]
   end subroutine exponents_at_rest
end module rest
