!> A case to measure: one parameter set of the delayed block, its history and its sample times. All
!> quantities are nondimensional. A program compiled in quadruple precision rounds them to double
!> precision, so that it solves the very problem that the program in double precision solves.
module measured_case
   use block_parameters, only: block_history_type, block_parameters_type
   use dde_kinds, only: wp
   use spring_block, only: spring_block_type
   implicit none (type, external)
   private
   public :: as_double, case_type

   !> Double precision, also where `wp` is another.
   integer, parameter :: double = selected_real_kind(15, 307)

   !> One case.
   type :: case_type
      !> Name
      character(len=256) :: name = ""
      !> Parameters
      type(block_parameters_type) :: parameters
      !> Values for t <= 0
      type(block_history_type) :: history
      !> Last time
      real(wp) :: t_end = 1.0_wp
      !> Time between samples
      real(wp) :: sample_interval = 1.0_wp
   contains
      procedure :: problem, sample_times
   end type case_type

contains

   !> The block with this case's parameters, rounded to double precision in any precision.
   function problem(self, disturbance) result(block)
      class(case_type), intent(in) :: self
      !> Change of theta and u and relative change of v for t <= 0
      real(wp), intent(in) :: disturbance
      type(spring_block_type) :: block

      associate (p => self%parameters, past => self%history)
         block = spring_block_type( &
                 block_parameters_type(tau=as_double(p%tau), epsilon=as_double(p%epsilon), &
                                       xi=as_double(p%xi), gamma=as_double(p%gamma), &
                                       law=p%law, own=as_double(p%own)), &
                 block_history_type(theta=as_double(past%theta) + disturbance, &
                                    u=as_double(past%u) + disturbance, &
                                    v=as_double(past%v)*(1.0_wp + disturbance)))
      end associate
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
