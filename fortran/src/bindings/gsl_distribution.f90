! SPDX-License-Identifier: GPL-3.0-or-later
!> Quantiles of distributions by GSL.
module gsl_distribution
   use, intrinsic :: iso_c_binding, only: c_double
   implicit none (type, external)
   private
   public :: quantile_by_gsl

   interface
      !> The value that a variable of Student's distribution exceeds with a probability.
      pure real(c_double) function quantile_by_gsl(probability, freedom) result(value) &
         bind(c, name="gsl_cdf_tdist_Qinv")
         import :: c_double
         implicit none (type, external)
         real(c_double), value :: probability, freedom
      end function quantile_by_gsl
   end interface
end module gsl_distribution
