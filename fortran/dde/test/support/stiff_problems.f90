!> Problems with exact solutions that ask for an implicit method.
module stiff_problems
   use dde, only: dde_problem_type
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: exponential_decay, prothero_robinson

   !> y' = rate (y - cos t) - sin t, y(0) = cos 0: y = cos t whatever the rate (Prothero and
   !> Robinson 1974).
   type, extends(dde_problem_type) :: prothero_robinson
      !> Rate, far below 0
      real(wp) :: rate = 0.0_wp
   contains
      procedure :: initial => start_at_one
      procedure :: history => no_history
      procedure :: rhs => relax_to_cosine
   end type prothero_robinson

   !> y' = -y(t - lag) with the history exp(rate t), where rate = -exp(-rate lag): y = exp(rate t).
   type, extends(dde_problem_type) :: exponential_decay
      !> Characteristic root
      real(wp) :: rate = 0.0_wp
   contains
      procedure :: initial => start_of_decay
      procedure :: history => earlier_decay
      procedure :: rhs => minus_delayed
   end type exponential_decay

   interface prothero_robinson
      module procedure :: new_prothero_robinson
   end interface prothero_robinson

   interface exponential_decay
      module procedure :: new_exponential_decay
   end interface exponential_decay

contains

   !> The problem of a given rate.
   pure function new_prothero_robinson(rate) result(problem)
      real(wp), intent(in) :: rate
      type(prothero_robinson) :: problem

      problem%n = 1
      allocate (problem%lag(0), problem%component(0))
      problem%rate = rate
   end function new_prothero_robinson

   !> The problem of a given delay below 1/e; its root by Newton's method.
   pure function new_exponential_decay(lag) result(problem)
      real(wp), intent(in) :: lag
      type(exponential_decay) :: problem
      integer :: i

      problem%n = 1
      allocate (problem%lag, source=[lag])
      allocate (problem%component, source=[1])
      problem%rate = -1.0_wp
      do i = 1, 20
         associate (x => problem%rate, e => exp(-problem%rate*lag))
            x = x - (x + e)/(1.0_wp - lag*e)
         end associate
      end do
   end function new_exponential_decay

   !> y(0) = 1.
   pure subroutine start_at_one(self, y)
      class(prothero_robinson), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = 1.0_wp
   end subroutine start_at_one

   !> Not asked for.
   pure function no_history(self, t, component) result(value)
      class(prothero_robinson), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = 0.0_wp
   end function no_history

   !> rate (y - cos t) - sin t.
   pure subroutine relax_to_cosine(self, t, y, z, dydt)
      class(prothero_robinson), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = self%rate*(y - cos(t)) - sin(t)
   end subroutine relax_to_cosine

   !> y(0) = 1.
   pure subroutine start_of_decay(self, y)
      class(exponential_decay), intent(in) :: self
      real(wp), intent(out) :: y(self%n)

      y = 1.0_wp
   end subroutine start_of_decay

   !> exp(rate t).
   pure function earlier_decay(self, t, component) result(value)
      class(exponential_decay), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: component
      real(wp) :: value

      value = exp(self%rate*t)
   end function earlier_decay

   !> -y(t - lag).
   pure subroutine minus_delayed(self, t, y, z, dydt)
      class(exponential_decay), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: y(self%n)
      real(wp), intent(in) :: z(size(self%lag))
      real(wp), intent(out) :: dydt(self%n)

      dydt = -z
   end subroutine minus_delayed
end module stiff_problems
