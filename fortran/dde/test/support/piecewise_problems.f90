! SPDX-License-Identifier: BSD-3-Clause
!> Problems that jump, that change their stiffness, that have switching functions, or many equations
!> or delays.
module piecewise_problems
   use dde_kinds, only: wp
   use test_problems, only: constant_past, decay_of_past, fill
   implicit none (type, external)
   private
   public :: cells, changing_stiffness, delayed_pulse, jumping_history, logistic, many_delays
   public :: sided, switching_kinds

   !> Number of problems that jump or change their stiffness again and again.
   integer, parameter :: switching_kinds = 6

   !> A problem with switching functions.
   type, extends(constant_past) :: sided
      character(len=8) :: kind = ""
      !> -1 or 1 for each of them
      real(wp), allocatable :: side(:)
   contains
      procedure :: rhs, switching, take_sides, act
   end type sided

   interface sided
      module procedure :: new_sided
   end interface sided

   !> A delayed logistic reaction that diffuses between cells, y_i' = 1.8 y_i (1 - z_i) + d (y_(i-1)
   !> - 2 y_i + y_(i+1)) without flux at the ends, z_i = y_i(t - 1), or y_i itself without delay.
   type, extends(constant_past) :: cells
      !> Whether it gives the derivatives, in a band of three diagonals
      logical :: gives_jacobian = .false.
   contains
      procedure :: jacobian => three_diagonals
   end type cells

   interface cells
      module procedure :: new_cells
   end interface cells

contains

   !> y' = y(t - 1), y = `before` for t < -1/2, 1 for -1/2 <= t < 0, y(0) = 0: y(5/2) = 7/8 after 0.
   type(constant_past) function jumping_history(before) result(problem)
      real(wp), intent(in) :: before

      call fill(problem, 1, first=[0.0_wp], lag=[1.0_wp], component=[1], p=[-1.0_wp, before])
      problem%f => decay_of_past
      problem%exact => step_before
   end function jumping_history

   !> y1' = 100 for 50 <= t < 50.1, else 0; y2' = y1(t - 1): from (0, 0), y2(55) = 39.5.
   type(constant_past) function delayed_pulse() result(problem)
      call fill(problem, 2, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [1.0_wp], [1])
      problem%f => pulse
   end function delayed_pulse

   !> y' = -y - (sum of all delayed values)/24, or less of each if they are very many.
   type(constant_past) function many_delays(lag) result(problem)
      real(wp), intent(in) :: lag(:)

      call fill(problem, 1, [1.0_wp], [1.0_wp], lag, spread(1, 1, size(lag)))
      problem%f => sum_of_past
   end function many_delays

   !> One of those that change their stiffness, with a fast rate k.
   type(constant_past) function changing_stiffness(kind, k) result(problem)
      integer, intent(in) :: kind
      real(wp), intent(in) :: k

      call fill(problem, 2, [0.5_wp, 0.5_wp], [0.5_wp, 0.5_wp], [1.0_wp, 1.0_wp], [1, 2], &
                [real(kind, wp), k])
      problem%f => switch
   end function changing_stiffness

   !> relay: y' = -sign(y(t - 1)), from 1 a triangle of period 4. pulses: y' = 1 where sin(40 t) >
   !> 0, else 0. friction: twice y1' = y2, y2' = -y1 - sign(y2)/10 (Coulomb): each half period takes
   !> 1/5 of the amplitude, and it stays at rest where |y1| <= 1/10. ball: y1' = y2, y2' = -1, y3' =
   !> y2(t - 1/4), and y2 becomes -y2/2 where y1 falls to 0, at 3 - 2, 3 - 1, 3 - 1/2 and so on.
   !> neuron: y1' = 2 - y1, 0 again at 1, after log 2, and y2' = y1(t - 1/2). order: y1' = 1, and at
   !> 1/3 y2 grows by 1, then is doubled. chatter: y1' = y2, -1 where y1 rises to 0, else 1.
   type(sided) function new_sided(kind) result(problem)
      character(len=*), intent(in) :: kind

      problem%kind = kind
      select case (kind)
      case ("relay")
         call fill(problem, 1, [1.0_wp], [1.0_wp], [1.0_wp], [1])
      case ("pulses")
         call fill(problem, 1, first=[0.0_wp])
      case ("ball")
         call fill(problem, 3, [0.5_wp, 0.0_wp, 0.0_wp], [0.5_wp, 0.0_wp, 0.0_wp], [0.25_wp], [2])
         problem%acting = 1
      case ("neuron")
         call fill(problem, 2, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [0.5_wp], [1])
         problem%acting = 1
      case ("order", "chatter")
         call fill(problem, 2, first=[merge(0.0_wp, -1.0_wp, kind == "order"), 1.0_wp])
         problem%acting = 2
      case default
         call fill(problem, 4, first=[1.0_wp, 0.0_wp, 1.0_wp, 0.0_wp])
      end select
      problem%switches = (problem%n + 1)/2
      if (problem%acting > 0) problem%switches = problem%acting
      allocate (problem%side(problem%switches), source=0.0_wp)
   end function new_sided

   !> The cells, from one wave.
   type(cells) function new_cells(n, diffusion, delayed) result(problem)
      integer, intent(in) :: n
      real(wp), intent(in) :: diffusion
      logical, intent(in) :: delayed
      integer :: i

      call fill(problem, n, [(1.0_wp + 0.5_wp*cos(acos(-1.0_wp)*(i - 0.5_wp)/n), i=1, n)], &
                lag=spread(1.0_wp, 1, merge(n, 0, delayed)), &
                component=[(i, i=1, merge(n, 0, delayed))], &
                p=[diffusion, merge(0.0_wp, 1.8_wp, delayed)])
      problem%first = problem%past
      problem%rows = reshape([(i, i, i=1, size(problem%lag))], [2, size(problem%lag)])
      problem%f => react_and_diffuse
   end function new_cells

   !> Components of which the first are delayed and react, without diffusion, and others stay.
   type(constant_past) function logistic(first, delayed) result(problem)
      real(wp), intent(in) :: first(:)
      integer, intent(in) :: delayed
      integer :: i

      call fill(problem, size(first), first, first, spread(1.0_wp, 1, delayed), &
                [(i, i=1, delayed)], [0.0_wp, 0.0_wp])
      problem%lower = 0
      problem%upper = 0
      problem%rows = reshape([(i, i, i=1, delayed)], [2, delayed])
      problem%f => react_and_diffuse
      problem%terms => series_of_reaction
      problem%analytic = .true.
   end function logistic

   pure subroutine step_before(p, t, y)
      real(wp), intent(in) :: p(:), t
      real(wp), intent(out) :: y(:)

      y = merge(1.0_wp, p(2), t >= -0.5_wp)
   end subroutine step_before

   pure subroutine pulse(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = [merge(100.0_wp, 0.0_wp, t >= 50.0_wp .and. t < 50.1_wp), z(1)]
   end subroutine pulse

   pure subroutine sum_of_past(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      f = -y - sum(z)/max(24, size(z)/5)
   end subroutine sum_of_past

   pure subroutine switch(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)

      associate (k => p(2))
         select case (nint(p(1)))
         case (1) ! a square wave
            f = [-k*(y(1) - sign(1.0_wp, sin(t))), -y(2) - z(1)]
         case (2) ! a stiffness that comes and goes
            f = [-merge(k, 1.0_wp, sin(3*t) > 0.0_wp)*(y(1) - cos(t)), -y(2) + z(1)]
         case (3) ! a fast square wave
            f = [-k*(y(1) - sign(1.0_wp, sin(10*t)) - z(2)), y(1) - y(2)]
         case (4) ! the oscillator of van der Pol
            f = [y(2), k*((1.0_wp - y(1)**2)*y(2) - y(1))]
         case (5) ! a thermostat
            f = [-k*(y(1) - 2*y(2)), merge(1.0_wp, -1.0_wp, z(1) < 0.5_wp) - 0.1_wp*y(2)]
         case default ! a steep delayed feedback
            f = [k*(1.0_wp/(1.0_wp + max(z(1), 0.0_wp)**20) - y(1)), y(1) - y(2)]
         end select
      end associate
   end subroutine switch

   pure subroutine rhs(self, t, y, z, dydt)
      class(sided), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      select case (self%kind)
      case ("relay")
         dydt = -self%side
      case ("pulses")
         dydt = 0.5_wp*(1.0_wp + self%side)
      case ("ball")
         dydt = [y(2), -1.0_wp, z(1)]
      case ("neuron")
         dydt = [2.0_wp - y(1), z(1)]
      case ("order", "chatter")
         dydt = [merge(1.0_wp, y(2), self%kind == "order"), 0.0_wp]
      case default
         dydt(1::2) = y(2::2)
         dydt(2::2) = -y(1::2) - 0.1_wp*self%side
      end select
   end subroutine rhs

   pure subroutine switching(self, t, y, z, values)
      class(sided), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), intent(out) :: values(self%switches)

      if (self%kind == "relay") values = z
      if (self%kind == "pulses") values = sin(40.0_wp*t)
      if (self%kind == "friction") values = y(2::2)
      if (self%kind == "ball" .or. self%kind == "chatter") values = y(1)
      if (self%kind == "neuron") values = y(1) - 1.0_wp
      if (self%kind == "order") values = [y(1) - 1.0_wp/3.0_wp, 3.0_wp*y(1) - 1.0_wp]
   end subroutine switching

   pure subroutine act(self, number, rises, t, z, y, acts)
      class(sided), intent(in) :: self
      integer, intent(in) :: number
      logical, intent(in) :: rises
      real(wp), intent(in) :: t, z(size(self%lag))
      real(wp), intent(inout) :: y(self%n)
      logical, intent(out) :: acts

      acts = rises .neqv. (self%kind == "ball" .or. self%kind == "chatter" .and. number == 2)
      if (.not. acts) return
      if (self%kind == "ball") y(2) = -0.5_wp*y(2)
      if (self%kind == "neuron") y(1) = 0.0_wp
      if (self%kind == "order") y(2) = merge(y(2) + 1.0_wp, 2.0_wp*y(2), number == 1)
      if (self%kind == "chatter") y(2) = merge(-1.0_wp, 1.0_wp, number == 1)
   end subroutine act

   pure subroutine take_sides(self, above)
      class(sided), intent(inout) :: self
      logical, intent(in) :: above(:)

      self%side = merge(1.0_wp, -1.0_wp, above)
   end subroutine take_sides

   pure subroutine react_and_diffuse(p, t, y, z, f)
      real(wp), intent(in) :: p(:), t, y(:), z(:)
      real(wp), intent(out) :: f(:)
      integer :: i

      do i = 1, size(y)
         if (i <= size(z)) then
            f(i) = 1.8_wp*y(i)*(1.0_wp - z(i))
         else
            f(i) = p(2)*y(i)*(1.0_wp - y(i))
         end if
         ! no flux at the ends
         f(i) = f(i) + p(1)*(y(max(1, i - 1)) - y(i)) + p(1)*(y(min(size(y), i + 1)) - y(i))
      end do
   end subroutine react_and_diffuse

   !> Of the reaction alone.
   pure subroutine series_of_reaction(p, t, unit, z, y)
      real(wp), intent(in) :: p(:), t, unit, z(0:, :)
      real(wp), intent(inout) :: y(0:, :)
      integer :: i, k

      y(1:, :) = 0.0_wp
      do i = 1, size(z, 2)
         do k = 0, ubound(y, 1) - 1
            y(k + 1, i) = unit/(k + 1)*1.8_wp*(y(k, i) - sum(y(0:k, i)*z(k:0:-1, i)))
         end do
      end do
   end subroutine series_of_reaction

   pure subroutine three_diagonals(self, t, y, z, by_y, by_z)
      class(cells), intent(in) :: self
      real(wp), intent(in) :: t, y(self%n), z(size(self%lag))
      real(wp), contiguous, intent(out) :: by_y(:, :), by_z(:, :)

      if (.not. self%gives_jacobian) then
         call self%constant_past%jacobian(t, y, z, by_y, by_z)
         return
      end if
      by_y = self%p(1)
      by_y(2, :) = 1.8_wp*(1.0_wp - z) - 2*self%p(1)
      by_y(2, 1) = by_y(2, 1) + self%p(1)
      by_y(2, self%n) = by_y(2, self%n) + self%p(1)
      by_z(1, :) = -1.8_wp*y
   end subroutine three_diagonals
end module piecewise_problems
