! SPDX-License-Identifier: BSD-3-Clause
!> What the program `synchrony` reads and writes: a scene and the modes of chains that are tried;
!> whether their disturbances grow.
module synchrony_files
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use namelist_input, only: namelist_file_type
   use output_file, only: output_file_type
   use scene_input, only: scene_settings_type, scene_type
   use transverse_growth, only: transverse_growth_type, zero_type
   use transverse_multipliers, only: transverse_cycle_type
   use value_checks, only: check_count, check_number, missing, missing_count
   implicit none (type, external)
   private
   public :: read_synchrony, synchrony_settings_type, write_synchrony

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
   subroutine read_synchrony(path, opened, synchrony, error)
      character(len=*), intent(in) :: path
      !> The scene, a chain of one block with kappa = 1
      type(scene_type), intent(out) :: opened
      type(synchrony_settings_type), intent(out) :: synchrony
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(namelist_file_type) :: file
      type(scene_settings_type) :: scene
      namelist /settings/ scene, synchrony

      call file%open(path)
      read (file%unit, nml=settings, iostat=file%status, iomsg=file%reason)
      write (file%copy, nml=settings, delim="quote")
      call file%close(error)
      call opened%open(path, scene, error)
      associate (window => synchrony%s_window)
         call check_number(error, path, "synchrony%s_window(1)", window(1), at_least=1.0_wp)
         call check_number(error, path, "synchrony%s_window(2)", window(2), above=window(1))
      end associate
      call check_count(error, path, "synchrony%count", synchrony%count, at_least=2)
      call check_count(error, path, "synchrony%batches", synchrony%batches, at_least=2)
      if (allocated(error)) return
      if (scene%model%blocks > 1 .or. .not. opened%problem%is_chain()) then
         call raise(error, path//": blocks = "//text(scene%model%blocks) &
                    //"; expected a chain of 1 block: chains that move as one block are tried")
      end if
   end subroutine read_synchrony

   !> Write the exponents.
   subroutine write_synchrony(path, scene, settings, growth, zeros, on_cycle, error)
      character(len=*), intent(in) :: path
      type(scene_type), intent(in) :: scene
      type(synchrony_settings_type), intent(in) :: settings
      !> Exponents by s
      type(transverse_growth_type), intent(in) :: growth(:)
      !> Where they are zero
      type(zero_type), intent(in) :: zeros(:)
      !> Exponents by multipliers, where the motion is a cycle
      type(transverse_cycle_type), intent(in) :: on_cycle
      !> Error if the file could not be written
      type(error_type), allocatable, intent(out) :: error
      type(output_file_type) :: file
      integer :: rows

      call file%create(path, "Growth of disturbances of chains that move as one block")
      call scene%put(file)
      call file%attribute("t_transient", scene%t_transient)
      call file%attribute("t_end", settings%t_end)
      call file%attribute("t_turning", settings%t_turning)
      call file%attribute("interval", settings%interval)
      call file%attribute("tolerance", scene%tolerance)
      call file%attribute("method", trim(scene%method))
      if (on_cycle%reason == "") then
         call file%attribute("period", on_cycle%period)
      else
         call file%attribute("no_multipliers", on_cycle%reason)
      end if
      rows = file%dimension("s", size(growth))
      call file%column(rows, "s", growth%s, "1 + kappa times the eigenvalue of the mode")
      call file%column(rows, "exponent", growth%value, "largest exponent of its disturbances")
      call file%column(rows, "error", growth%error, "its standard error")
      rows = file%dimension("zero", size(zeros), "zero_s", "zero_")
      call file%column(rows, "s", zeros%s, "s at which the exponent is zero")
      call file%column(rows, "error", zeros%error, "its standard error")
      call file%answers(rows, "rises", zeros%rises, "whether the exponent grows with s")
      rows = file%dimension("floquet_s", size(on_cycle%growth), prefix="floquet_")
      call file%column(rows, "s", on_cycle%growth%s, "s, where multipliers were found")
      call file%column(rows, "exponent", on_cycle%growth%value, &
                       "largest exponent by Floquet multipliers of the cycle")
      call file%column(rows, "error", on_cycle%growth%error, "its difference between two meshes")
      rows = file%dimension("floquet_zero", size(on_cycle%zeros), "floquet_zero_s", "floquet_zero_")
      call file%column(rows, "s", on_cycle%zeros%s, &
                       "s at which the exponent by multipliers is zero")
      call file%column(rows, "error", on_cycle%zeros%error, "its difference between two meshes")
      call file%answers(rows, "rises", on_cycle%zeros%rises, &
                        "whether the exponent by multipliers grows with s")
      call file%finish(error)
   end subroutine write_synchrony
end module synchrony_files
