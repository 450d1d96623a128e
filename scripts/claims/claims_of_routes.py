"""Claims about what changes along a parameter, by the tables of the routes.

One point may not decide: a class counts where two neighbouring points of a run have it, or two runs
at one point. Torus bifurcations are those of the cycles followed on the same line.
"""

from collections import Counter
from dataclasses import dataclass
from itertools import pairwise

from scripts.claims.claims_of_attractors import in_words
from scripts.claims.claims_of_cycles import torus_points
from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    REPRODUCED,
    Finding,
    Results,
    decided,
    short,
)
from scripts.namelists.study_cases import PARAMETERS
from scripts.tables.motion_rows import UNDECIDED, parameter_of


@dataclass
class Stretch:
    """Points of one class that follow each other; undecided ones between them are left out."""

    motion: str
    first: float
    last: float

    def __str__(self) -> str:
        end = f" to {short(self.last)}" if self.last > self.first else ""
        return f"{self.motion} {short(self.first)}{end}"


Turns = dict[str, list[list[Stretch]]]
"""Stretches that belong together, by run."""


def route(results: Results, *, routes: list[str], expected: list[str]) -> Finding:
    """Whether these classes follow each other along at least one of the routes."""
    lines = [results.route(name) for name in routes]
    found = [sequences(rows, expected) for rows in lines]
    told = [in_a_sentence(rows, met) for rows, met in zip(lines, found, strict=True)]
    instead = f"No run shows {', then '.join(expected)}."
    return decided(any(any(met.values()) for met in found), " ".join(told), instead)


def torus_route(results: Results, *, routes: list[str], expected: list[str]) -> Finding:
    """Whether these classes follow each other, a cycle and a torus at a torus bifurcation."""
    lines = [results.route(name) for name in routes]
    found = [at_bifurcations(rows, sequences(rows, expected), results) for rows in lines]
    told = [
        f"{in_a_sentence(rows, met)} {bifurcations_in_words(rows, results)}"
        for rows, met in zip(lines, found, strict=True)
    ]
    instead = (
        f"No run shows {', then '.join(expected)} with a torus bifurcation between cycle and torus."
    )
    return decided(any(any(met.values()) for met in found), " ".join(told), instead)


def leads_to(results: Results, *, routes: list[str], before: list[str], after: str) -> Finding:
    """Whether a class is met beyond others along all of the routes, or along some of them."""
    lines = [results.route(name) for name in routes]
    found = [changes(rows, before, after) for rows in lines]
    evidence = " ".join(in_a_sentence(rows, met) for rows, met in zip(lines, found, strict=True))
    holds = [any(met.values()) for met in found]
    if all(holds):
        return Finding(REPRODUCED, evidence)
    if any(holds):
        return Finding(CORRECTED, evidence, f"It does along {sum(holds)} of {len(holds)} lines.")
    parameters = " or ".join(dict.fromkeys(parameter_of(rows) for rows in lines))
    instead = f"No run along {parameters} shows {after} beyond {' or '.join(before)}."
    return Finding(NOT_REPRODUCED, evidence, instead)


def delays_in_turn(
    results: Results, *, scenes: list[str], expected: list[str], route: str
) -> Finding:
    """Whether scenes with longer and longer delays are of these classes in turn, or a route is.

    On the route a cycle and a torus meet at a torus bifurcation.
    """
    own = [results.attractors_of(scene)[0] for scene in scenes]
    delays = [results.stability_of(scene)["tau"] for scene in scenes]
    grow = all(before < after for before, after in pairwise(delays))
    met = [f"{in_words(row)} at {short(tau)}" for row, tau in zip(own, delays, strict=True)]
    rows = results.route(route)
    found = at_bifurcations(rows, sequences(rows, expected), results)
    shown = f"{in_a_sentence(rows, found)} {bifurcations_in_words(rows, results)}"
    evidence = (
        f"The paper's delays in its order, with other parameters changed, too: {', '.join(met)}."
        f" These delays {'grow' if grow else 'do not grow'} from one to the next. Only"
        f" the delay changes on the route {route}. {shown}"
    )
    if grow and [row["class"] for row in own] == expected:
        return Finding(REPRODUCED, evidence)
    if any(found.values()):
        instead = "At fixed parameters a longer delay gives this order."
        return Finding(CORRECTED, evidence, instead)
    return Finding(NOT_REPRODUCED, evidence, f"Nor does the route {route} show this order.")


def at_bifurcations(rows: list[dict], found: Turns, results: Results) -> Turns:
    """Those of the stretches in which a torus bifurcation lies between each cycle and torus."""
    places = torus_bifurcations(rows, results)
    return {
        run: [
            turn
            for turn in turns
            if all(
                any(before.last <= place <= after.first for place in places)
                for before, after in pairwise(turn)
                if (before.motion, after.motion) == ("cycle", "torus")
            )
        ]
        for run, turns in found.items()
    }


def torus_bifurcations(rows: list[dict], results: Results) -> list[float]:
    """Where stable cycles on the line of a route have torus bifurcations."""
    along = parameter_of(rows)
    place = {key: rows[0][key] for key in PARAMETERS if key != along}
    return [point[along] for point in torus_points(results, place)]


def bifurcations_in_words(rows: list[dict], results: Results) -> str:
    """Where a pair of multipliers of a stable cycle crosses the unit circle on a route."""
    places = torus_bifurcations(rows, results)
    if not places:
        return "No torus bifurcation of a stable cycle is known on this line."
    listed_places = " and ".join(short(place) for place in places)
    return (
        "A pair of multipliers of a stable cycle leaves the unit circle at"
        f" {parameter_of(rows)} = {listed_places}."
    )


def sequences(rows: list[dict], expected: list[str]) -> Turns:
    """Where these classes follow each other."""
    size = len(expected)
    return {
        run: [
            stretches[i : i + size]
            for i in range(len(stretches) - size + 1)
            if [stretch.motion for stretch in stretches[i : i + size]] == expected
        ]
        for run, stretches in stretches_of(rows).items()
    }


def changes(rows: list[dict], before: list[str], after: str) -> Turns:
    """Stretches of some classes, and the first of another class beyond them."""
    found: Turns = {}
    for run, stretches in stretches_of(rows).items():
        motions = [stretch.motion for stretch in stretches]
        first = next((i for i, motion in enumerate(motions) if motion in before), len(motions))
        end = motions.index(after, first) if after in motions[first:] else 0
        earlier = [stretch for stretch in stretches[first:end] if stretch.motion in before]
        found[run] = [[*earlier, stretches[end]]] if earlier else []
    return found


def stretches_of(rows: list[dict]) -> dict[str, list[Stretch]]:
    """Stretches along a route by run. A cycle of several points behind a torus is locked there."""
    along = parameter_of(rows)
    times = Counter((row[along], row["class"]) for row in rows)
    found = {}
    for run in dict.fromkeys(row["run"] for row in rows):
        ordered = sorted((row for row in rows if row["run"] == run), key=lambda row: row[along])
        beside = [UNDECIDED, *(row["class"] for row in ordered), UNDECIDED]
        stretches: list[Stretch] = []
        for i, row in enumerate(ordered):
            confirmed = times[row[along], row["class"]] > 1
            confirmed |= row["class"] in (beside[i], beside[i + 2])
            last = stretches[-1].motion if stretches else ""
            locked = last == "torus" and row["class"] == "cycle" and row["period"] > 1
            if row["class"] == UNDECIDED or locked or not confirmed:
                continue
            if last == row["class"]:
                stretches[-1].last = row[along]
            else:
                stretches.append(Stretch(row["class"], row[along], row[along]))
        found[run] = stretches
    return found


def in_a_sentence(rows: list[dict], found: Turns) -> str:
    """The stretches of the run in which they are longest, and how many runs show such."""
    along = parameter_of(rows)
    fixed = ", ".join(f"{key} = {short(rows[0][key])}" for key in PARAMETERS if key != along)
    shown = [turns for turns in found.values() if turns]
    if not shown:
        return f"Along {along} ({fixed}): in none of {len(found)} runs."
    longest = max(
        shown, key=lambda turns: sum(one.last - one.first for turn in turns for one in turn)
    )
    turns = "; ".join(", ".join(map(str, turn)) for turn in longest)
    return f"Along {along} ({fixed}): {turns}; in {len(shown)} of {len(found)} runs."


TESTS = {
    "route": route,
    "leads_to": leads_to,
    "torus_route": torus_route,
    "delays_in_turn": delays_in_turn,
}
