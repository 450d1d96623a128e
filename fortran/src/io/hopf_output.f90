!> Files of Hopf curves.
module hopf_output
   use errors, only: error_type
   use hopf_curves, only: curve_point
   use hopf_input, only: hopf_settings
   use netcdf_output, only: output_file
   implicit none (type, external)
   private
   public :: write_curves

contains

   !> Write all points of all curves, piece by piece.
   subroutine write_curves(path, settings, points, error)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> The plane
      type(hopf_settings), intent(in) :: settings
      !> Points
      type(curve_point), intent(in) :: points(:)
      !> It could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file) :: file
      integer :: branch, crossing, epsilon, omega, piece, printed_residual, printed_tau, residual
      integer :: rows, tau, xi

      call file%create(path, "Hopf curves: where a pair of characteristic roots is imaginary")
      rows = file%dimension("point", size(points))
      epsilon = file%real_variable("epsilon", rows, "sensitivity of the velocity relaxation", "1")
      tau = file%real_variable("tau", rows, "delay", "1")
      xi = file%real_variable("xi", rows, "spring constant", "1")
      omega = file%real_variable("omega", rows, "angular frequency of the pair", "1")
      branch = file%integer_variable("branch", rows, "branch k of equation (10)")
      piece = file%integer_variable("piece", rows, "number of the unbroken piece of curve")
      residual = file%real_variable("residual", rows, "residual of (5) over its largest term", "1")
      crossing = file%integer_variable("crossing", rows, "sign of d Re(lambda)/d tau")
      printed_tau = file%real_variable("printed_tau", rows, "delay by (10) as printed", "1")
      printed_residual = file%real_variable("printed_residual", rows, &
                                            "residual of (5) there over its largest term", "1")
      call file%attribute("ordinate", trim(settings%ordinate))
      call file%attribute("gamma", settings%gamma)
      call file%attribute(trim(merge("xi ", "tau", settings%ordinate == "tau")), settings%fixed)
      call file%put(epsilon, points%parameters%epsilon)
      call file%put(tau, points%parameters%tau)
      call file%put(xi, points%parameters%xi)
      call file%put(omega, points%omega)
      call file%put(branch, points%branch)
      call file%put(piece, points%piece)
      call file%put(residual, points%residual)
      call file%put(crossing, points%crossing)
      call file%put(printed_tau, points%printed_tau)
      call file%put(printed_residual, points%printed_residual)
      call file%finish(error)
   end subroutine write_curves
end module hopf_output
