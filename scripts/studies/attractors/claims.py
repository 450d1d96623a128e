"""Claims about where runs end, by the table attractors.tsv."""

import math
from collections import Counter

from scripts.claims.claims_results import Finding, Results, decided, equations, join, short
from scripts.claims.declare import Class, Scene, claim, reads, says, tested_with
from scripts.claims.words import class_with_loops
from scripts.namelists.parameters import PARAMETERS
from scripts.tables.motion_rows import UNDECIDED

MOTIONS = {
    "fixed point": "rest",
    "cycle": "a limit cycle",
    "torus": "a torus",
    "3-torus": "a torus of three frequencies",
}
"""Classes in a sentence, where the word alone is none."""
ERRORS = 3
"""Standard errors beyond which an exponent is not zero."""


@claim(35, "figure_4a", "Figure 4a", look_at="figure_4")
@says("At $tau = 0$, $epsilon = 0.3$, $xi = gamma = 0.8$ the block comes to a fixed point.")
@tested_with(scene="fixed_point", expected="fixed point")
@claim(36, "figure_4b", "Figure 4b", look_at="figure_4")
@says("At $tau = 10$, $epsilon = 0.35$, $xi = gamma = 0.8$ the block oscillates.")
@tested_with(scene="oscillation", expected="cycle")
@claim(38, "figure_5b", "Figure 5b", look_at="figure_5")
@says("At $tau = 7$, $epsilon = 0.7$, $xi = 0.5$, $gamma = 0.8$ the block moves chaotically.")
@tested_with(scene="chaos", expected="chaos")
@reads("attractors", "exponents", "linear_stability")
def attractor_class(results: Results, *, scene: Scene, expected: Class) -> Finding:
    """Whether the scene's run ends on an attractor of this class, from whichever history."""
    own, *others = results.attractors_of(scene)
    met = Counter(class_with_loops(row) for row in others)
    where = equations(results.stability_of(scene), PARAMETERS)
    exponents = exponents_of(own, results.exponents_of(scene))
    # the spectrum is not looked at where the section confirms the class
    confirmed = own["by_section"] == own["class"] and own["by_spectrum"] == UNDECIDED
    by_spectrum = "not needed" if confirmed else own["by_spectrum"]
    evidence = (
        f"Scene {scene} ({where}). Class from its own history: {class_with_loops(own)}{exponents}."
        f" Class by the section: {own['by_section']}. Class by the spectrum: {by_spectrum}."
        f" Classes from {len(others)} other histories:"
        f" {join([f'{count} {name}' for name, count in sorted(met.items())])}."
    )
    elsewhere = any(row["class"] == expected for row in others)
    motion = MOTIONS.get(own["class"], own["class"])
    if class_with_loops(own) != own["class"]:
        motion = f"a {class_with_loops(own)}"
    instead = f"The motion is {motion}{exponents}."
    return decided(own["class"] == expected, evidence, instead, partly=elsewhere)


@claim(6, "single_block_is_chaotic", "abstract; section 4", look_at="attractors.tsv")
@says("A single block with a delay can be chaotic.")
@tested_with(scene="chaos")
@reads("attractors", "exponents")
def positive_exponent(results: Results, *, scene: Scene) -> Finding:
    """Whether the largest exponent is positive beyond its error, from every history."""
    rows = results.attractors_of(scene)
    measured = [row for row in rows if not math.isnan(row["exponent_1"])]
    if not measured:
        instead = "No exponent is measured."
        return decided(False, f"No exponent of scene {scene} is measured.", instead)
    first = measured[0]
    own = results.exponents_of(scene) or [(first["exponent_1"], first["error_1"])]
    beyond = sum(row["exponent_1"] > ERRORS * row["error_1"] for row in measured)
    return decided(
        beyond == len(rows),
        f"The largest Lyapunov exponent of scene {scene} is {with_error(*own[0])} $v0/L$."
        f" It is more than {ERRORS} standard errors above zero from {beyond} of {len(rows)}"
        " histories.",
        f"The largest exponent is positive beyond its error from {beyond} of {len(rows)}"
        f" {'history' if len(rows) == 1 else 'histories'}.",
    )


def exponents_of(row: dict, long: list[tuple[float, float]]) -> str:
    """The largest three exponents, four of a 3-torus, with their errors, in brackets.

    They are those of the scene's long run if it has one, else those of the row, if there are any.
    """
    number = 4 if row["class"] == "3-torus" else 3
    short_run = [(row[f"exponent_{i}"], row[f"error_{i}"]) for i in range(1, number + 1)]
    values = [with_error(*pair) for pair in (long or short_run)[:number] if not math.isnan(pair[0])]
    return f" (exponents{' of its long run' if long else ''} {', '.join(values)})" if values else ""


def with_error(exponent: float, error: float) -> str:
    """An exponent with its standard error; that along the flow is exact, that of rest, too."""
    if error > 0:
        return f"{short(exponent, 3)} +- {short(error, 2)}"
    return short(exponent, 3) if exponent else "0 (along the flow)"
