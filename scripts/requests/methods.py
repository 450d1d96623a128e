"""The methods of the solver."""

import re
from pathlib import Path

TABLE = Path(__file__).parents[2] / "fortran" / "dde" / "src" / "loop" / "dde_methods.f90"
METHODS = re.findall(r'^ +"(\w+)", "\w+"', TABLE.read_text(encoding="utf-8"), re.MULTILINE)
"""Their names, in the order of the solver's table, which is read before a program is built."""
