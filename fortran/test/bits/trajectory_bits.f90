! SPDX-License-Identifier: BSD-3-Clause
!> Trajectories to the last bit, so that those of different compilers can be compared
!> (tools/compilers/run): a line a sample with case, time, theta, u and ln v, numbers as the
!> hexadecimal digits of their bits.
program trajectory_bits
   use, intrinsic :: iso_fortran_env, only: output_unit
   use block_builder, only: build_block, index_of_ln_v, index_of_theta, index_of_u
   use dde, only: integrate, integration_options, integration_result, table_sampler
   use dde_errors, only: error_type
   use dde_kinds, only: int64, wp
   implicit none (type, external)
   !> Samples of each case, and the tolerance of all.
   integer, parameter :: samples = 200
   real(wp), parameter :: tolerance = 1.0e-9_wp

   ! a cycle, chaos, stick, and slips without a delay at gamma = 1e12
   call print_case("cycle", [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], 1000.0_wp, "explicit")
   call print_case("chaos", [7.0_wp, 0.7_wp, 0.5_wp, 0.8_wp], 400.0_wp, "explicit")
   call print_case("cycle", [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], 1000.0_wp, "taylor")
   call print_case("chaos", [7.0_wp, 0.7_wp, 0.5_wp, 0.8_wp], 400.0_wp, "taylor")
   call print_case("cycle", [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], 1000.0_wp, "radau5")
   call print_case("cycle", [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], 1000.0_wp, "radau9")
   call print_case("cycle", [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], 1000.0_wp, "radau13")
   call print_case("chaos", [7.0_wp, 0.7_wp, 0.5_wp, 0.8_wp], 400.0_wp, "radau13")
   call print_case("stick", [10.0_wp, 0.9_wp, 0.8_wp, 0.8_wp], 400.0_wp, "radau9")
   call print_case("cycle", [10.0_wp, 0.5_wp, 0.8_wp, 0.8_wp], 1000.0_wp, "auto")
   call print_case("stick", [10.0_wp, 0.9_wp, 0.8_wp, 0.8_wp], 400.0_wp, "auto")
   call print_case("slips", [0.0_wp, 0.7_wp, 0.5_wp, 1.0e12_wp], 100.0_wp, "auto")

contains

   !> Integrate a case and print its samples.
   subroutine print_case(name, parameters, t_end, method)
      character(len=*), intent(in) :: name
      !> Delay, epsilon, xi and gamma
      real(wp), intent(in) :: parameters(4), t_end
      character(len=*), intent(in) :: method
      integer :: i
      type(error_type), allocatable :: error
      type(integration_options) :: options
      type(integration_result) :: outcome
      type(table_sampler) :: table

      options = integration_options(method=method, relative=tolerance, absolute=tolerance)
      table = table_sampler([index_of_theta, index_of_u, index_of_ln_v], &
                            [(i*t_end/samples, i=0, samples)])
      call integrate(build_block(tau=parameters(1), epsilon=parameters(2), xi=parameters(3), &
                                 gamma=parameters(4), v=1.1_wp), &
                     0.0_wp, t_end, options, outcome, error, table)
      if (allocated(error)) error stop "trajectory_bits: "//error%message
      do i = 1, table%received
         write (output_unit, "(4a, 4(1x, z16.16))") name, " by ", method, ":", &
            bits(table%time(i)), bits(table%values(:, i))
      end do
   end subroutine print_case

   !> The bits of a number.
   elemental integer(int64) function bits(number) result(digits)
      real(wp), intent(in) :: number

      digits = transfer(number, 0_int64)
   end function bits
end program trajectory_bits
