!> One step of the explicit pair 8(5,3) of Dormand and Prince, with its dense output of order 7
!> (Hairer, Norsett and Wanner 1993, sec. II.5, II.6 and II.10).
module dde_explicit_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_dop853_tableau
   use dde_history, only: history_type
   use dde_problem, only: dde_problem_type
   use kinds, only: int64, wp
   implicit none (type, external)
   private
   public :: explicit_step_type, explicit_degree, explicit_nodes, explicit_order

   !> Order of the step.
   integer, parameter :: explicit_order = 8
   !> Degree of the dense output.
   integer, parameter :: explicit_degree = 7
   !> Newton nodes of the dense output.
   real(wp), parameter :: explicit_nodes(explicit_degree) = &
                          real([0, 1, 0, 1, 0, 1, 0], wp)

   !> Stages of the current step.
   type :: explicit_step_type
      !> Slopes k(1..13) of the step and k(14..16) of its dense output, shape (n, 16)
      real(wp), allocatable :: k(:, :)
      !> State at the start of the step, shape (n)
      real(wp), allocatable :: y(:)
      !> State at its end, shape (n)
      real(wp), allocatable :: y_new(:)
      !> Argument of the current stage, shape (n)
      real(wp), allocatable :: stage(:)
      !> Delayed values of the current stage, shape (number of delayed values)
      real(wp), allocatable :: z(:)
      !> Start of the step as an ordinary number
      real(wp) :: t = 0.0_wp
      !> Length of the step
      real(wp) :: h = 0.0_wp
      !> Right-hand sides evaluated so far
      integer(int64) :: evaluations = 0
   contains
      !> First slope, where the last step's final slope does not serve
      procedure :: restart
      !> Try a step
      procedure :: attempt
      !> The final slope of an accepted step
      procedure :: complete
      !> Make the end of the step the start of the next
      procedure :: advance
      !> The slopes that only the dense output needs
      procedure :: extend
      !> Dense output of one component
      procedure :: interpolant
      !> One right-hand side
      procedure, private :: slope
   end type explicit_step_type

   interface explicit_step_type
      module procedure :: new_step
   end interface explicit_step_type

contains

   !> Storage, and the state at the first instant.
   pure function new_step(problem) result(step)
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      type(explicit_step_type) :: step

      allocate (step%k(problem%n, 16), step%y(problem%n), step%y_new(problem%n))
      allocate (step%stage(problem%n), step%z(size(problem%lag)))
      call problem%initial(step%y)
   end function new_step

   !> Evaluate the first slope at the start of the step that `past` faces.
   pure subroutine restart(self, problem, past, t)
      !> The step
      class(explicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      !> Start of the step
      real(wp), intent(in) :: t

      self%t = t
      call self%slope(problem, past, 0.0_wp, self%y, 1)
   end subroutine restart

   !> Slope number `j` at `ahead` after the start of the step, in state `y`.
   pure subroutine slope(self, problem, past, ahead, y, j)
      !> The step
      class(explicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      !> Time since the start of the step
      real(wp), intent(in) :: ahead
      !> State, shape (n)
      real(wp), intent(in) :: y(:)
      !> Which slope
      integer, intent(in) :: j

      if (size(self%z) > 0) call past%values(problem, ahead, self%z)
      call problem%rhs(self%t + ahead, y, self%z, self%k(:, j))
      self%evaluations = self%evaluations + 1
   end subroutine slope

   !> Try the step of length `h` from t; `error` is the 853 estimate in units of the tolerance
   !> (step good when <= 1), or not finite where an evaluation was not.
   pure subroutine attempt(self, problem, past, t, h, relative, absolute, error)
      !> The step
      class(explicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past
      !> Start of the step
      real(wp), intent(in) :: t
      !> Length of the step
      real(wp), intent(in) :: h
      !> Relative tolerance
      real(wp), intent(in) :: relative
      !> Absolute tolerance
      real(wp), intent(in) :: absolute
      !> Estimated error in units of the tolerance
      real(wp), intent(out) :: error

      self%t = t
      self%h = h
      associate (k => self%k, y => self%y, stage => self%stage)
         stage = y + h*a21*k(:, 1)
         call self%slope(problem, past, c2*h, stage, 2)
         stage = y + h*(a31*k(:, 1) + a32*k(:, 2))
         call self%slope(problem, past, c3*h, stage, 3)
         stage = y + h*(a41*k(:, 1) + a43*k(:, 3))
         call self%slope(problem, past, c4*h, stage, 4)
         stage = y + h*(a51*k(:, 1) + a53*k(:, 3) + a54*k(:, 4))
         call self%slope(problem, past, c5*h, stage, 5)
         stage = y + h*(a61*k(:, 1) + a64*k(:, 4) + a65*k(:, 5))
         call self%slope(problem, past, c6*h, stage, 6)
         stage = y + h*(a71*k(:, 1) + a74*k(:, 4) + a75*k(:, 5) + a76*k(:, 6))
         call self%slope(problem, past, c7*h, stage, 7)
         stage = y + h*(a81*k(:, 1) + a84*k(:, 4) + a85*k(:, 5) + a86*k(:, 6) + a87*k(:, 7))
         call self%slope(problem, past, c8*h, stage, 8)
         stage = y + h*(a91*k(:, 1) + a94*k(:, 4) + a95*k(:, 5) + a96*k(:, 6) + a97*k(:, 7) &
                        + a98*k(:, 8))
         call self%slope(problem, past, c9*h, stage, 9)
         stage = y + h*(a10_1*k(:, 1) + a10_4*k(:, 4) + a10_5*k(:, 5) + a10_6*k(:, 6) &
                        + a10_7*k(:, 7) + a10_8*k(:, 8) + a10_9*k(:, 9))
         call self%slope(problem, past, c10*h, stage, 10)
         stage = y + h*(a11_1*k(:, 1) + a11_4*k(:, 4) + a11_5*k(:, 5) + a11_6*k(:, 6) &
                        + a11_7*k(:, 7) + a11_8*k(:, 8) + a11_9*k(:, 9) + a11_10*k(:, 10))
         call self%slope(problem, past, c11*h, stage, 11)
         stage = y + h*(a12_1*k(:, 1) + a12_4*k(:, 4) + a12_5*k(:, 5) + a12_6*k(:, 6) &
                        + a12_7*k(:, 7) + a12_8*k(:, 8) + a12_9*k(:, 9) + a12_10*k(:, 10) &
                        + a12_11*k(:, 11))
         call self%slope(problem, past, h, stage, 12)
         self%y_new = y + h*(b1*k(:, 1) + b6*k(:, 6) + b7*k(:, 7) + b8*k(:, 8) + b9*k(:, 9) &
                             + b10*k(:, 10) + b11*k(:, 11) + b12*k(:, 12))
      end associate
      error = error_853(self, relative, absolute)
   end subroutine attempt

   !> The estimate h |e5|^2 / sqrt(|e5|^2 + 0.01 |e3|^2), each in the root mean square norm over the
   !> tolerance (Hairer, Norsett and Wanner 1993, eq. (II.10.17)).
   pure function error_853(self, relative, absolute) result(error)
      !> The step
      class(explicit_step_type), intent(in) :: self
      !> Relative tolerance
      real(wp), intent(in) :: relative
      !> Absolute tolerance
      real(wp), intent(in) :: absolute
      real(wp) :: error
      real(wp) :: e3, e5, scale, sum3, sum5
      integer :: i

      error = 0.0_wp
      sum3 = 0.0_wp
      sum5 = 0.0_wp
      do i = 1, size(self%y)
         associate (k => self%k(i, :))
            scale = absolute + relative*max(abs(self%y(i)), abs(self%y_new(i)))
            e3 = (b1 - bhh1)*k(1) + b6*k(6) + b7*k(7) + b8*k(8) + (b9 - bhh2)*k(9) + b10*k(10) &
                 + b11*k(11) + (b12 - bhh3)*k(12)
            e5 = er1*k(1) + er6*k(6) + er7*k(7) + er8*k(8) + er9*k(9) + er10*k(10) + er11*k(11) &
                 + er12*k(12)
         end associate
         sum3 = sum3 + (e3/scale)**2
         sum5 = sum5 + (e5/scale)**2
      end do
      if (.not. all(ieee_is_finite([sum5, self%y_new]))) then
         error = ieee_value(error, ieee_quiet_nan)
      else if (sum5 > 0.0_wp) then
         error = abs(self%h)*sum5/sqrt((sum5 + 0.01_wp*sum3)*size(self%y))
      end if
   end function error_853

   !> Slope 13, at the end of an accepted step.
   pure subroutine complete(self, problem, past)
      !> The step
      class(explicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past

      call self%slope(problem, past, self%h, self%y_new, 13)
   end subroutine complete

   !> The end of the step becomes the start of the next; its last slope serves as the first.
   pure subroutine advance(self)
      !> The step
      class(explicit_step_type), intent(inout) :: self

      self%y = self%y_new
      self%k(:, 1) = self%k(:, 13)
   end subroutine advance

   !> Slopes 14 to 16 of an accepted step.
   pure subroutine extend(self, problem, past)
      !> The step
      class(explicit_step_type), intent(inout) :: self
      !> The problem
      class(dde_problem_type), intent(in) :: problem
      !> The past, facing this step
      type(history_type), intent(inout) :: past

      associate (k => self%k, y => self%y, h => self%h, stage => self%stage)
         stage = y + h*(a14_1*k(:, 1) + a14_7*k(:, 7) + a14_8*k(:, 8) + a14_9*k(:, 9) &
                        + a14_10*k(:, 10) + a14_11*k(:, 11) + a14_12*k(:, 12) + a14_13*k(:, 13))
         call self%slope(problem, past, c14*h, stage, 14)
         stage = y + h*(a15_1*k(:, 1) + a15_6*k(:, 6) + a15_7*k(:, 7) + a15_8*k(:, 8) &
                        + a15_11*k(:, 11) + a15_12*k(:, 12) + a15_13*k(:, 13) + a15_14*k(:, 14))
         call self%slope(problem, past, c15*h, stage, 15)
         stage = y + h*(a16_1*k(:, 1) + a16_6*k(:, 6) + a16_7*k(:, 7) + a16_8*k(:, 8) &
                        + a16_9*k(:, 9) + a16_13*k(:, 13) + a16_14*k(:, 14) + a16_15*k(:, 15))
         call self%slope(problem, past, c16*h, stage, 16)
      end associate
   end subroutine extend

   !> Dense output of component `i` over an accepted and extended step, before `advance`.
   pure function interpolant(self, i) result(a)
      !> The step
      class(explicit_step_type), intent(in) :: self
      !> Which component
      integer, intent(in) :: i
      !> Newton coefficients over `explicit_nodes`
      real(wp) :: a(0:explicit_degree)
      real(wp) :: rise

      associate (k => self%k(i, :), h => self%h)
         rise = self%y_new(i) - self%y(i)
         a(0) = self%y(i)
         a(1) = rise
         a(2) = rise - h*k(1)
         a(3) = h*(k(1) + k(13)) - 2.0_wp*rise
         a(4) = h*(d41*k(1) + d46*k(6) + d47*k(7) + d48*k(8) + d49*k(9) + d4_10*k(10) &
                   + d4_11*k(11) + d4_12*k(12) + d4_13*k(13) + d4_14*k(14) + d4_15*k(15) &
                   + d4_16*k(16))
         a(5) = h*(d51*k(1) + d56*k(6) + d57*k(7) + d58*k(8) + d59*k(9) + d5_10*k(10) &
                   + d5_11*k(11) + d5_12*k(12) + d5_13*k(13) + d5_14*k(14) + d5_15*k(15) &
                   + d5_16*k(16))
         a(6) = -h*(d61*k(1) + d66*k(6) + d67*k(7) + d68*k(8) + d69*k(9) + d6_10*k(10) &
                    + d6_11*k(11) + d6_12*k(12) + d6_13*k(13) + d6_14*k(14) + d6_15*k(15) &
                    + d6_16*k(16))
         a(7) = -h*(d71*k(1) + d76*k(6) + d77*k(7) + d78*k(8) + d79*k(9) + d7_10*k(10) &
                    + d7_11*k(11) + d7_12*k(12) + d7_13*k(13) + d7_14*k(14) + d7_15*k(15) &
                    + d7_16*k(16))
      end associate
   end function interpolant
end module dde_explicit_step
