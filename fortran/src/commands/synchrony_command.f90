! SPDX-License-Identifier: BSD-3-Clause
!> The growth of disturbances of chains that move as one block, by the stiffness of their modes.
module synchrony_command
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use lyapunov_spectrum, only: growth_settings_type
   use request, only: request_type
   use results, only: results_type
   use scene_request, only: scene_settings_type, scene_type
   use transverse_growth, only: find_zeros, measure_transverse_growth, transverse_growth_type, &
                                zero_type
   use transverse_multipliers, only: find_transverse_cycle, transverse_cycle_type
   use value_checks, only: check_count, check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: run_synchrony

   !> Parts of the way between two values of s for multipliers, which cost less
   integer, parameter :: parts_between = 10

   !> What is measured.
   type :: synchrony_settings_type
      !> Least and largest s = 1 + kappa mu
      real(wp) :: s_window(2) = missing
      !> Values of s, evenly spaced in ln s
      integer :: count = missing_count
      !> Time at which measuring ends
      real(wp) :: t_end = missing
      !> Time before measuring in which the vectors turn
      real(wp) :: t_turning = missing
      !> Longest time between two orthonormalisations
      real(wp) :: interval = missing
      !> Number of batches of the time
      integer :: batches = missing_count
   contains
      !> The values of s, and those between
      procedure :: values
   end type synchrony_settings_type

contains

   !> Run the command.
   subroutine run_synchrony(given, data, error)
      class(request_type), intent(inout) :: given
      class(results_type), intent(inout), target :: data
      type(error_type), allocatable, intent(out) :: error
      type(growth_settings_type) :: how
      type(scene_type) :: scene
      type(synchrony_settings_type) :: settings
      type(transverse_cycle_type) :: on_cycle
      type(transverse_growth_type), allocatable :: growth(:)
      type(zero_type), allocatable :: zeros(:)

      call read_synchrony(given, scene, settings, error)
      if (allocated(error)) return
      call given%progress%begin("synchrony of "//trim(scene%name))
      how = growth_settings_type(t_begin=scene%t_transient, t_end=settings%t_end, &
                                 t_turning=settings%t_turning, interval=settings%interval, &
                                 batches=settings%batches)
      call measure_transverse_growth(scene%problem, settings%values(1), how, scene%options(), &
                                     growth, error, given%progress)
      if (allocated(error)) return
      call find_zeros(scene%problem, how, scene%options(), growth, zeros, error)
      if (allocated(error)) return
      call find_transverse_cycle(scene%problem, settings%t_end, scene%options(), &
                                 settings%values(parts_between), on_cycle)
      call put_synchrony(data, scene, settings, growth, zeros, on_cycle)
   end subroutine run_synchrony

   !> The values of s, and those between.
   pure function values(self, parts) result(s)
      class(synchrony_settings_type), intent(in) :: self
      !> Parts of the way between two values, 1 for these values alone
      integer, intent(in) :: parts
      real(wp) :: s((self%count - 1)*parts + 1)
      integer :: i

      associate (ends => log(self%s_window), steps => (self%count - 1)*parts)
         s = [(exp(ends(1) + (ends(2) - ends(1))*i/steps), i=0, steps)]
      end associate
   end function values

   !> Read and check a scene and what is measured.
   subroutine read_synchrony(given, opened, synchrony, error)
      class(request_type), intent(inout) :: given
      !> The scene, a chain of one block with kappa = 1
      type(scene_type), intent(out) :: opened
      type(synchrony_settings_type), intent(out) :: synchrony
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(scene_settings_type) :: scene
      namelist /settings/ scene, synchrony

      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      write (given%copy, nml=settings, delim="quote")
      call given%check(error)
      call opened%open(given, scene, error)
      associate (window => synchrony%s_window)
         call check_number(error, given%place, "synchrony%s_window(1)", window(1), at_least=1.0_wp)
         call check_number(error, given%place, "synchrony%s_window(2)", window(2), above=window(1))
      end associate
      call check_count(error, given%place, "synchrony%count", synchrony%count, at_least=2)
      call check_count(error, given%place, "synchrony%batches", synchrony%batches, at_least=2)
      if (allocated(error)) return
      if (.not. opened%problem%is_chain()) then
         call raise(error, given%place//"the equations of the model have no second_difference; " &
                    //"expected a chain")
      else if (scene%model%blocks > 1) then
         call raise(error, given%place//"blocks = "//text(scene%model%blocks) &
                    //"; expected a chain of 1 block: chains that move as one block are tried")
      end if
   end subroutine read_synchrony

   !> The exponents.
   subroutine put_synchrony(data, scene, settings, growth, zeros, on_cycle)
      class(results_type), intent(inout) :: data
      type(scene_type), intent(in) :: scene
      type(synchrony_settings_type), intent(in) :: settings
      !> Exponents by s
      type(transverse_growth_type), intent(in) :: growth(:)
      !> Where they are zero
      type(zero_type), intent(in) :: zeros(:)
      !> Exponents by multipliers, where the motion is a cycle
      type(transverse_cycle_type), intent(in) :: on_cycle
      integer :: rows

      call data%attribute("title", "Growth of disturbances of chains that move as one block")
      call scene%put(data)
      call data%attribute("t_transient", scene%t_transient)
      call data%attribute("t_end", settings%t_end)
      call data%attribute("t_turning", settings%t_turning)
      call data%attribute("interval", settings%interval)
      call data%attribute("tolerance", scene%tolerance)
      call data%attribute("method", trim(scene%method))
      if (on_cycle%reason == "") then
         call data%attribute("period", on_cycle%period)
      else
         call data%attribute("no_multipliers", on_cycle%reason)
      end if
      rows = data%dimension("s", size(growth))
      call data%column(rows, "s", growth%s, "1 + kappa times the eigenvalue of the mode")
      call data%column(rows, "exponent", growth%value, "largest exponent of its disturbances")
      call data%column(rows, "error", growth%error, "its standard error")
      rows = data%dimension("zero", size(zeros), "zero_s", "zero_")
      call data%column(rows, "s", zeros%s, "s at which the exponent is zero")
      call data%column(rows, "error", zeros%error, "its standard error")
      call data%answers(rows, "rises", zeros%rises, "whether the exponent grows with s")
      rows = data%dimension("floquet_s", size(on_cycle%growth), prefix="floquet_")
      call data%column(rows, "s", on_cycle%growth%s, "s, where multipliers were found")
      call data%column(rows, "exponent", on_cycle%growth%value, &
                       "largest exponent by Floquet multipliers of the cycle")
      call data%column(rows, "error", on_cycle%growth%error, "its difference between two meshes")
      rows = data%dimension("floquet_zero", size(on_cycle%zeros), "floquet_zero_s", "floquet_zero_")
      call data%column(rows, "s", on_cycle%zeros%s, &
                       "s at which the exponent by multipliers is zero")
      call data%column(rows, "error", on_cycle%zeros%error, "its difference between two meshes")
      call data%answers(rows, "rises", on_cycle%zeros%rises, &
                        "whether the exponent by multipliers grows with s")
   end subroutine put_synchrony
end module synchrony_command
