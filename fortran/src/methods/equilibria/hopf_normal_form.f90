! SPDX-License-Identifier: BSD-3-Clause
!> The normal form of a Hopf bifurcation of a delayed model.
module hopf_normal_form
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use lapack_algebra, only: null_vectors, solve
   use linear_system, only: linear_part, linear_system_type
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: critical_vectors, first_lyapunov_coefficient

contains

   !> First Lyapunov coefficient l1 of the pair i omega, with Delta(i omega) q = 0, |q| = 1,
   !> p^T Delta(i omega) = 0, p^T Delta'(i omega) q = 1 and phi(t) = q exp(i omega t):
   !>
   !>     h20 = Delta(2 i omega)^-1 B(phi, phi),  h11 = Delta(0)^-1 B(phi, conj phi),
   !>     c1  = 1/2 p^T [B(conj phi, h20) + 2 B(phi, h11) + C(phi, phi, conj phi)],
   !>     l1  = Re(c1)/omega.
   !>
   !> If negative, the bifurcation is supercritical; if positive, subcritical.
   subroutine first_lyapunov_coefficient(model, omega, l1, error)
      !> The model, which keeps delays of 0 and has a pair of simple roots +-i omega at rest
      class(model_type), intent(in) :: model
      !> Frequency of the pair, > 0
      real(wp), intent(in) :: omega
      !> The coefficient
      real(wp), intent(out) :: l1
      !> 0 or 2 i omega is a root, too
      type(error_type), allocatable, intent(out) :: error
      complex(wp), dimension(model%n) :: p, q
      complex(wp), dimension(model%n, 1 + size(model%lag)) :: phi, history_11, history_20
      complex(wp) :: s
      type(linear_system_type) :: linear

      l1 = 0.0_wp
      s = cmplx(0.0_wp, omega, kind=wp)
      linear = linear_part(model)
      call critical_vectors(linear, s, q, p, error)
      if (allocated(error)) return
      phi = linear%history(reshape(q, [size(q), 1]), s)
      call find_response(linear, 2.0_wp*s, second(phi, phi), history_20, error)
      if (allocated(error)) return
      call find_response(linear, (0.0_wp, 0.0_wp), second(phi, conjg(phi)), history_11, error)
      if (allocated(error)) return
      l1 = real(0.5_wp*sum(p*(second(conjg(phi), history_20) + 2.0_wp*second(phi, history_11) &
                              + model%derivative(reshape([phi, phi, conjg(phi)], &
                                                         [shape(phi), 3])))))/omega

   contains

      !> B(x, y).
      pure function second(x, y) result(form)
         complex(wp), intent(in) :: x(:, :), y(:, :)
         complex(wp) :: form(size(x, 1))

         form = model%derivative(reshape([x, y], [shape(x), 2]))
      end function second
   end subroutine first_lyapunov_coefficient

   !> The vectors of a simple root: Delta(s) q = 0, |q| = 1, p^T Delta(s) = 0, p^T Delta'(s) q = 1.
   subroutine critical_vectors(linear, s, q, p, error)
      !> The linear system
      type(linear_system_type), intent(in) :: linear
      !> The root
      complex(wp), intent(in) :: s
      !> Right vector, shape (n); left vector, shape (n)
      complex(wp), intent(out) :: q(:), p(:)
      !> No convergence
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: row_size(size(q))

      ! rows of one size: otherwise the rounding errors of a large row are those of all
      row_size = abs(s) + maxval(sum(abs(linear%a), dim=3), dim=2)
      call null_vectors(linear%characteristic_matrix(s)/spread(row_size, 2, size(q)), q, p, error)
      if (allocated(error)) return
      p = p/row_size
      p = p/sum(p*matmul(linear%characteristic_slope(s), q))
   end subroutine critical_vectors

   !> The answer of the linear system to a forcing exp(s t), as history.
   subroutine find_response(linear, s, forcing, history, error)
      type(linear_system_type), intent(in) :: linear
      complex(wp), intent(in) :: s
      !> Amplitude of the forcing, shape (n)
      complex(wp), intent(in) :: forcing(:)
      complex(wp), intent(out) :: history(:, :)
      type(error_type), allocatable, intent(out) :: error
      complex(wp) :: answer(size(forcing), 1)

      call solve(linear%characteristic_matrix(s), reshape(forcing, shape(answer)), answer, error)
      history = linear%history(answer, s)
   end subroutine find_response
end module hopf_normal_form
