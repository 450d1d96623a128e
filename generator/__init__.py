# SPDX-License-Identifier: BSD-3-Clause
"""Makes a Fortran module of a delay-differential model from its definition; see README.md."""

__version__ = "0.1.0"
"""Version of the generator and of the methods in fortran/src/methods."""
