"""What of the paper's conclusion depends on its law of friction."""

from scripts.claims.claims_results import Finding, Results, decided, short
from scripts.claims.declare import Gamma, question, reads, says, tested_with
from scripts.files.tsv import rows_by
from scripts.namelists.laws import spoken
from scripts.studies.friction_laws.table import scenes_of, shares_of
from scripts.tables.motion_rows import kind_of

CHAOTIC, PERIODIC = "delayed_logarithm", "delayed_velocity"
"""Places of the delay, as the names of laws end: those with chaos, and those without."""


@question(61, "chaos_depends_on_place_of_delay", look_at="friction_laws")
@says(
    "Does the place of the delay, and not the law of friction, decide whether there is chaos at"
    " $gamma = 0.8$?"
)
@tested_with(gamma=0.8)
@reads("friction_laws")
def place_of_delay_decides(results: Results, *, gamma: Gamma) -> Finding:
    """Whether in all planes at this gamma chaos is found if the delay stands in the logarithm.

    And in none under the laws with the delayed velocity itself.
    """
    shares = shares_of(results.friction_laws)
    chaotic = chaotic_points(shares, gamma)
    words, scenes = [], []
    for (at_gamma, xi), here in rows_by(shares, "gamma", "xi").items():
        counts = [f"{share['kinds']['chaos']} ({spoken(share['law'])})" for share in here]
        words.append(
            f"At $gamma = {short(at_gamma)}$, $xi = {short(xi)}$ of {here[0]['points']} points"
            f" these are chaotic: {', '.join(counts)}."
        )
    for scene, rows in scenes_of(results.friction_laws).items():
        kinds = [f"{kind_of(row)} ({spoken(row['law'])})" for row in rows]
        scenes.append(f" Scene {scene}: {', '.join(kinds)}.")
    return decided(
        bool(chaotic[CHAOTIC]) and all(chaotic[CHAOTIC]) and not any(chaotic[PERIODIC]),
        f"{' '.join(words)} Each point has one history.{''.join(scenes)}",
        "Laws with the delay in the same place differ.",
    )


def chaotic_points(shares: list[dict], gamma: float) -> dict[str, list[int]]:
    """Numbers of chaotic points of planes at this gamma, by the place of the delay."""
    here = [share for share in shares if share["gamma"] == gamma]
    return {
        place: [share["kinds"]["chaos"] for share in here if share["law"].endswith(place)]
        for place in (CHAOTIC, PERIODIC)
    }
