! SPDX-License-Identifier: BSD-3-Clause
!> Fourier transforms of real numbers without a library: powers of two by halves, other lengths as a
!> convolution of such (Bluestein 1970, IEEE Transactions on Audio and Electroacoustics 18, 451). A
!> program that has a faster one sets `transform_real`.
module fourier_transform
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: transform_real

   real(wp), parameter :: pi = acos(-1.0_wp)

   abstract interface
      !> Sums of x(j) exp(-2 pi i j k/n) over j = 0..n - 1, for k = 0..n/2.
      subroutine transform_numbers(x, sums)
         import :: wp
         implicit none (type, external)
         real(wp), intent(in) :: x(:)
         complex(wp), intent(out) :: sums(:)
      end subroutine transform_numbers
   end interface

   procedure(transform_numbers), pointer :: transform_real => transform_by_halves

contains

   !> Sums of x(j) exp(-2 pi i j k/n) over j = 0..n - 1, for k = 0..n/2.
   subroutine transform_by_halves(x, sums)
      !> Numbers, shape (n)
      real(wp), intent(in) :: x(:)
      !> The sums, shape (n/2 + 1)
      complex(wp), intent(out) :: sums(:)
      complex(wp), allocatable :: chirp(:), left(:), right(:)
      integer :: k, length, n

      n = size(x)
      if (iand(n, n - 1) == 0) then
         left = transform(cmplx(x, kind=wp))
         sums = left(:size(sums))
         return
      end if
      ! j k = (j^2 + k^2 - (k - j)^2)/2; squares modulo 2 n keep all digits of the angle
      allocate (chirp(0:n - 1))
      do k = 0, n - 1
         associate (square => real(modulo(int(k, int64)**2, 2_int64*n), wp))
            chirp(k) = cmplx(cos(pi*square/n), -sin(pi*square/n), kind=wp)
         end associate
      end do
      length = 1
      do while (length < 2*n - 1)
         length = 2*length
      end do
      allocate (left(0:length - 1), right(0:length - 1), source=(0.0_wp, 0.0_wp))
      left(:n - 1) = x*chirp
      right(:n - 1) = conjg(chirp)
      right(length - n + 1:) = conjg(chirp(n - 1:1:-1))
      left = transform(left)*transform(right)
      left = conjg(transform(conjg(left)))/length
      sums = left(:size(sums) - 1)*chirp(:size(sums) - 1)
   end subroutine transform_by_halves

   !> The same of complex numbers, as many as a power of two.
   pure recursive function transform(x) result(sums)
      complex(wp), intent(in) :: x(:)
      complex(wp), allocatable :: sums(:)
      complex(wp), allocatable :: even(:), odd(:)
      integer :: half, k

      half = size(x)/2
      if (half == 0) then
         sums = x
         return
      end if
      even = transform(x(1::2))
      odd = transform(x(2::2))
      odd = [(cmplx(cos(pi*k/half), -sin(pi*k/half), kind=wp)*odd(k + 1), k=0, half - 1)]
      sums = [even + odd, even - odd]
   end function transform
end module fourier_transform
