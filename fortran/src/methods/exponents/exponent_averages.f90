! SPDX-License-Identifier: BSD-3-Clause
!> From the growth of tangent vectors, interval by interval, to exponents with error bars and the
!> dimension of the attractor.
module exponent_averages
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_kinds, only: wp
   use student_distribution, only: student_quantile
   implicit none (type, external)
   private
   public :: average_growth, dimension_of, error_bars, exponent_type, running_averages, &
             sign_of, without_sign
   public :: zero, positive, unclear

   !> Signs of an exponent; `unclear` is neither zero nor more than its error bars from it.
   enum, bind(c)
      enumerator :: negative = -1, zero, positive, unclear
   end enum

   !> An exponent this many error bars from zero, or closer, has no sign.
   real(wp), parameter :: error_bars = 3.0_wp

   !> Share of a normal distribution above this number of standard errors.
   real(wp), parameter :: beyond_bars = 0.5_wp*erfc(error_bars/sqrt(2.0_wp))
   !> Length of each smooth end, as a share of the time.
   real(wp), parameter :: ends = 0.25_wp
   !> Number of the lowest frequencies that the error is estimated by.
   integer, parameter :: lowest = 8

   !> An exponent; per unit of time.
   type :: exponent_type
      !> Value of the exponent
      real(wp) :: value = 0.0_wp
      !> Standard error
      real(wp) :: error = 0.0_wp
      !> Value of each batch
      real(wp), allocatable :: batches(:)
   end type exponent_type

contains

   !> Exponents in descending order. Their values are weighted means of the growth, the weights
   !> level but for smooth ends: on a cycle or torus the error falls faster than any power of time
   !> once the ends are longer than the periods (Das, Saiki, Sander and Yorke 2017, Nonlinearity 30,
   !> 4111), and in chaos it is hardly larger than that of the plain mean.
   !>
   !> The variance of such a mean is the spectral density of the growth at frequency 0, filtered by
   !> the weights (Heidelberger and Welch 1981, Communications of the ACM 24, 233). It is estimated
   !> by the lowest frequencies above 0: slow variations make it large, fast ones do not count.
   !> Student's distribution enlarges the error, so that three of it cover as much as three standard
   !> errors that are known.
   pure function average_growth(growth, length, batches, flow) result(exponents)
      !> Logarithm of the growth of each vector in each interval, shape (vectors, intervals)
      real(wp), intent(in) :: growth(:, :)
      !> Length of each interval, shape (intervals)
      real(wp), intent(in) :: length(:)
      !> Number of batches, a divisor of the number of intervals
      integer, intent(in) :: batches
      !> Whether the exponent of the flow, which is 0, is to be added
      logical, intent(in) :: flow
      type(exponent_type), allocatable :: exponents(:)
      type(exponent_type) :: moving
      real(wp) :: of_batch(size(length)/batches, batches), weight(size(length))
      integer :: batch, first(batches), i, j, last(batches)

      last = [(batch*size(of_batch, 1), batch=1, batches)]
      first = last - size(of_batch, 1) + 1
      do batch = 1, batches
         of_batch(:, batch) = weights_over(length(first(batch):last(batch)))
      end do
      weight = weights_over(length)
      allocate (exponents(size(growth, 1) + merge(1, 0, flow)))
      do j = 1, size(exponents)
         moving = exponent_type(batches=[(0.0_wp, batch=1, batches)])
         if (j <= size(growth, 1)) then
            moving%value = sum(weight*growth(j, :))
            moving%error = error_of_mean(weight, length, growth(j, :) - moving%value*length)
            moving%batches = [(sum(of_batch(:, batch)*growth(j, first(batch):last(batch))), &
                               batch=1, batches)]
         end if
         i = j - 1
         do while (i >= 1)
            if (exponents(i)%value >= moving%value) exit
            exponents(i + 1) = exponents(i)
            i = i - 1
         end do
         exponents(i + 1) = moving
      end do
   end function average_growth

   !> Weights of intervals: level but for ends that rise like exp(-1/x), sum(weights*length) = 1.
   pure function weights_over(length) result(weights)
      real(wp), intent(in) :: length(:)
      real(wp) :: weights(size(length))
      integer :: i

      weights = middles(length)
      do i = 1, size(length)
         associate (x => min(weights(i), 1.0_wp - weights(i))/ends)
            weights(i) = 1.0_wp
            if (x < 1.0_wp) then
               weights(i) = 0.5_wp*(1.0_wp - tanh(0.5_wp*(1.0_wp/x - 1.0_wp/(1.0_wp - x))))
            end if
         end associate
      end do
      weights = weights/sum(weights*length)
   end function weights_over

   !> The middle of each interval, as a share of the time.
   pure function middles(length) result(x)
      real(wp), intent(in) :: length(:)
      real(wp) :: passed, x(size(length))
      integer :: i

      passed = 0.0_wp
      do i = 1, size(length)
         x(i) = passed + 0.5_wp*length(i)
         passed = passed + length(i)
      end do
      x = x/passed
   end function middles

   !> Standard error of the weighted mean of a signal: the root mean square of its weighted Fourier
   !> sums at the lowest frequencies.
   pure real(wp) function error_of_mean(weight, length, deviation) result(error)
      real(wp), intent(in) :: weight(:), length(:), deviation(:)
      real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
      real(wp) :: squares, x(size(length))
      integer :: k

      x = middles(length)
      squares = 0.0_wp
      do k = 1, lowest
         associate (phase => turn*k*x)
            squares = squares + sum(weight*deviation*cos(phase))**2 &
                      + sum(weight*deviation*sin(phase))**2
         end associate
      end do
      error = sqrt(squares/lowest)*student_quantile(beyond_bars, 2.0_wp*lowest)/error_bars
   end function error_of_mean

   !> Plain averages of the growth from the beginning on, at evenly spaced times.
   pure subroutine running_averages(growth, length, most_times, time, averages)
      !> Logarithm of the growth of each vector in each interval, shape (vectors, intervals)
      real(wp), intent(in) :: growth(:, :)
      !> Length of each interval, shape (intervals)
      real(wp), intent(in) :: length(:)
      !> Most times
      integer, intent(in) :: most_times
      !> Times since the beginning; averages up to each, shape (vectors, times)
      real(wp), allocatable, intent(out) :: time(:), averages(:, :)
      real(wp) :: total(size(growth, 1))
      integer :: every, i

      every = (size(growth, 2) + most_times - 1)/most_times
      allocate (time(size(growth, 2)/every), averages(size(growth, 1), size(growth, 2)/every))
      total = 0.0_wp
      do i = 1, size(time)
         total = total + sum(growth(:, (i - 1)*every + 1:i*every), dim=2)
         time(i) = sum(length(:i*every))
         averages(:, i) = total/time(i)
      end do
   end subroutine running_averages

   !> Whether an exponent is zero within its error: zero or of an unclear sign.
   elemental logical function without_sign(exponent, zero_level) result(value)
      !> The exponent
      type(exponent_type), intent(in) :: exponent
      !> Absolute value up to which an exponent is zero, whatever the error bar
      real(wp), intent(in) :: zero_level

      value = abs(exponent%value) <= max(zero_level, error_bars*exponent%error)
   end function without_sign

   !> The sign of an exponent, on which its class, all counts and all tables rest.
   elemental integer function sign_of(exponent, zero_level, longest_bar) result(found)
      !> The exponent
      type(exponent_type), intent(in) :: exponent
      !> Greatest absolute value of a zero exponent
      real(wp), intent(in) :: zero_level
      !> Longest error bar (of three standard errors) of a zero exponent
      real(wp), intent(in) :: longest_bar

      found = merge(positive, negative, exponent%value > 0.0_wp)
      if (.not. without_sign(exponent, zero_level)) return
      found = merge(zero, unclear, abs(exponent%value) <= zero_level &
                    .and. error_bars*exponent%error <= longest_bar)
   end function sign_of

   !> Dimension of Kaplan and Yorke, k + (lambda_1 + ... + lambda_k)/|lambda_(k+1)|, k the most
   !> exponents whose sum is not negative; those without sign count as 0. Not a number where more
   !> exponents would be needed. The error follows from leaving out one batch at a time.
   pure subroutine dimension_of(exponents, zero_level, dimension, error)
      !> Exponents, descending
      type(exponent_type), intent(in) :: exponents(:)
      !> Absolute value up to which an exponent is zero
      real(wp), intent(in) :: zero_level
      !> The dimension, standard error of the dimension
      real(wp), intent(out) :: dimension, error
      real(wp) :: others(size(exponents(1)%batches)), values(size(exponents))
      logical :: zero(size(exponents))
      integer :: batch, j

      zero = without_sign(exponents, zero_level)
      dimension = kaplan_yorke(merge(0.0_wp, exponents%value, zero))
      associate (batches => size(others))
         do batch = 1, batches
            do j = 1, size(exponents)
               values(j) = (batches*exponents(j)%value - exponents(j)%batches(batch))/(batches - 1)
            end do
            others(batch) = kaplan_yorke(merge(0.0_wp, values, zero))
         end do
         error = sqrt((batches - 1.0_wp)/batches*sum((others - sum(others)/batches)**2))
      end associate
   end subroutine dimension_of

   !> The dimension that belongs to these exponents.
   pure real(wp) function kaplan_yorke(values) result(dimension)
      real(wp), intent(in) :: values(:)
      real(wp) :: total
      integer :: k

      total = 0.0_wp
      do k = 1, size(values)
         if (total + values(k) < 0.0_wp) then
            dimension = k - 1 + total/abs(values(k))
            return
         end if
         total = total + values(k)
      end do
      dimension = ieee_value(1.0_wp, ieee_quiet_nan)
   end function kaplan_yorke
end module exponent_averages
