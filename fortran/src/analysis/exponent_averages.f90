!> From the growth of tangent vectors, interval by interval, to exponents with error bars and the
!> dimension of the attractor.
module exponent_averages
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: average_growth, dimension_of, error_bars, exponent_type, running_averages, &
             sign_bound, without_sign

   !> An exponent this many error bars from zero, or closer, has no sign.
   real(wp), parameter :: error_bars = 3.0_wp

   !> An exponent; per unit of time.
   type :: exponent_type
      !> Its value
      real(wp) :: value = 0.0_wp
      !> Standard error from the spread of blocks
      real(wp) :: error = 0.0_wp
      !> Value of each block
      real(wp), allocatable :: blocks(:)
   end type exponent_type

contains

   !> Exponents in descending order. The value of a block is a mean weighted by the smooth bump
   !> exp(-1/(x (1 - x))), x running through the block from 0 to 1, whose error falls faster than
   !> any power of time where the motion is periodic or quasiperiodic (Das, Saiki, Sander and Yorke
   !> 2017, Nonlinearity 30, 4111); the exponent is the plain mean of its blocks.
   pure function average_growth(growth, interval, blocks) result(exponents)
      !> Logarithm of the growth of each vector in each interval, shape (vectors, intervals)
      real(wp), intent(in) :: growth(:, :)
      !> Length of an interval
      real(wp), intent(in) :: interval
      !> Number of blocks, at least 2, a divisor of the number of intervals
      integer, intent(in) :: blocks
      type(exponent_type), allocatable :: exponents(:)
      type(exponent_type) :: moving
      real(wp) :: bump(size(growth, 2)/blocks)
      integer :: block, i, j, length

      length = size(bump)
      do i = 1, length
         associate (x => (i - 0.5_wp)/length)
            bump(i) = exp(-1.0_wp/(x*(1.0_wp - x)))
         end associate
      end do
      bump = bump/(interval*sum(bump))
      allocate (exponents(size(growth, 1)))
      do j = 1, size(exponents)
         moving%blocks = [(sum(bump*growth(j, (block - 1)*length + 1:block*length)), &
                           block=1, blocks)]
         moving%value = sum(moving%blocks)/blocks
         moving%error = sqrt(sum((moving%blocks - moving%value)**2)/(blocks*(blocks - 1.0_wp)))
         i = j - 1
         do while (i >= 1)
            if (exponents(i)%value >= moving%value) exit
            exponents(i + 1) = exponents(i)
            i = i - 1
         end do
         exponents(i + 1) = moving
      end do
   end function average_growth

   !> Plain averages of the growth from the beginning on, at evenly spaced times.
   pure subroutine running_averages(growth, interval, most_times, time, averages)
      !> Logarithm of the growth of each vector in each interval, shape (vectors, intervals)
      real(wp), intent(in) :: growth(:, :)
      !> Length of an interval
      real(wp), intent(in) :: interval
      !> Most times
      integer, intent(in) :: most_times
      !> Times since the beginning
      real(wp), allocatable, intent(out) :: time(:)
      !> Averages up to each, shape (vectors, times)
      real(wp), allocatable, intent(out) :: averages(:, :)
      real(wp) :: total(size(growth, 1))
      integer :: every, i

      every = (size(growth, 2) + most_times - 1)/most_times
      allocate (time(size(growth, 2)/every), averages(size(growth, 1), size(growth, 2)/every))
      total = 0.0_wp
      do i = 1, size(time)
         total = total + sum(growth(:, (i - 1)*every + 1:i*every), dim=2)
         time(i) = i*every*interval
         averages(:, i) = total/time(i)
      end do
   end subroutine running_averages

   !> Whether an exponent is zero within its error.
   elemental logical function without_sign(exponent, zero_level) result(value)
      !> The exponent
      type(exponent_type), intent(in) :: exponent
      !> What is as good as zero, whatever the error bar
      real(wp), intent(in) :: zero_level

      value = abs(exponent%value) <= sign_bound(exponent, zero_level)
   end function without_sign

   !> Absolute value up to which an exponent has no sign.
   elemental real(wp) function sign_bound(exponent, zero_level) result(value)
      !> The exponent
      type(exponent_type), intent(in) :: exponent
      !> What is as good as zero, whatever the error bar
      real(wp), intent(in) :: zero_level

      value = max(zero_level, error_bars*exponent%error)
   end function sign_bound

   !> Dimension of Kaplan and Yorke, k + (lambda_1 + ... + lambda_k)/|lambda_(k+1)|, k the most
   !> exponents whose sum is not negative; those without sign count as 0. Not a number where more
   !> exponents would be needed. Its error: from leaving out one block at a time.
   pure subroutine dimension_of(exponents, zero_level, dimension, error)
      !> Exponents, descending
      type(exponent_type), intent(in) :: exponents(:)
      !> What is as good as zero
      real(wp), intent(in) :: zero_level
      !> The dimension
      real(wp), intent(out) :: dimension
      !> Its standard error
      real(wp), intent(out) :: error
      real(wp) :: others(size(exponents(1)%blocks)), values(size(exponents))
      logical :: zero(size(exponents))
      integer :: block, j

      zero = without_sign(exponents, zero_level)
      dimension = kaplan_yorke(merge(0.0_wp, exponents%value, zero))
      associate (blocks => size(others))
         do block = 1, blocks
            do j = 1, size(exponents)
               values(j) = (blocks*exponents(j)%value - exponents(j)%blocks(block))/(blocks - 1)
            end do
            others(block) = kaplan_yorke(merge(0.0_wp, values, zero))
         end do
         error = sqrt((blocks - 1.0_wp)/blocks*sum((others - sum(others)/blocks)**2))
      end associate
   end subroutine dimension_of

   !> The dimension that belongs to these exponents.
   pure real(wp) function kaplan_yorke(values) result(dimension)
      !> Exponents, descending
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
