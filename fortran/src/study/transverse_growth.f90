! SPDX-License-Identifier: BSD-3-Clause
!> Whether blocks that move alike stay alike: the master stability function (Pecora and Carroll
!> 1998, Phys. Rev. Lett. 80, 2109). Along the motion of one block, disturbances of a mode of a
!> chain have second differences of -mu times the disturbance, where mu is the eigenvalue of the
!> mode. They are given by s = 1 + kappa mu, s = 1 for the block itself.
module transverse_growth
   use dde, only: integration_options
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use exponent_averages, only: average_growth, exponent_type
   use lyapunov_spectrum, only: growth_settings_type, growth_type, measure_growth
   use model_problem, only: model_type
   use progress_receiver, only: progress_receiver_type
   use sign_change, only: sign_change_type
   implicit none (type, external)
   private
   public :: find_zeros, measure_transverse_growth, of_mode, transverse_growth_type, zero_type

   !> An exponent within so many standard errors of 0 has no sign.
   real(wp), parameter :: most_bars = 3.0_wp
   !> Most exponents that are measured to find a zero.
   integer, parameter :: most_rounds = 20

   !> The largest exponent of disturbances with one s.
   type :: transverse_growth_type
      real(wp) :: s = 0.0_wp
      !> Exponent and its standard error
      real(wp) :: value = 0.0_wp, error = 0.0_wp
   end type transverse_growth_type

   !> Where the exponent is zero.
   type :: zero_type
      !> s and its standard error
      real(wp) :: s = 0.0_wp, error = 0.0_wp
      !> Whether the exponent grows with s
      logical :: rises = .false.
   end type zero_type

contains

   !> The largest exponents along the motion of one block, for each s.
   subroutine measure_transverse_growth(model, s, settings, options, growth, error, progress)
      !> A chain of one block with kappa = 1, and its past
      type(model_type), intent(in) :: model
      !> Stiffness of the modes over that of one block, >= 1
      real(wp), intent(in) :: s(:)
      !> When exponents are measured; of each s one is
      type(growth_settings_type), intent(in) :: settings
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Exponents in the order of s
      type(transverse_growth_type), allocatable, intent(out) :: growth(:)
      !> Error if one cannot be measured
      type(error_type), allocatable, intent(out) :: error
      !> Receiver of the number done
      class(progress_receiver_type), intent(inout), optional :: progress
      integer :: i

      allocate (growth(size(s)))
      do i = 1, size(s)
         call measure_one(model, s(i), settings, options, growth(i), error)
         if (allocated(error)) return
         if (present(progress)) call progress%advance(i, size(s))
      end do
   end subroutine measure_transverse_growth

   !> The block whose disturbances are those of a mode.
   type(model_type) function of_mode(model, s) result(block)
      !> A chain of one block with kappa = 1
      type(model_type), intent(in) :: model
      !> 1 + kappa mu of the mode
      real(wp), intent(in) :: s

      block = model
      block%shape%mode = s - 1.0_wp
   end function of_mode

   !> The largest exponent for one s.
   subroutine measure_one(model, s, settings, options, growth, error)
      type(model_type), intent(in) :: model
      real(wp), intent(in) :: s
      type(growth_settings_type), intent(in) :: settings
      type(integration_options), intent(in) :: options
      type(transverse_growth_type), intent(out) :: growth
      type(error_type), allocatable, intent(out) :: error
      type(exponent_type), allocatable :: exponents(:)
      type(error_type), allocatable :: problem
      type(growth_type) :: measured
      type(growth_settings_type) :: one

      one = settings
      one%exponents = 1
      one%across_flow = .false.
      call measure_growth(of_mode(model, s), one, options, measured, problem)
      if (allocated(problem)) then
         call raise(error, "s = "//text(s)//": "//problem%message)
         return
      end if
      exponents = average_growth(measured%growth, measured%length, one%batches, .false.)
      growth = transverse_growth_type(s, exponents(1)%value, exponents(1)%error)
   end subroutine measure_one

   !> Zeros between values of s whose exponents have signs. Exponents are measured in between, until
   !> one has no sign; the error of the zero is that of this exponent over the slope. On cycles and
   !> tori the exponent at s = 1, that of the flow, has no sign.
   subroutine find_zeros(model, settings, options, growth, zeros, error)
      !> A chain of one block with kappa = 1, and its past
      type(model_type), intent(in) :: model
      !> When exponents are measured
      type(growth_settings_type), intent(in) :: settings
      !> Method and tolerances
      type(integration_options), intent(in) :: options
      !> Exponents, s ascending
      type(transverse_growth_type), intent(in) :: growth(:)
      !> Zeros, ascending
      type(zero_type), allocatable, intent(out) :: zeros(:)
      !> Error if an exponent cannot be measured
      type(error_type), allocatable, intent(out) :: error
      type(sign_change_type) :: bracket
      type(transverse_growth_type) :: ends(2), here
      type(transverse_growth_type), allocatable :: signed(:)
      real(wp) :: moved, slope
      integer :: i, round

      allocate (zeros(0))
      signed = pack(growth, abs(growth%value) > most_bars*growth%error)
      do i = 1, size(signed) - 1
         ends = signed(i:i + 1)
         if ((ends(1)%value > 0.0_wp) .eqv. (ends(2)%value > 0.0_wp)) cycle
         bracket = sign_change_type(ends%s, ends%value)
         do round = 1, most_rounds
            call measure_one(model, bracket%next(), settings, options, here, error)
            if (allocated(error)) return
            if (abs(here%value) <= most_bars*here%error) exit
            call bracket%narrow(here%s, here%value, moved)
            ends(merge(1, 2, (here%value > 0.0_wp) .eqv. (ends(1)%value > 0.0_wp))) = here
         end do
         slope = (ends(2)%value - ends(1)%value)/(ends(2)%s - ends(1)%s)
         zeros = [zeros, zero_type(here%s - here%value/slope, here%error/abs(slope), &
                                   slope > 0.0_wp)]
      end do
   end subroutine find_zeros
end module transverse_growth
