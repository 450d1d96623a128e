"""Motions in words, without markup."""

import math

from scripts.page.mathematics import in_signs
from scripts.tables.motion_rows import UNDECIDED, has_problem, kind_of


def motion(row: dict) -> str:
    """The class of a row of a table of attractors, or why there is none."""
    if has_problem(row):
        return f"no result: {row['problem']}"
    met = kind_of(row)
    if met == UNDECIDED:
        return f"undecided ({row['reason']})"
    return met if met == row["class"] else f"cycle with {row['period']:g} loops"


def exponents(row: dict) -> str:
    """Exponents with their standard errors, where they have one; empty where none is known.

    Three, and the fourth of a 3-torus.
    """
    listed = ", ".join(
        f"{row[f'exponent_{i}']:.3g}" + f" ± {row[f'error_{i}']:.1g}" * (row[f"error_{i}"] > 0)
        for i in range(1, 5 if row["class"] == "3-torus" else 4)
        if not math.isnan(row[f"exponent_{i}"])
    )
    return in_signs(listed)
