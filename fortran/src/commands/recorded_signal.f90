! SPDX-License-Identifier: BSD-3-Clause
!> The signal of a trajectory.
module recorded_signal
   use dde_kinds, only: wp
   implicit none (type, external)
   private
   public :: signal_type

   !> The signal of a trajectory.
   type :: signal_type
      !> Name of the scene
      character(len=64) :: scene = ""
      !> Longest time between samples
      real(wp) :: sample_interval = 0.0_wp
      !> Time up to which the transient lasts
      real(wp) :: t_transient = 0.0_wp
      !> Times of the samples, from t = 0 on
      real(wp), allocatable :: t(:)
      !> Name of the signal, and its values
      character(len=64) :: signal = ""
      real(wp), allocatable :: v(:)
      !> Where times are uneven, the state that grows by the integral of the signal less
      !> `slope_at_rest` times the time
      real(wp), allocatable :: u(:)
      real(wp) :: slope_at_rest = 0.0_wp
   end type signal_type
end module recorded_signal
