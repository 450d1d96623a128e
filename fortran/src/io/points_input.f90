!> Points at which attractors are looked for, from the section `points` of a namelist: a grid in the
!> four parameters of the block and a list of histories, or a sweep along one parameter.
module points_input
   use attractor_points, only: point_type
   use block_parameters, only: block_history_type, block_parameters_type, most_own
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_description, only: law_length => word_length
   use namelist_input, only: word_length
   use value_checks, only: absent, check_choice, check_count, missing, missing_count
   implicit none (type, external)
   private
   public :: points_settings_type

   !> Evenly spaced values of one parameter, of which a part is computed.
   type :: axis_type
      !> First and last value
      real(wp) :: window(2) = missing
      !> Number of values; the first alone when 1
      integer :: count = missing_count
      !> First and last that are computed, from 1
      integer :: part(2) = missing_count
   end type axis_type

   !> Where attractors are looked for, and what is kept of each.
   type :: points_settings_type
      !> Name of what the points belong to
      character(len=word_length) :: name = ""
      !> Values of the parameters
      type(axis_type) :: epsilon, tau, xi, gamma
      !> Law of friction and its own parameters
      character(len=law_length) :: law = ""
      real(wp) :: own(most_own) = absent
      !> Whether each point starts where the one before ended: "none", "up" or "down"
      character(len=word_length) :: sweep = ""
      !> Every 2**refinements-th line in epsilon and tau is computed in full
      integer :: refinements = missing_count
      !> Most maxima and points of the section kept of each
      integer :: kept = missing_count
   contains
      procedure :: check => check_points
      procedure :: columns => columns_of_grid
      procedure :: list => list_points
   end type points_settings_type

contains

   !> Refuse parameters and histories without a meaning; keep an earlier error.
   subroutine check_points(self, place, histories, error)
      class(points_settings_type), intent(in) :: self
      !> File and section, for messages
      character(len=*), intent(in) :: place
      type(block_history_type), intent(in) :: histories(:)
      type(error_type), allocatable, intent(inout) :: error
      type(block_parameters_type) :: corner
      integer :: i

      do i = 1, 2
         corner = block_parameters_type(epsilon=self%epsilon%window(i), tau=self%tau%window(i), &
                                        xi=self%xi%window(i), gamma=self%gamma%window(i), &
                                        law=self%law, own=self%own)
         call corner%check(place, error)
      end do
      call check_choice(error, place, "sweep", self%sweep, ["none", "up  ", "down"])
      call check_count(error, place, "number of histories", size(histories), at_least=1)
      do i = 1, size(histories)
         call histories(i)%check(place, error)
      end do
   end subroutine check_points

   !> Points in a line of the grid.
   pure integer function columns_of_grid(self) result(columns)
      class(points_settings_type), intent(in) :: self

      columns = size(values_on(self%epsilon))
   end function columns_of_grid

   !> All points: epsilon runs fastest, then tau, xi, gamma, and histories slowest; those of a sweep
   !> in its order.
   pure function list_points(self, histories) result(points)
      class(points_settings_type), intent(in) :: self
      type(block_history_type), intent(in) :: histories(:)
      type(point_type), allocatable :: points(:)
      real(wp), allocatable :: epsilon(:), gamma(:), tau(:), xi(:)
      integer :: g, i, j, k, x

      epsilon = values_on(self%epsilon)
      tau = values_on(self%tau)
      xi = values_on(self%xi)
      gamma = values_on(self%gamma)
      points = [(((((point_type(block_parameters_type(epsilon=epsilon(i), tau=tau(j), xi=xi(x), &
                                                      gamma=gamma(g), law=self%law, &
                                                      own=self%own), histories(k)), &
                     i=1, size(epsilon)), j=1, size(tau)), x=1, size(xi)), g=1, size(gamma)), &
                 k=1, size(histories))]
      if (self%sweep == "down") points = points(size(points):1:-1)
   end function list_points

   !> The values on an axis that are computed.
   pure function values_on(axis) result(values)
      type(axis_type), intent(in) :: axis
      real(wp) :: values(axis%part(2) - axis%part(1) + 1)
      real(wp) :: share(size(values))
      integer :: i

      share = [(real(i - 1, wp)/max(1, axis%count - 1), i=axis%part(1), axis%part(2))]
      values = (1.0_wp - share)*axis%window(1) + share*axis%window(2)
   end function values_on
end module points_input
