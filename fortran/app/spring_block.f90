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
   use velocity_step_command, only: run_velocity_step
   implicit none (type, external)

   call run_command([ &
                     command_type("trajectory", "Trajectory of a scene, or of a chain of blocks", run_trajectory), &
                     command_type("spectrum", "Power spectrum of v over a trajectory, with its peaks labelled", run_spectrum), &
                     command_type("slip_events", "Slip events of the blocks of a scene", run_slip_events), &
                     command_type("exponents", "Lyapunov exponents of a scene", run_exponents), &
                     command_type("attractors", "Attractors on a grid of parameters, with their classes", run_attractors), &
                     command_type("hopf", "Hopf curves in a plane of parameters, and their special points", run_hopf), &
                     command_type("linear_stability", "Roots and linear stability of steady sliding", run_linear_stability), &
                     command_type("cycles", "Cycles along a line of parameters, and curves of their special points", run_cycles), &
                     command_type("synchrony", "Growth of disturbances of chains that move as one block", run_synchrony), &
                     command_type("velocity_step", "Response of friction to steps of the velocity", run_velocity_step), &
                     command_type("measure", "Errors and costs of several methods on given cases", run_measure) &
                    ])
end program spring_block_program
