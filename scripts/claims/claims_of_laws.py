"""Claims of the paper under other laws of friction than its own."""

from typing import Annotated

from scripts.claims.claims_results import Finding, Results, decided, short
from scripts.claims.declare import among, claim, reads, says, tested_with
from scripts.tables.friction_laws_table import rows_of_planes, scenes_of, shares_of
from scripts.tables.motion_rows import kind_of

LAWS = ["ageing_delayed_velocity", "ageing_delayed_logarithm", "slip_delayed_velocity"]
Law = Annotated[str, among("law of friction", LAWS)]


@claim(
    61,
    "delay_alone_makes_chaos_ageing_delayed_velocity",
    "abstract, under another law",
    look_at="friction_laws",
)
@says(
    "A longer delay makes the motion chaotic, with all other parameters the same, also under the "
    "ageing law (1.2) with the delayed velocity."
)
@tested_with(law="ageing_delayed_velocity")
@claim(
    62,
    "delay_alone_makes_chaos_ageing_delayed_logarithm",
    "abstract, under another law",
    look_at="friction_laws",
)
@says(
    "A longer delay makes the motion chaotic, with all other parameters the same, also under the "
    "ageing law with the delay in the logarithm alone."
)
@tested_with(law="ageing_delayed_logarithm")
@claim(
    63,
    "delay_alone_makes_chaos_slip_delayed_velocity",
    "abstract, under another law",
    look_at="friction_laws",
)
@says(
    "A longer delay makes the motion chaotic, with all other parameters the same, also under the "
    "slip law with both velocities delayed."
)
@tested_with(law="slip_delayed_velocity")
@reads("friction_laws")
def delay_makes_chaos_under(results: Results, *, law: Law) -> Finding:
    """Whether at some epsilon of each plane chaos is met beyond a fixed point as tau grows."""
    rows = [row for row in rows_of_planes(results.friction_laws) if row["law"] == law]
    parts, holds = [], []
    for share in shares_of(rows):
        here = [row for row in rows if (row["gamma"], row["xi"]) == (share["gamma"], share["xi"])]
        epsilons = {row["epsilon"] for row in here}
        met = [epsilon for epsilon in epsilons if turns(here, epsilon)]
        holds.append(bool(met))
        chaotic = share["kinds"]["chaos"]
        parts.append(
            f"At $gamma = {short(share['gamma'])}$ and $xi = {short(share['xi'])}$ {chaotic} of"
            f" {share['points']} points are chaotic, and at {len(met)} of"
            f" {len(epsilons)} values of $epsilon$ a longer delay leads from rest to chaos."
        )
    scenes = ", ".join(
        f"{scene} {kind_of(row)}"
        for scene, of_scene in scenes_of(results.friction_laws).items()
        for row in of_scene
        if row["law"] == law
    )
    instead = "No longer delay leads from rest to chaos under this law, in any of the planes."
    if any(holds):
        instead = f"It does in {sum(holds)} of {len(holds)} planes."
    evidence = f"{' '.join(parts)} Scenes of the paper under this law: {scenes or 'none'}."
    return decided(bool(holds) and all(holds), evidence, instead, partly=any(holds))


def turns(rows: list[dict], epsilon: float) -> bool:
    """Whether at this epsilon chaos is met at a longer delay than rest."""
    line = [row for row in rows if row["epsilon"] == epsilon]
    rest = [row["tau"] for row in line if row["class"] == "fixed point"]
    chaos = [row["tau"] for row in line if row["class"] == "chaos"]
    return bool(rest and chaos) and min(rest) < max(chaos)
