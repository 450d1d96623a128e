!> Points at which attractors are looked for, from the section `points` of a namelist: a grid in at
!> most two parameters and a list of histories, or a sweep along one parameter.
module points_input
   use attractor_points, only: point_type
   use block_parameters, only: block_history_type, block_parameters_type, missing_parameters
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_description, only: law_length => word_length
   use namelist_input, only: word_length
   use value_checks, only: check_choice, check_count, missing_count
   implicit none (type, external)
   private
   public :: points_settings_type

   !> Evenly spaced values of one parameter, of which a part is computed.
   type :: axis_type
      !> Name of the parameter; blank where there is no axis
      character(len=law_length) :: along = ""
      !> First and last value
      real(wp) :: window(2) = 0.0_wp
      !> Number of values; the first alone when 1
      integer :: count = 1
      !> First and last that are computed, from 1
      integer :: part(2) = 1
   end type axis_type

   !> Where attractors are looked for, and what is kept of each.
   type :: points_settings_type
      !> Name of what the points belong to
      character(len=word_length) :: name = ""
      !> Parameters; those of the axes may be left out
      type(block_parameters_type) :: parameters = missing_parameters
      !> Axes of the grid
      type(axis_type) :: axes(2)
      !> Whether each point starts where the one before ended: "none", "up" or "down"
      character(len=word_length) :: sweep = ""
      !> Every 2**refinements-th line in epsilon and tau is computed in full
      integer :: refinements = missing_count
      !> Most maxima and points of the section kept of each
      integer :: kept = missing_count
   contains
      procedure :: at => parameters_at
      procedure :: check => check_points
      procedure :: columns => columns_of_grid
      procedure :: list => list_points
   end type points_settings_type

contains

   !> The parameters with these values on the axes.
   pure type(block_parameters_type) function parameters_at(self, x, y) result(parameters)
      class(points_settings_type), intent(in) :: self
      !> Values on the first and on the second axis
      real(wp), intent(in) :: x, y

      parameters = self%parameters
      call parameters%put(trim(self%axes(1)%along), x)
      call parameters%put(trim(self%axes(2)%along), y)
   end function parameters_at

   !> Refuse parameters and histories without a meaning; keep an earlier error.
   subroutine check_points(self, place, histories, error)
      class(points_settings_type), intent(inout) :: self
      !> File and section, for messages
      character(len=*), intent(in) :: place
      type(block_history_type), intent(in) :: histories(:)
      type(error_type), allocatable, intent(inout) :: error
      type(block_parameters_type) :: corner
      integer :: i

      do i = 1, 2
         corner = self%at(self%axes(1)%window(i), self%axes(2)%window(i))
         call corner%check(place, error)
      end do
      self%parameters = corner
      call check_choice(error, place, "sweep", self%sweep, ["none", "up  ", "down"])
      call check_count(error, place, "number of histories", size(histories), at_least=1)
      do i = 1, size(histories)
         call histories(i)%check(place, error)
      end do
   end subroutine check_points

   !> Points in a line of the grid.
   pure integer function columns_of_grid(self) result(columns)
      class(points_settings_type), intent(in) :: self

      columns = size(values_on(self%axes(1)))
   end function columns_of_grid

   !> All points: the first axis runs fastest, then the second, and histories slowest; those of a
   !> sweep in its order.
   pure function list_points(self, histories) result(points)
      class(points_settings_type), intent(in) :: self
      type(block_history_type), intent(in) :: histories(:)
      type(point_type), allocatable :: points(:)
      real(wp), allocatable :: x(:), y(:)
      integer :: i, j, k

      x = values_on(self%axes(1))
      y = values_on(self%axes(2))
      points = [(((point_type(self%at(x(i), y(j)), histories(k)), i=1, size(x)), j=1, size(y)), &
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
