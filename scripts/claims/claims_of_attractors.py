"""Claims about where runs end, by the table attractors.tsv."""

import math
from collections import Counter

from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    REPRODUCED,
    Finding,
    Results,
    decided,
    listed,
    short,
)

MOTIONS = {
    "fixed point": "rest",
    "cycle": "a limit cycle",
    "torus": "a torus",
    "3-torus": "a 3-torus",
}
"""Classes in a sentence, where the word alone is none."""
ERRORS = 3
"""Standard errors beyond which an exponent is not zero."""


def attractor_class(results: Results, *, scene: str, expected: str) -> Finding:
    """Whether the scene's run ends on an attractor of this class, from whichever history."""
    own, *others = results.attractors_of(scene)
    met = Counter(in_words(row) for row in others)
    known = results.stability_of(scene)
    where = ", ".join(f"{key} = {short(known[key])}" for key in ("tau", "epsilon", "xi", "gamma"))
    evidence = (
        f"Scene {scene} ({where}). Class from its own history: {in_words(own)}{exponents_of(own)}."
        f" Class by the section: {own['by_section']}. Class by the spectrum: {own['by_spectrum']}."
        f" Classes from {len(others)} other histories:"
        f" {listed([f'{count} {name}' for name, count in sorted(met.items())])}."
    )
    if own["class"] == expected:
        return Finding(REPRODUCED, evidence)
    elsewhere = any(row["class"] == expected for row in others)
    motion = MOTIONS.get(own["class"], own["class"])
    if in_words(own) != own["class"]:
        motion = f"a {in_words(own)}"
    instead = f"The motion is {motion}{exponents_of(own)}."
    return Finding(CORRECTED if elsewhere else NOT_REPRODUCED, evidence, instead)


def positive_exponent(results: Results, *, scene: str) -> Finding:
    """Whether the largest exponent is positive beyond its error, from every history."""
    rows = results.attractors_of(scene)
    measured = [row for row in rows if not math.isnan(row["exponent_1"])]
    if not measured:
        evidence = f"No exponent of scene {scene} is measured."
        return Finding(NOT_REPRODUCED, evidence, "No exponent is measured.")
    values = [row["exponent_1"] for row in measured]
    beyond = sum(row["exponent_1"] > ERRORS * row["error_1"] for row in measured)
    return decided(
        beyond == len(rows),
        f"The largest Lyapunov exponent of scene {scene} is {short(values[0], 3)} +-"
        f" {short(measured[0]['error_1'], 2)} v0/L from the first of {len(rows)} histories. From"
        f" all of them it is {short(min(values), 3)} to {short(max(values), 3)} v0/L. It is more"
        f" than {ERRORS} standard errors above zero in {beyond} of them.",
        f"The largest exponent is positive beyond its error from {beyond} of {len(rows)}"
        f" {'history' if len(rows) == 1 else 'histories'}.",
    )


def in_words(row: dict) -> str:
    """The class, of a cycle with its period in the section."""
    period = row["period"]
    several = row["class"] == "cycle" and period > 1
    return f"cycle of period {period:.0f}" if several else row["class"]


def exponents_of(row: dict) -> str:
    """The largest three exponents, four of a 3-torus, with errors in brackets, if there are any."""
    parts = [
        f"{short(row[f'exponent_{i}'], 3)} +- {short(row[f'error_{i}'], 2)}"
        for i in range(1, 5 if row["class"] == "3-torus" else 4)
        if not math.isnan(row[f"exponent_{i}"])
    ]
    return f" (exponents {', '.join(parts)})" if parts else ""


TESTS = {
    "attractor_class": attractor_class,
    "positive_exponent": positive_exponent,
}
