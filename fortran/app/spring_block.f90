! SPDX-License-Identifier: BSD-3-Clause
!> The program: `spring_block COMMAND NAMELIST OUTPUT`. Each command is a file beside this one.
program spring_block_program
   use attractors_command, only: run_attractors
   use cycles_command, only: run_cycles
   use exponents_command, only: run_exponents
   use hopf_command, only: run_hopf
   use linear_stability_command, only: run_linear_stability
   use measure_command, only: run_measure
   use program_arguments, only: command_type, run_command
   use slip_events_command, only: run_slip_events
   use spectrum_command, only: run_spectrum
   use synchrony_command, only: run_synchrony
   use trajectory_command, only: run_trajectory
   implicit none (type, external)

   call run_command([ &
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
                                 "Errors and costs of several methods on given cases")])
end program spring_block_program
