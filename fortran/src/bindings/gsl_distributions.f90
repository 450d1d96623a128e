!> Quantiles of distributions by GSL.
module gsl_distributions
   use, intrinsic :: iso_c_binding, only: c_double
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: student_quantile

   interface
      pure real(c_double) function tdist_qinv(share, freedom) result(value) &
         bind(c, name="gsl_cdf_tdist_Qinv")
         import :: c_double
         implicit none (type, external)
         real(c_double), value :: share, freedom
      end function tdist_qinv
   end interface

contains

   !> The value that a variable of Student's distribution exceeds with a probability.
   pure real(wp) function student_quantile(probability, freedom) result(value)
      !> The probability, between 0 and 1
      real(wp), intent(in) :: probability
      !> Degrees of freedom, at least 1
      integer, intent(in) :: freedom

      value = tdist_qinv(probability, real(freedom, c_double))
   end function student_quantile
end module gsl_distributions
