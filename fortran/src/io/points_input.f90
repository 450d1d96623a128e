!> Points at which attractors are looked for, from the section `points` of a namelist: a grid in the
!> four parameters of the block and a list of histories, or a sweep along one parameter.
module points_input
   use attractor_points, only: point_type
   use block_parameters, only: block_history_type, block_parameters_type, check_quantity
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use namelist_input, only: word_length
   use value_checks, only: check_choice, check_count, check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: check_points, points_settings_type

   !> Most points in all.
   integer, parameter :: most_points = 1000000
   !> Most maxima and points of the section kept of each.
   integer, parameter :: most_kept = 100000
   !> Most refinements: every 16th line is computed first.
   integer, parameter :: most_refinements = 4
   !> Longest name.
   integer, parameter :: longest_name = 128
   !> Directions of a sweep.
   character(len=*), parameter :: directions(3) = ["none", "up  ", "down"]

   !> Names of the axes in the order of the grid, the first runs fastest, and their numbers.
   character(len=*), parameter :: names(4) = ["epsilon", "tau    ", "xi     ", "gamma  "]
   enum, bind(c)
      enumerator :: of_epsilon = 1, of_tau, of_xi, of_gamma
   end enum

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
      !> Whether each point starts where the one before ended: "none", "up" or "down"
      character(len=word_length) :: sweep = ""
      !> Every 2**refinements-th line in epsilon and tau is computed in full
      integer :: refinements = missing_count
      !> Most maxima and points of the section kept of each
      integer :: kept = missing_count
   contains
      !> All points
      procedure :: list => list_points
      !> Points in a line of the grid
      procedure :: columns => columns_of_grid
      !> Axes in the order of `names`
      procedure, private :: axes => axes_of_grid
   end type points_settings_type

contains

   !> Refuse points that cannot be computed or stored; keep an earlier error.
   pure subroutine check_points(place, points, histories, error)
      !> File and section, for messages
      character(len=*), intent(in) :: place
      !> The points
      type(points_settings_type), intent(in) :: points
      !> Values for t <= 0
      type(block_history_type), intent(in) :: histories(:)
      !> First error met
      type(error_type), allocatable, intent(inout) :: error
      type(axis_type) :: axes(size(names))
      integer :: i

      if (allocated(error)) return
      axes = points%axes()
      call check_count(error, place, "letters of name", len_trim(points%name), at_least=1, &
                       at_most=longest_name)
      call check_count(error, place, "kept", points%kept, at_least=0, at_most=most_kept)
      do i = 1, size(axes)
         call check_axis(error, place, trim(names(i)), axes(i))
      end do
      call check_count(error, place, "number of histories", size(histories), at_least=1)
      do i = 1, size(histories)
         call histories(i)%check(place//": history "//text(i), error)
      end do
      if (allocated(error)) return
      call check_number(error, place, "number of points", &
                        product([real(size(histories), wp), real(length(axes), wp)]), &
                        at_most=real(most_points, wp))
      call check_sweep(error, place, points%sweep, axes, size(histories))
      call check_refinements(error, place, points, axes, size(histories))
   end subroutine check_points

   !> The axes in the order of `names`.
   pure function axes_of_grid(self) result(axes)
      class(points_settings_type), intent(in) :: self
      type(axis_type) :: axes(size(names))

      axes = [self%epsilon, self%tau, self%xi, self%gamma]
   end function axes_of_grid

   !> Points in a line of the grid.
   pure integer function columns_of_grid(self) result(columns)
      class(points_settings_type), intent(in) :: self

      columns = length(self%epsilon)
   end function columns_of_grid

   !> All points: epsilon runs fastest, then tau, xi, gamma, and histories slowest; those of a sweep
   !> in its order.
   pure function list_points(self, histories) result(points)
      class(points_settings_type), intent(in) :: self
      !> Values for t <= 0
      type(block_history_type), intent(in) :: histories(:)
      type(point_type), allocatable :: points(:)
      type(axis_type) :: axes(size(names))
      integer :: from(size(names)), g, i, j, k, to(size(names)), x

      axes = self%axes()
      from = [(axes(i)%part(1), i=1, size(axes))]
      to = [(axes(i)%part(2), i=1, size(axes))]
      points = [(((((point_type( &
                     block_parameters_type(epsilon=value_at(axes(of_epsilon), i), &
                                           tau=value_at(axes(of_tau), j), &
                                           xi=value_at(axes(of_xi), x), &
                                           gamma=value_at(axes(of_gamma), g)), &
                     histories(k)), &
                     i=from(of_epsilon), to(of_epsilon)), j=from(of_tau), to(of_tau)), &
                  x=from(of_xi), to(of_xi)), g=from(of_gamma), to(of_gamma)), &
                 k=1, size(histories))]
      if (self%sweep == "down") points = points(size(points):1:-1)
   end function list_points

   !> Number of values of an axis that are computed.
   elemental integer function length(axis) result(values)
      type(axis_type), intent(in) :: axis

      values = axis%part(2) - axis%part(1) + 1
   end function length

   !> A value on an axis.
   pure real(wp) function value_at(axis, i) result(value)
      type(axis_type), intent(in) :: axis
      !> Which, from 1
      integer, intent(in) :: i

      associate (share => real(i - 1, wp)/max(1, axis%count - 1))
         value = (1.0_wp - share)*axis%window(1) + share*axis%window(2)
      end associate
   end function value_at

   !> Refuse values out of range, and a part of the axis that is not in it.
   pure subroutine check_axis(error, place, name, axis)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), intent(in) :: place
      character(len=*), intent(in) :: name
      type(axis_type), intent(in) :: axis
      integer :: i

      do i = 1, 2
         call check_quantity(error, place, name, axis%window(i), name//"%window")
      end do
      call check_count(error, place, name//"%count", axis%count, at_least=1)
      if (allocated(error)) return
      if (1 <= axis%part(1) .and. axis%part(1) <= axis%part(2) &
          .and. axis%part(2) <= axis%count) return
      call raise(error, place//": "//name//"%part = "//text(axis%part(1))//", " &
                 //text(axis%part(2))//"; expected first and last, 1 <= first <= last <= " &
                 //text(axis%count))
   end subroutine check_axis

   !> Refuse an unknown direction, and a sweep along two parameters or from two histories.
   pure subroutine check_sweep(error, place, sweep, axes, histories)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), intent(in) :: place
      character(len=*), intent(in) :: sweep
      type(axis_type), intent(in) :: axes(:)
      integer, intent(in) :: histories

      call check_choice(error, place, "sweep", sweep, directions)
      if (allocated(error) .or. sweep == "none") return
      if (count(length(axes) > 1) > 1) then
         call raise(error, place//": sweep = '"//trim(sweep)//"' along " &
                    //text(count(length(axes) > 1))//" parameters; expected at most one")
      else if (histories > 1) then
         call raise(error, place//": sweep = '"//trim(sweep)//"' from "//text(histories) &
                    //" histories; expected one")
      end if
   end subroutine check_sweep

   !> Refuse refinements of what is no plane of epsilon and tau from one history.
   pure subroutine check_refinements(error, place, points, axes, histories)
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), intent(in) :: place
      type(points_settings_type), intent(in) :: points
      type(axis_type), intent(in) :: axes(:)
      integer, intent(in) :: histories
      character(len=:), allocatable :: unfit

      call check_count(error, place, "refinements", points%refinements, at_least=0, &
                       at_most=most_refinements)
      if (allocated(error) .or. points%refinements == 0) return
      if (points%sweep /= "none") then
         unfit = "in a sweep"
      else if (histories > 1) then
         unfit = "from "//text(histories)//" histories"
      else if (any(axes([of_epsilon, of_tau])%count == 1)) then
         unfit = "along one line"
      else if (any(length(axes([of_xi, of_gamma])) > 1)) then
         unfit = "along xi or gamma"
      else
         return
      end if
      call raise(error, place//": refinements = "//text(points%refinements)//" "//unfit &
                 //"; expected 0, or a plane of epsilon and tau from one history")
   end subroutine check_refinements
end module points_input
