! SPDX-License-Identifier: BSD-3-Clause
!> All commands, for the program and for callers of the library.
module all_commands
   use attractors_command, only: run_attractors
   use command, only: command_type
   use cycles_command, only: run_cycles
   use exponents_command, only: run_exponents
   use hopf_command, only: run_hopf
   use linear_stability_command, only: run_linear_stability
   use measure_command, only: run_measure
   use slip_events_command, only: run_slip_events
   use spectrum_command, only: run_spectrum
   use synchrony_command, only: run_synchrony
   use trajectory_command, only: run_trajectory
   implicit none (type, external)
   private
   public :: list_commands

contains

   !> Each command with what it makes.
   function list_commands() result(list)
      type(command_type), allocatable :: list(:)

      list = [ &
             command_type("trajectory", run_trajectory, &
                          "Trajectory of a scene, or of a chain of blocks"), &
             command_type("spectrum", run_spectrum, &
                          "Power spectrum of the signal of a trajectory, with its peaks"), &
             command_type("slip_events", run_slip_events, &
                          "Events of the blocks of a scene"), &
             command_type("exponents", run_exponents, &
                          "Lyapunov exponents of a scene"), &
             command_type("attractors", run_attractors, &
                          "Attractors on a grid, with their classes"), &
             command_type("hopf", run_hopf, &
                          "Hopf curves in a plane, and their special points"), &
             command_type("linear_stability", run_linear_stability, &
                          "Roots and linear stability of a model at rest"), &
             command_type("cycles", run_cycles, &
                          "Cycles along a line, and curves of their special points"), &
             command_type("synchrony", run_synchrony, &
                          "Growth of disturbances of chains that move as one block"), &
             command_type("measure", run_measure, &
                          "Errors and costs of several methods on given cases")]
   end function list_commands
end module all_commands
