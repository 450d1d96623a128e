! SPDX-License-Identifier: GPL-3.0-or-later
!> Fourier transforms of real numbers by FFTW.
module fftw_transform
   use, intrinsic :: iso_c_binding
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: transform_by_fftw
   include 'fftw3.f03'

contains

   !> Sums of x(j) exp(-2 pi i j k/n) over j = 0..n - 1, for k = 0..n/2.
   subroutine transform_by_fftw(x, sums)
      !> Numbers, shape (n)
      real(wp), intent(in) :: x(:)
      !> The sums, shape (n/2 + 1)
      complex(wp), intent(out) :: sums(:)
      real(c_double) :: numbers(size(x))
      type(c_ptr) :: plan

      ! only the execution of plans is safe among threads
      !$omp critical (fftw_planning)
      plan = fftw_plan_dft_r2c_1d(size(x), numbers, sums, fftw_estimate)
      !$omp end critical (fftw_planning)
      numbers = x
      call fftw_execute_dft_r2c(plan, numbers, sums)
      !$omp critical (fftw_planning)
      call fftw_destroy_plan(plan)
      !$omp end critical (fftw_planning)
   end subroutine transform_by_fftw
end module fftw_transform
