! SPDX-License-Identifier: BSD-3-Clause
!> Points at which attractors are looked for, from the section `points` of a namelist: a grid in at
!> most two parameters and a list of histories, or a sweep along one parameter.
module points_request
   use attractor_points, only: point_type
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_description, only: model_length => word_length
   use model_history, only: history_type
   use model_problem, only: model_type
   use model_settings, only: model_settings_type
   use request, only: request_type, word_length
   use value_checks, only: check_choice, check_count, missing_count
   implicit none (type, external)
   private
   public :: points_settings_type

   !> Evenly spaced values of one parameter, of which a part is computed.
   type :: axis_type
      !> Name of the parameter; blank where there is no axis
      character(len=model_length) :: along = ""
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
      !> The model with its parameters; those of the axes may be left out
      type(model_settings_type) :: model
      !> Axes of the grid
      type(axis_type) :: axes(2)
      !> Whether each point starts where the one before ended: "none", "up" or "down"
      character(len=word_length) :: sweep = ""
      !> Every 2**refinements-th line along both axes is computed in full
      integer :: refinements = missing_count
      !> Most maxima and points of the section kept of each
      integer :: kept = missing_count
   contains
      procedure :: open => open_points
      procedure :: columns => columns_of_grid
      procedure :: list => list_points
   end type points_settings_type

contains

   !> Open the model at the first corner of the grid. Refuse parameters without a meaning at both
   !> corners; keep an earlier error.
   subroutine open_points(self, given, model, error)
      class(points_settings_type), intent(in) :: self
      class(request_type), intent(in) :: given
      type(model_type), intent(out) :: model
      type(error_type), allocatable, intent(inout) :: error
      type(model_settings_type) :: corner
      character(len=:), allocatable :: place
      integer :: i, j

      place = given%place//"points: "
      do i = 2, 1, -1
         corner = self%model
         do j = 1, size(self%axes)
            call corner%put(trim(self%axes(j)%along), self%axes(j)%window(i))
         end do
         if (.not. allocated(error)) call corner%open(place, model, error, opened=given%model)
      end do
      call check_count(error, place, "refinements", self%refinements, at_least=0)
      call check_count(error, place, "kept", self%kept, at_least=0, at_most=100000)
      call check_choice(error, place, "sweep", self%sweep, ["none", "up  ", "down"])
   end subroutine open_points

   !> Points in a line of the grid.
   pure integer function columns_of_grid(self) result(columns)
      class(points_settings_type), intent(in) :: self

      columns = size(values_on(self%axes(1)))
   end function columns_of_grid

   !> All points: the first axis runs fastest, then the second, and histories slowest; those of a
   !> sweep in its order.
   function list_points(self, model, history) result(points)
      class(points_settings_type), intent(in) :: self
      type(model_type), intent(in) :: model
      type(history_type), intent(in) :: history
      type(point_type), allocatable :: points(:)
      real(wp), allocatable :: x(:), y(:)
      integer :: along(2), i, j, k

      x = values_on(self%axes(1))
      y = values_on(self%axes(2))
      along = [(model%number_of(self%axes(i)%along), i=1, 2)]
      points = [(((point_at(x(i), y(j), k), i=1, size(x)), j=1, size(y)), k=1, history%count())]
      if (self%sweep == "down") points = points(size(points):1:-1)

   contains

      !> The point with these values on the axes and a history.
      type(point_type) function point_at(x, y, number) result(point)
         real(wp), intent(in) :: x, y
         integer, intent(in) :: number

         point%numbers = model%numbers
         if (along(1) > 0) point%numbers(along(1)) = x
         if (along(2) > 0) point%numbers(along(2)) = y
         point%history = number
         point%past = history%past(model, number)
      end function point_at
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
end module points_request
