"""A claim about the motions at all points of the atlas."""

from typing import Annotated

import numpy as np

from scripts.claims.claims_results import Finding, Results, decided, short
from scripts.claims.declare import claim, number, reads, says, tested_with
from scripts.claims.words import motions_beside_rest
from scripts.tables.motion_rows import AXES_FIRST, is_computed
from scripts.tables.roots_of_5 import unstable_roots

Motion = Annotated[float, number("largest v - 1 up to which the block is at rest")]


@claim(19, "roots_decide_stability", "section 3, below (5)", look_at="atlas.tsv")
@says("The signs of the real parts of the roots of (5) decide whether steady sliding is stable.")
@tested_with(least_motion=0.001)
@reads("atlas", "attractors", "basins")
def roots_decide(results: Results, *, least_motion: Motion) -> Finding:
    """Whether no computed motion of the atlas or a scene rests where (5) has an unstable root."""
    motions = [row for row in results.atlas + results.attractors if is_computed(row)]
    rows = [row for row in motions if row["class"] != "undecided"]
    stable, unstable = [], []
    for row in rows:
        (unstable if unstable_roots(*(row[key] for key in AXES_FIRST)) else stable).append(row)
    at_rest = [row["class"] == "fixed point" for row in stable]
    rests = [
        row
        for row in unstable
        if row["class"] == "fixed point" or row["largest_maximum"] - 1 < least_motion
    ]
    least = min((row["largest_maximum"] - 1 for row in unstable), default=np.nan)
    undecided = len(motions) - len(rows)
    return decided(
        bool(unstable) and any(at_rest) and not rests,
        f"{len(rows)} computed motions of the atlas and of the scenes have a class. {len(stable)}"
        f" of them are at parameters where all roots have negative real parts: {sum(at_rest)} come"
        f" to rest, {len(stable) - sum(at_rest)} move on another attractor. {len(unstable)} are at"
        f" parameters with unstable roots: {len(rests)} come to rest, and in the others the"
        f" largest $v$ is at least $1 + {short(least, 2)}$. {undecided} more motions are"
        f" undecided. Each point of the atlas has one history. {motions_beside_rest(results)}",
        f"{len(rests)} of {len(unstable)} motions come to rest where a root is unstable, and"
        f" {sum(at_rest)} of {len(stable)} where none is.",
    )
