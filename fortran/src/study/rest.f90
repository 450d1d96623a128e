! SPDX-License-Identifier: BSD-3-Clause
!> Whether a motion comes to rest, and the exponents there: the real parts of the characteristic
!> roots.
module rest
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use exponent_averages, only: exponent_type
   use model_levels, only: rest_level
   use model_problem, only: model_type
   use model_roots, only: find_rightmost
   implicit none (type, external)
   private
   public :: exponents_at_rest, faster, judge_flow, settles, trend_of

   !> A motion approaches rest if, in the second half of the observation, the component of the
   !> signal differs from its value at rest by at most `small`, or by at most `near` and at most
   !> `shrunk` times the largest difference in the first half.
   real(wp), parameter :: small = 1.0e-3_wp, near = 0.2_wp, shrunk = 0.8_wp
   !> Samples of a motion that may come to rest: of all blocks, and at least of each.
   integer, parameter :: samples_of_rest = 10000, least_samples = 500
   !> Parts of the time in which a motion becomes slower or faster; the least logarithm of the
   !> change, and the least slope in units of its standard error; changes within so many tolerances
   !> are noise.
   integer, parameter :: parts = 10
   real(wp), parameter :: least_change = 0.05_wp, clear = 10.0_wp, above_noise = 100.0_wp
   enum, bind(c)
      enumerator :: slower = -1, steady, faster
   end enum
   !> A history with slopes below this share of its states is at rest.
   real(wp), parameter :: rounding = 100.0_wp*epsilon(1.0_wp)

contains

   !> Whether small disturbances along the flow neither decay nor grow: not where a motion from the
   !> model's own past comes to rest, at the state of the definition or at another, or grows.
   subroutine judge_flow(model, t_begin, t_end, options, neutral, error)
      !> The model and its past
      class(model_type), intent(in) :: model
      !> Time from which it is looked at, and time up to which
      real(wp), intent(in) :: t_begin, t_end
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Whether the exponent of the flow is 0
      logical, intent(out) :: neutral
      !> The run began at rest, which rounding may leave, or ended before its time
      type(error_type), allocatable, intent(out) :: error
      type(integration_result) :: outcome
      type(table_sampler) :: samples
      real(wp) :: slope(model%n)
      integer :: i, last

      neutral = .false.
      if (model%sizes%driven) return
      call model%rhs(0.0_wp, model%past, model%past(model%component), slope)
      if (all(abs(slope)*options%unit_of_time <= rounding*abs(model%past))) then
         call raise(error, "exponents: the history is a state at rest, of which they are the " &
                    //"real parts of roots; expected another history")
         return
      end if
      last = max(least_samples, samples_of_rest/model%shape%blocks)
      ! of a chain the signal of each block
      samples = table_sampler([(i, i=merge(1, model%sizes%observed%component, &
                                           model%shape%blocks == 1), model%n, &
                                merge(1, model%states(), model%shape%blocks == 1))], &
                              [(t_begin + (t_end - t_begin)*i/last, i=1, last - 1)])
      call integrate(model, 0.0_wp, t_end, options, outcome, error, sampler=samples)
      if (allocated(error)) return
      neutral = trend_of(samples%values, options) == steady
   end subroutine judge_flow

   !> Whether changes from sample to sample decay or end below the tolerance, whether they grow, or
   !> neither: a line through the logarithms of the largest ones in parts of the time falls or rises
   !> by far more than these scatter. It may fall on the approach to a cycle, too.
   pure integer function trend_of(values, options) result(trend)
      !> Samples, shape (components, samples)
      real(wp), intent(in) :: values(:, :)
      !> Their tolerances
      type(integration_options), intent(in) :: options
      real(wp) :: change(parts), fastest(parts), line(parts), noise, slope, x(parts)
      integer :: first, i, part

      fastest = -huge(1.0_wp)
      do i = 1, size(values, 1)
         noise = options%relative*maxval(abs(values(i, :)))
         if (.not. allocated(options%each_absolute)) noise = noise + options%absolute
         do part = 1, parts
            first = 1 + (part - 1)*(size(values, 2) - 1)/parts
            associate (here => values(i, first:1 + part*(size(values, 2) - 1)/parts))
               change(part) = log(max(tiny(1.0_wp), maxval(abs(here(2:) - here(:size(here) - 1)))))
            end associate
         end do
         if (change(parts) <= log(max(tiny(1.0_wp), above_noise*noise))) cycle
         fastest = max(fastest, change - maxval(change))
      end do
      trend = merge(slower, steady, all(fastest <= -huge(1.0_wp)))
      if (trend == slower) return
      x = [(part - 0.5_wp*(parts + 1), part=1, parts)]
      slope = dot_product(x, fastest)/dot_product(x, x)
      line = sum(fastest)/parts + slope*x
      if ((parts - 1)*abs(slope) > least_change .and. &
          abs(slope)*norm2(x) > clear*norm2(fastest - line)/sqrt(real(parts - 2, wp))) then
         trend = merge(faster, slower, slope > 0.0_wp)
      end if
   end function trend_of

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
