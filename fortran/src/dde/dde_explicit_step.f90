!> One step of the explicit pair 8(5,3) of Dormand and Prince, with its dense output of order 7
!> (Hairer, Norsett and Wanner 1993, sec. II.5, II.6 and II.10).
module dde_explicit_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use dde_dop853_tableau
   use dde_history, only: history_type
   use dde_norm, only: scaled_norm
   use dde_problem, only: dde_problem_type
   use dde_step, only: step_type
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: explicit_step_type

   !> Stages of the current step.
   type, extends(step_type) :: explicit_step_type
      !> Slopes k(1..13) of the step and k(14..16) of its dense output, shape (n, 16)
      real(wp), allocatable :: k(:, :)
      !> Argument of the current stage, and of the last of the step, shape (n)
      real(wp), allocatable :: stage(:), last_stage(:)
      !> Whether all slopes so far are finite
      logical :: finite = .true.
   contains
      procedure :: attempt
      procedure :: complete
      procedure :: extend
      procedure :: interpolant
      procedure :: stiffness
      procedure :: advance
      procedure, private :: evaluate
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

      step%name = "explicit"
      step%order = 8
      step%error_order = 8
      step%nodes = real([0, 1, 0, 1, 0, 1, 0], wp)
      allocate (step%k(problem%n, 16), step%y(problem%n), step%y_new(problem%n))
      allocate (step%slope(problem%n), step%stage(problem%n), step%last_stage(problem%n))
      allocate (step%z(size(problem%lag)))
      call problem%initial(step%y)
   end function new_step

   !> Slope number `j` at `ahead` after the start of the step, in state `y`, unless an earlier slope
   !> of this step was not finite.
   pure subroutine evaluate(self, problem, past, ahead, y, j)
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

      if (.not. self%finite) return
      if (size(self%z) > 0) call past%values(problem, ahead, self%z)
      call problem%rhs(self%t + ahead, y, self%z, self%k(:, j))
      self%evaluations = self%evaluations + 1
      self%finite = all(ieee_is_finite(self%k(:, j)))
   end subroutine evaluate

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
      self%k(:, 1) = self%slope
      self%finite = all(ieee_is_finite(self%slope))
      associate (k => self%k, y => self%y, stage => self%stage)
         stage = y + h*a21*k(:, 1)
         call self%evaluate(problem, past, c2*h, stage, 2)
         stage = y + h*(a31*k(:, 1) + a32*k(:, 2))
         call self%evaluate(problem, past, c3*h, stage, 3)
         stage = y + h*(a41*k(:, 1) + a43*k(:, 3))
         call self%evaluate(problem, past, c4*h, stage, 4)
         stage = y + h*(a51*k(:, 1) + a53*k(:, 3) + a54*k(:, 4))
         call self%evaluate(problem, past, c5*h, stage, 5)
         stage = y + h*(a61*k(:, 1) + a64*k(:, 4) + a65*k(:, 5))
         call self%evaluate(problem, past, c6*h, stage, 6)
         stage = y + h*(a71*k(:, 1) + a74*k(:, 4) + a75*k(:, 5) + a76*k(:, 6))
         call self%evaluate(problem, past, c7*h, stage, 7)
         stage = y + h*(a81*k(:, 1) + a84*k(:, 4) + a85*k(:, 5) + a86*k(:, 6) + a87*k(:, 7))
         call self%evaluate(problem, past, c8*h, stage, 8)
         stage = y + h*(a91*k(:, 1) + a94*k(:, 4) + a95*k(:, 5) + a96*k(:, 6) + a97*k(:, 7) &
                        + a98*k(:, 8))
         call self%evaluate(problem, past, c9*h, stage, 9)
         stage = y + h*(a10_1*k(:, 1) + a10_4*k(:, 4) + a10_5*k(:, 5) + a10_6*k(:, 6) &
                        + a10_7*k(:, 7) + a10_8*k(:, 8) + a10_9*k(:, 9))
         call self%evaluate(problem, past, c10*h, stage, 10)
         stage = y + h*(a11_1*k(:, 1) + a11_4*k(:, 4) + a11_5*k(:, 5) + a11_6*k(:, 6) &
                        + a11_7*k(:, 7) + a11_8*k(:, 8) + a11_9*k(:, 9) + a11_10*k(:, 10))
         call self%evaluate(problem, past, c11*h, stage, 11)
         stage = y + h*(a12_1*k(:, 1) + a12_4*k(:, 4) + a12_5*k(:, 5) + a12_6*k(:, 6) &
                        + a12_7*k(:, 7) + a12_8*k(:, 8) + a12_9*k(:, 9) + a12_10*k(:, 10) &
                        + a12_11*k(:, 11))
         call self%evaluate(problem, past, h, stage, 12)
         self%last_stage = stage
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
      real(wp), dimension(size(self%y)) :: e3, e5, scale
      real(wp) :: norm3, norm5

      error = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. (self%finite .and. all(ieee_is_finite(self%y_new)))) return
      scale = absolute + relative*max(abs(self%y), abs(self%y_new))
      associate (k => self%k)
         e3 = (b1 - bhh1)*k(:, 1) + b6*k(:, 6) + b7*k(:, 7) + b8*k(:, 8) + (b9 - bhh2)*k(:, 9) &
              + b10*k(:, 10) + b11*k(:, 11) + (b12 - bhh3)*k(:, 12)
         e5 = er1*k(:, 1) + er6*k(:, 6) + er7*k(:, 7) + er8*k(:, 8) + er9*k(:, 9) &
              + er10*k(:, 10) + er11*k(:, 11) + er12*k(:, 12)
      end associate
      norm3 = scaled_norm(e3, scale)
      norm5 = scaled_norm(e5, scale)
      if (max(norm3, norm5) >= huge(1.0_wp)) then
         error = huge(1.0_wp)
      else if (norm5 > 0.0_wp) then
         error = abs(self%h)*norm5*(norm5/hypot(norm5, 0.1_wp*norm3))
      else
         error = 0.0_wp
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

      call self%evaluate(problem, past, self%h, self%y_new, 13)
   end subroutine complete

   !> |k13 - k12| over the distance of their arguments, both at the end of the step (Hairer and
   !> Wanner 1996, sec. IV.2).
   pure function stiffness(self) result(value)
      !> The step
      class(explicit_step_type), intent(in) :: self
      real(wp) :: value
      real(wp) :: distance

      value = 0.0_wp
      distance = norm2(self%y_new - self%last_stage)
      if (distance > 0.0_wp) value = norm2(self%k(:, 13) - self%k(:, 12))/distance
   end function stiffness

   !> The end of the step becomes the start of the next; its last slope serves as the first.
   pure subroutine advance(self)
      !> The step
      class(explicit_step_type), intent(inout) :: self

      self%y = self%y_new
      self%slope = self%k(:, 13)
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
         call self%evaluate(problem, past, c14*h, stage, 14)
         stage = y + h*(a15_1*k(:, 1) + a15_6*k(:, 6) + a15_7*k(:, 7) + a15_8*k(:, 8) &
                        + a15_11*k(:, 11) + a15_12*k(:, 12) + a15_13*k(:, 13) + a15_14*k(:, 14))
         call self%evaluate(problem, past, c15*h, stage, 15)
         stage = y + h*(a16_1*k(:, 1) + a16_6*k(:, 6) + a16_7*k(:, 7) + a16_8*k(:, 8) &
                        + a16_9*k(:, 9) + a16_13*k(:, 13) + a16_14*k(:, 14) + a16_15*k(:, 15))
         call self%evaluate(problem, past, c16*h, stage, 16)
      end associate
   end subroutine extend

   !> Dense output of component `i` over an accepted and extended step, before `advance`.
   pure subroutine interpolant(self, i, a)
      !> The step
      class(explicit_step_type), intent(in) :: self
      !> Which component
      integer, intent(in) :: i
      !> Newton coefficients over `nodes`
      real(wp), intent(out) :: a(0:)
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
   end subroutine interpolant
end module dde_explicit_step
