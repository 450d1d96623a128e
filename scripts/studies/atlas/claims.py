"""Motions beside the unstable roots of (5), for the claim that the roots decide stability."""

import math

from scripts.tables.motion_rows import AXES_FIRST, UNDECIDED, is_computed
from scripts.tables.roots_of_5 import unstable_roots


def motions_by_roots(rows: list[dict], least_motion: float) -> dict:
    """Numbers of computed motions without and with unstable roots, of those at rest among them, and
    of undecided ones; and how far the largest v is above 1 at least where a root is unstable."""
    motions = [row for row in rows if is_computed(row)]
    decided = [row for row in motions if row["class"] != UNDECIDED]
    unstable = [row for row in decided if unstable_roots(*(row[key] for key in AXES_FIRST))]
    still = [row["class"] == "fixed point" for row in unstable]
    above = [row["largest_maximum"] - 1 for row in unstable]
    return {
        "stable": len(decided) - len(unstable),
        "at_rest": sum(row["class"] == "fixed point" for row in decided) - sum(still),
        "unstable": len(unstable),
        "rests": sum(one or v < least_motion for one, v in zip(still, above, strict=True)),
        "undecided": len(motions) - len(decided),
        "least": min(above, default=math.nan),
    }
