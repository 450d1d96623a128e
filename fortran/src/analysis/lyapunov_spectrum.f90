!> The leading Lyapunov exponents of a delayed problem: tangent vectors are integrated beside the
!> solution by the same solver, interval by interval, and made orthonormal in the space of histories
!> in between (Benettin et al. 1980, Meccanica 15, 9; Farmer 1982, Physica D 4, 366).
module lyapunov_spectrum
   use dde, only: continuation_type, dde_problem_type, integrate, integration_options, &
                  integration_result
   use errors, only: error_type, raise, text
   use kinds, only: int64, wp
   use progress_receivers, only: progress_receiver
   use tangent_problem, only: tangent_problem_type
   use tangent_vectors, only: orthonormalise, start_vectors
   implicit none (type, external)
   private
   public :: growth_settings, growth_type, measure_growth

   !> A part smaller than so many tolerances of the vector it is taken from is noise.
   real(wp), parameter :: noise = 10.0_wp

   !> What growth is measured over.
   type :: growth_settings
      !> Number of exponents
      integer :: exponents = 0
      !> Time at which measuring begins
      real(wp) :: t_begin = 0.0_wp
      !> Time at which it ends
      real(wp) :: t_end = 0.0_wp
      !> Time before the beginning in which the vectors turn to the directions of growth
      real(wp) :: t_turning = 0.0_wp
      !> Longest time between two orthonormalisations
      real(wp) :: interval = 0.0_wp
      !> Number of blocks
      integer :: blocks = 0
      !> Norm of the vectors after orthonormalisation: what of the solver's absolute tolerance they
      !> may claim
      real(wp) :: vector_size = 1.0_wp
   end type growth_settings

   !> What was measured.
   type :: growth_type
      !> Time at which measuring began: t_begin, or later where the delays reach further back
      real(wp) :: t_begin = 0.0_wp
      !> Time between two orthonormalisations
      real(wp) :: interval = 0.0_wp
      !> Logarithm of the growth of each vector in each interval, shape (exponents, intervals)
      real(wp), allocatable :: growth(:, :)
      !> Least share of a vector that was orthogonal to those before it
      real(wp) :: least_share = 1.0_wp
      !> Right-hand sides evaluated, with their variational equations
      integer(int64) :: evaluations = 0
      !> Steps accepted, and how many of them were implicit
      integer(int64) :: steps = 0, implicit_steps = 0
   end type growth_type

contains

   !> Growth of tangent vectors along a solution that begins at t = 0.
   subroutine measure_growth(problem, settings, options, measured, error, progress)
      !> The problem, with derivatives of its own
      class(dde_problem_type), intent(in) :: problem
      !> How many exponents, and when
      type(growth_settings), intent(in) :: settings
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> The growth
      type(growth_type), intent(out) :: measured
      !> It cannot be measured
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of the number of intervals done
      class(progress_receiver), intent(inout), optional :: progress
      type(continuation_type) :: continuation, undisturbed
      type(integration_result) :: outcome
      type(tangent_problem_type) :: tangent
      real(wp), allocatable :: norm(:)
      real(wp) :: start
      integer :: i, intervals, turning

      call check(problem, settings, error)
      if (allocated(error)) return
      start = max(settings%interval, settings%t_begin - settings%t_turning)
      if (size(problem%lag) > 0) start = max(start, maxval(problem%lag))
      measured%t_begin = max(start, settings%t_begin)
      if (.not. measured%t_begin < settings%t_end) then
         call raise(error, "exponents: t_end = "//text(settings%t_end)//"; expected > " &
                    //text(measured%t_begin)//", where the vectors begin")
         return
      end if

      call integrate(problem, 0.0_wp, start, options, outcome, error, continuation=undisturbed)
      if (allocated(error)) return
      tangent = tangent_problem_type(problem, settings%exponents)
      allocate (norm(settings%exponents))
      call start_vectors(tangent, undisturbed, continuation)
      call straighten(error)
      if (allocated(error)) return
      ! no solution of the variational equations yet: a kink
      continuation%rate = [undisturbed%rate, (0.0_wp, i=1, problem%n*settings%exponents)]
      turning = ceiling((measured%t_begin - start)/settings%interval)
      associate (span => settings%t_end - measured%t_begin, blocks => settings%blocks)
         intervals = blocks*max(1, ceiling(span/(blocks*settings%interval)*(1.0_wp - 1.0e-12_wp)))
         measured%interval = span/intervals
         allocate (measured%growth(settings%exponents, intervals))
         do i = 1, turning
            call pass(start + (measured%t_begin - start)*i/turning)
            if (allocated(error)) return
            if (present(progress)) call progress%advance(i, turning + intervals)
         end do
         do i = 1, intervals
            call pass(measured%t_begin + span*i/intervals)
            if (allocated(error)) return
            measured%growth(:, i) = log(norm/settings%vector_size)
            if (present(progress)) call progress%advance(turning + i, turning + intervals)
         end do
      end associate

   contains

      !> One interval, up to `time`.
      subroutine pass(time)
         !> Its end
         real(wp), intent(in) :: time

         call integrate(tangent, continuation%time(1), time, options, outcome, error, &
                        continuation=continuation)
         if (allocated(error)) return
         measured%evaluations = measured%evaluations + outcome%evaluations
         measured%steps = measured%steps + outcome%accepted
         measured%implicit_steps = measured%implicit_steps + outcome%implicit_steps
         call straighten(error)
      end subroutine pass

      !> Orthonormal vectors, unless one has become a combination of the others.
      subroutine straighten(error)
         !> Directions are lost
         type(error_type), allocatable, intent(out) :: error
         real(wp) :: share

         call orthonormalise(tangent, settings%vector_size, continuation, norm, share)
         measured%least_share = min(measured%least_share, share)
         if (share > noise*max(options%relative, epsilon(1.0_wp))) return
         call raise(error, "exponents: at t = "//text(continuation%time(1))//" a share of " &
                    //text(share)//" is left of a vector without those before it; expected > " &
                    //text(noise*options%relative)//" (ask for fewer exponents, shorter " &
                    //"intervals or a smaller tolerance)")
      end subroutine straighten
   end subroutine measure_growth

   !> Refuse what cannot be measured.
   pure subroutine check(problem, settings, error)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> How many exponents, and when
      type(growth_settings), intent(in) :: settings
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error

      if (settings%exponents < 1) then
         call raise(error, "exponents: "//text(settings%exponents)//" asked for; at least 1 " &
                    //"expected")
      else if (size(problem%lag) == 0 .and. settings%exponents > problem%n) then
         call raise(error, "exponents: "//text(settings%exponents)//" asked for of " &
                    //text(problem%n)//" equations without delay; at most as many expected")
      else if (settings%blocks < 2) then
         call raise(error, "exponents: "//text(settings%blocks)//" blocks; at least 2 expected")
      else if (.not. settings%interval > 0.0_wp) then
         call raise(error, "exponents: interval = "//text(settings%interval)//"; > 0 expected")
      end if
   end subroutine check
end module lyapunov_spectrum
