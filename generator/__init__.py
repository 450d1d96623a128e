"""Makes a Fortran module of a delay-differential model from its definition; see README.md."""
