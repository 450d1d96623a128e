"""The configuration as namelists of the Fortran programs."""
