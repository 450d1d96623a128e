!> FFTW's own Fortran interface as a module.
module fftw
   use, intrinsic :: iso_c_binding
   implicit none (type, external)
   public
   include 'fftw3.f03'
end module fftw
