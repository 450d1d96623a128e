!> Lyapunov exponents of one block over a long run that is cut into pieces (exponents.py). Standard
!> input: tau, epsilon, xi, gamma, theta, u, w of the constant past; tolerance, transient, time
!> measured, interval; number of exponents, number of lists of pieces, and how many pieces each list
!> has. Prints the time measured; then pieces in the list, piece, exponent, its value and standard
!> error. The exponent of the flow is left out.
program exponents_worker
   use block_parameters, only: block_history_type, block_parameters_type
   use dde, only: continuation_type, integrate, integration_options, integration_result
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use exponent_averages, only: average_growth, exponent_type
   use lyapunov_spectrum, only: extend_growth, growth_settings_type, growth_type, measure_growth
   use spring_block, only: spring_block_type
   implicit none (type, external)
   !> Most lists of pieces.
   integer, parameter :: most_lists = 16
   character(len=1024) :: message
   integer :: i, lists, pieces(most_lists), status
   real(wp) :: scene(7), t_measured, t_transient
   type(continuation_type) :: undisturbed
   type(error_type), allocatable :: error
   type(growth_settings_type) :: settings
   type(growth_type) :: measured
   type(integration_options) :: options
   type(integration_result) :: outcome
   type(spring_block_type) :: block_model

   read (*, *, iostat=status, iomsg=message) scene, options%relative, t_transient, t_measured, &
      settings%interval, settings%exponents, lists, pieces(:lists)
   if (status /= 0) error stop "exponents_worker: "//trim(message)
   options%absolute = options%relative
   block_model = spring_block_type( &
                 block_parameters_type(tau=scene(1), epsilon=scene(2), xi=scene(3), &
                                       gamma=scene(4)), &
                 block_history_type(theta=scene(5), u=scene(6), v=exp(scene(7))))
   call integrate(block_model, 0.0_wp, t_transient, options, outcome, error, &
                  continuation=undisturbed)
   if (allocated(error)) error stop "exponents_worker: "//error%message
   settings%across_flow = .true.
   ! the vectors turn for a tenth of the time
   settings%blocks = 2
   settings%t_turning = 0.1_wp*t_measured
   settings%t_end = t_transient + settings%t_turning + 0.5_wp*t_measured
   call measure_growth(block_model, settings, options, measured, error, undisturbed)
   if (allocated(error)) error stop "exponents_worker: "//error%message
   call extend_growth(block_model, settings, options, measured, error)
   if (allocated(error)) error stop "exponents_worker: "//error%message
   print "(es12.5)", sum(measured%length)
   do i = 1, lists
      call print_pieces(pieces(i))
   end do

contains

   !> The exponents of each piece.
   subroutine print_pieces(count)
      integer, intent(in) :: count
      type(exponent_type), allocatable :: exponents(:)
      integer :: j, k, long

      long = size(measured%length)/count
      do k = 1, count
         associate (first => (k - 1)*long + 1, last => k*long)
            exponents = average_growth(measured%growth(:, first:last), &
                                       measured%length(first:last), 1, flow=.false.)
         end associate
         do j = 1, size(exponents)
            print "(3(i0, 1x), 2es24.16)", count, k, j, exponents(j)%value, exponents(j)%error
         end do
      end do
   end subroutine print_pieces
end program exponents_worker
