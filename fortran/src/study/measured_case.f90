! SPDX-License-Identifier: BSD-3-Clause
!> A case to measure: a model with its parameters, its history and its sample times. A program
!> compiled in quadruple precision rounds them to double precision, so that it solves the very
!> problem that the program in double precision solves.
module measured_case
   use dde_kinds, only: wp
   use model_history, only: history_type
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: as_double, case_type

   !> Double precision, also where `wp` is another.
   integer, parameter :: double = selected_real_kind(15, 307)

   !> One case.
   type :: case_type
      !> Name
      character(len=256) :: name = ""
      !> The model with its parameters
      type(model_type) :: model
      !> Its history
      type(history_type) :: history
      !> Last time
      real(wp) :: t_end = 1.0_wp
      !> Time between samples
      real(wp) :: sample_interval = 1.0_wp
   contains
      procedure :: problem, sample_times
   end type case_type

contains

   !> The model with this case's parameters, rounded to double precision in any precision.
   function problem(self, disturbance) result(model)
      class(case_type), intent(in) :: self
      !> Change of the values before the initial time, relative where they are exponentials of
      !> states
      real(wp), intent(in) :: disturbance
      type(model_type) :: model
      type(history_type) :: history
      integer :: i

      model = self%model
      history = self%history
      do i = 1, size(history%names)
         associate (values => as_double(history%values(i, :, :)))
            if (history%exponential(i)) then
               history%states(i, :, :) = log(values*(1.0_wp + disturbance))
            else
               history%states(i, :, :) = values + disturbance
            end if
         end associate
      end do
      model%past = history%past(model, 1)
      call model%put(as_double(model%numbers))
   end function problem

   !> Times of samples: multiples of the interval up to t_end.
   pure function sample_times(self) result(time)
      class(case_type), intent(in) :: self
      real(wp), allocatable :: time(:)
      integer :: i

      associate (interval => as_double(self%sample_interval), last => as_double(self%t_end))
         ! the quotient may be one rounding below a whole number
         time = [(as_double(i*interval), i=0, floor(last/interval*(1.0_wp + 1.0e-12_wp)))]
         time(size(time)) = min(time(size(time)), last)
      end associate
   end function sample_times

   !> The nearest number of double precision; a number of double precision stays what it is.
   elemental real(wp) function as_double(number) result(rounded)
      !> A number within the range of double precision
      real(wp), intent(in) :: number

      rounded = real(real(number, double), wp)
   end function as_double
end module measured_case
