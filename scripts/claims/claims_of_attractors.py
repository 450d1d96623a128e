"""Claims about where runs end, by the tables attractors.tsv and route-to-chaos.tsv."""

import math
from collections import Counter
from itertools import pairwise

from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    REPRODUCED,
    Finding,
    Results,
    decided,
    listed,
    short,
    stable_delays,
)
from scripts.tables.motion_rows import first_met

ERRORS = 3
"""Standard errors beyond which an exponent is not zero."""
MOST_INTERVALS = 12
"""Intervals of epsilon that the evidence of a route lists."""


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
    return Finding(CORRECTED if elsewhere else NOT_REPRODUCED, evidence)


def positive_exponent(results: Results, *, scene: str) -> Finding:
    """Whether the largest exponent is positive beyond its error, from every history."""
    rows = results.attractors_of(scene)
    measured = [row for row in rows if not math.isnan(row["exponent_1"])]
    if not measured:
        return decided(False, f"No exponent of scene {scene} is measured.")
    values = [row["exponent_1"] for row in measured]
    beyond = sum(row["exponent_1"] > ERRORS * row["error_1"] for row in measured)
    return decided(
        beyond == len(rows),
        f"The largest Lyapunov exponent of scene {scene} is {short(values[0], 3)} +-"
        f" {short(measured[0]['error_1'], 2)} v0/L from the first of {len(rows)} histories. From"
        f" all of them it is {short(min(values), 3)} to {short(max(values), 3)} v0/L. It is more"
        f" than {ERRORS} standard errors above zero in {beyond} of them.",
    )


def sequence_of_scenes(results: Results, *, scenes: list[str], expected: list[str]) -> Finding:
    """Whether scenes with longer and longer delays are of these classes in turn."""
    met = [in_words(results.attractors_of(scene)[0]) for scene in scenes]
    classes = [results.attractors_of(scene)[0]["class"] for scene in scenes]
    delays = [results.stability_of(scene)["tau"] for scene in scenes]
    parts = [f"{name} at tau = {short(delay)}" for name, delay in zip(met, delays, strict=True)]
    longer = all(before < after for before, after in pairwise(delays))
    return decided(
        classes == expected and longer,
        f"Attractors in the paper's order: {', '.join(parts)}. Each delay is longer than the one"
        f" before: {'yes' if longer else 'no'}.",
    )


def delay_alone_makes(results: Results, *, scene: str, expected: str) -> Finding:
    """Whether a scene's class comes from stable steady sliding by a longer delay alone."""
    own, row = results.attractors_of(scene)[0], results.stability_of(scene)
    stable = [f"{short(begin)} to {short(end)}" for begin, end in stable_delays(row)]
    return decided(
        own["class"] == expected and bool(stable),
        f"At epsilon = {short(row['epsilon'])} and xi = {short(row['xi'])} steady sliding is stable"
        f" for these tau up to {short(row['tau'])}: {listed(stable)}. At tau = {short(row['tau'])}"
        f" the attractor is: {in_words(own)}{exponents_of(own)}.",
    )


def route(results: Results, *, expected: list[str]) -> Finding:
    """Whether these classes, with growing epsilon, are first met in this order and one by one."""
    rows = sorted(results.route, key=lambda row: row["epsilon"])
    if not rows:
        return decided(False, "route-to-chaos.tsv has no row.")
    sure = [row for row in rows if row["class"] != "undecided"]
    classes = list(first_met(rows))
    end = classes.index(expected[-1]) + 1 if expected[-1] in classes else 0
    before = classes[max(0, end - len(expected)) : end]
    finer = stretches_of(sure, in_words)
    parts = [f"{in_words(stretch[0])} {epsilons_of(stretch)}" for stretch in finer]
    left = len(parts) - MOST_INTERVALS
    more = f", and {left} more intervals" if left > 0 else ""
    return decided(
        before == expected,
        f"Classes with growing epsilon, at tau = {short(rows[0]['tau'])} and"
        f" xi = {short(rows[0]['xi'])}: {listed(parts[:MOST_INTERVALS])}{more}. Undecided:"
        f" {len(rows) - len(sure)} of {len(rows)} points.",
    )


def stretches_of(rows: list[dict], key) -> list[list[dict]]:
    """Neighbours of the same key together."""
    stretches: list[list[dict]] = []
    for row in rows:
        if stretches and key(stretches[-1][0]) == key(row):
            stretches[-1].append(row)
        else:
            stretches.append([row])
    return stretches


def epsilons_of(stretch: list[dict]) -> str:
    """From where to where."""
    first, last = (short(stretch[i]["epsilon"]) for i in (0, -1))
    return first if first == last else f"{first} to {last}"


def in_words(row: dict) -> str:
    """The class, of a cycle with its period in the section."""
    period = row["period"]
    several = row["class"] == "cycle" and period > 1
    return f"cycle of period {period:.0f}" if several else row["class"]


def exponents_of(row: dict) -> str:
    """The largest exponents with their errors, in brackets, as far as there are any."""
    parts = [
        f"{short(row[f'exponent_{i}'], 3)} +- {short(row[f'error_{i}'], 2)}"
        for i in (1, 2, 3)
        if not math.isnan(row[f"exponent_{i}"])
    ]
    return f" (exponents {', '.join(parts)})" if parts else ""


TESTS = {
    "attractor_class": attractor_class,
    "positive_exponent": positive_exponent,
    "sequence_of_scenes": sequence_of_scenes,
    "delay_alone_makes": delay_alone_makes,
    "route": route,
}
