! SPDX-License-Identifier: BSD-3-Clause
!> Methods for callers in C: the commands of the program, with results in memory.
module delaykit_methods
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_loc, c_ptr
   use attractors_command, only: run_attractors
   use cycles_command, only: run_cycles
   use dde_errors, only: error_type, raise
   use delaykit_handles, only: message_of, string_of
   use exponents_command, only: run_exponents
   use hopf_command, only: run_hopf
   use linear_stability_command, only: run_linear_stability
   use output_file, only: place_of
   use results, only: results_type
   implicit none (type, external)
   private

contains

   !> Run a command; 0 if it succeeded, else 1 with a message.
   integer(c_int) function dk_command(name, namelist, result, message, length) result(status) &
      bind(c)
      !> Name of the command, and path of its namelist
      type(c_ptr), value :: name, namelist
      !> The results
      type(c_ptr), intent(out) :: result
      !> Room for a message and its size
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int), value :: length
      type(error_type), allocatable :: error
      type(results_type), pointer :: found
      character(len=:), allocatable :: path, place

      allocate (found)
      result = c_loc(found)
      path = string_of(namelist)
      place = place_of(result)
      select case (string_of(name))
      case ("attractors")
         call run_attractors(path, place, error)
      case ("cycles")
         call run_cycles(path, place, error)
      case ("exponents")
         call run_exponents(path, place, error)
      case ("hopf")
         call run_hopf(path, place, error)
      case ("linear_stability")
         call run_linear_stability(path, place, error)
      case default
         call raise(error, "the command '"//string_of(name)//"'; expected one of: attractors, " &
                    //"cycles, exponents, hopf, linear_stability")
      end select
      status = message_of(error, message, length)
   end function dk_command
end module delaykit_methods
