!> The characteristic function of the steady state (0, 0, 1), equation (5) of the paper, as
!>
!>     Delta(s) = s^3 + s^2 (1 + gamma^2/xi) + s gamma^2 (1 + 1/xi) + gamma^2
!>                - s (1 + epsilon) (gamma^2/xi) exp(-s tau).
!>
!> All quantities are nondimensional.
module characteristic_function
   use block_parameters, only: block_parameters_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: by_epsilon, by_tau, by_xi, delta, delta_by, delta_by_s, relative_residual, root_by, &
             slope_bound, terms

   !> Parameters of derivatives.
   enum, bind(c)
      enumerator :: by_epsilon, by_tau, by_xi
   end enum

contains

   !> The five terms of Delta(s).
   pure function terms(p, s) result(term)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Point of the complex plane
      complex(wp), intent(in) :: s
      complex(wp) :: term(5)

      term = [s**3, s**2*(1.0_wp + p%gamma**2/p%xi), s*p%gamma**2*(1.0_wp + 1.0_wp/p%xi), &
              cmplx(p%gamma**2, kind=wp), delayed_term(p, s)]
   end function terms

   !> The delayed term -s (1 + epsilon) (gamma^2/xi) exp(-s tau).
   pure complex(wp) function delayed_term(p, s) result(value)
      type(block_parameters_type), intent(in) :: p
      complex(wp), intent(in) :: s

      value = -s*(1.0_wp + p%epsilon)*(p%gamma**2/p%xi)*exp(-s*p%tau)
   end function delayed_term

   !> Delta(s).
   pure complex(wp) function delta(p, s) result(value)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Point of the complex plane
      complex(wp), intent(in) :: s

      value = sum(terms(p, s))
   end function delta

   !> Derivative of Delta by s.
   pure complex(wp) function delta_by_s(p, s) result(value)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Point of the complex plane
      complex(wp), intent(in) :: s

      value = 3.0_wp*s**2 + 2.0_wp*s*(1.0_wp + p%gamma**2/p%xi) &
              + p%gamma**2*(1.0_wp + 1.0_wp/p%xi) &
              - (1.0_wp - s*p%tau)*(1.0_wp + p%epsilon)*(p%gamma**2/p%xi)*exp(-s*p%tau)
   end function delta_by_s

   !> Sum of the sizes of the terms of the derivative of Delta by s.
   pure real(wp) function slope_bound(p, s) result(value)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Point of the complex plane
      complex(wp), intent(in) :: s

      value = 3.0_wp*abs(s)**2 + 2.0_wp*abs(s)*(1.0_wp + p%gamma**2/p%xi) &
              + p%gamma**2*(1.0_wp + 1.0_wp/p%xi) &
              + (1.0_wp + abs(s)*p%tau)*(1.0_wp + p%epsilon)*(p%gamma**2/p%xi) &
              *exp(-real(s)*p%tau)
   end function slope_bound

   !> Derivative of Delta by a parameter.
   pure complex(wp) function delta_by(parameter, p, s) result(value)
      !> by_epsilon, by_tau or by_xi
      integer, intent(in) :: parameter
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Point of the complex plane
      complex(wp), intent(in) :: s

      select case (parameter)
      case (by_epsilon)
         value = -s*p%gamma**2/p%xi*exp(-s*p%tau)
      case (by_tau)
         value = -s*delayed_term(p, s)
      case default
         value = -(p%gamma/p%xi)**2*s*(s + 1.0_wp - (1.0_wp + p%epsilon)*exp(-s*p%tau))
      end select
   end function delta_by

   !> Derivative of a root by a parameter.
   pure complex(wp) function root_by(parameter, p, s) result(value)
      !> by_epsilon, by_tau or by_xi
      integer, intent(in) :: parameter
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> The root
      complex(wp), intent(in) :: s

      value = -delta_by(parameter, p, s)/delta_by_s(p, s)
   end function root_by

   !> |Delta(s)| over its largest term: how well s is a characteristic root.
   pure real(wp) function relative_residual(p, s) result(value)
      !> Parameters
      type(block_parameters_type), intent(in) :: p
      !> Point of the complex plane
      complex(wp), intent(in) :: s

      value = abs(delta(p, s))/maxval(abs(terms(p, s)))
   end function relative_residual
end module characteristic_function
