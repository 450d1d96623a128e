"""Stretches of one class along routes, and where classes follow each other.

One point may not decide: a class counts where two neighbouring points of a run have it, or two runs
at one point. Torus bifurcations are those of the cycles followed on the same line.
"""

from collections import Counter
from dataclasses import dataclass
from itertools import pairwise

from scripts.claims.filters import fixed, motion, short, torus_points
from scripts.files.inputs import Dataset
from scripts.files.tsv import rows_by
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


def stretches_of(rows: list[dict]) -> dict[str, list[Stretch]]:
    """Stretches along a route by run. A cycle of several points behind a torus is locked there."""
    along = parameter_of(rows)
    times = Counter((row[along], row["class"]) for row in rows)
    found: dict[str, list[Stretch]] = {}
    for run, of_run in rows_by(rows, "run").items():
        ordered = sorted(of_run, key=lambda row: row[along])
        beside = [UNDECIDED, *(row["class"] for row in ordered), UNDECIDED]
        stretches = found.setdefault(run, [])
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
    return found


def in_turn(rows: list[dict], expected: list[str], cycle_points: list[dict] | None = None) -> dict:
    """Where these classes follow each other along a route.

    With a torus bifurcation between each cycle and torus, if those of all lines are given: a pair
    of multipliers of a stable cycle crosses the unit circle.
    """
    size, places = len(expected), None
    if cycle_points is not None:
        places = torus_points(rows[0], parameter_of(rows), cycle_points)

    def follows(turn: list[Stretch]) -> bool:
        return [one.motion for one in turn] == expected and all(
            any(before.last <= place <= after.first for place in places)
            for before, after in pairwise(turn)
            if places is not None and (before.motion, after.motion) == ("cycle", "torus")
        )

    turns = [
        [part for i in range(len(run)) if follows(part := run[i : i + size])]
        for run in stretches_of(rows).values()
    ]
    return on_line(rows, turns, places)


def beyond(rows: list[dict], before: list[str], after: str) -> dict:
    """Stretches of some classes, and the first of another class beyond them, along a route."""
    turns = []
    for run in stretches_of(rows).values():
        motions = [stretch.motion for stretch in run]
        first = next((i for i, met in enumerate(motions) if met in before), len(motions))
        end = motions.index(after, first) if after in motions[first:] else 0
        earlier = [stretch for stretch in run[first:end] if stretch.motion in before]
        turns.append([[*earlier, run[end]]] if earlier else [])
    return on_line(rows, turns)


def on_line(rows: list[dict], turns: list[list[list[Stretch]]], places: dict | None = None) -> dict:
    """What is fixed on a line, how many runs show such turns, and the longest of these."""
    along = parameter_of(rows)
    longest = max(
        filter(None, turns),
        key=lambda run: sum(one.last - one.first for turn in run for one in turn),
        default=[],
    )
    return {
        **{"along": along, "fixed": fixed(rows[0], along), "places": places},
        **{"runs": len(turns), "shown": sum(map(bool, turns))},
        "turns": [", ".join(map(str, turn)) for turn in longest],
    }


def ways_to_chaos(rows: list[dict]) -> dict:
    """In how many runs along a route a larger parameter leads to chaos, and a smaller one."""
    ends = [(run[0].motion, run[-1].motion) for run in stretches_of(rows).values() if run]
    return {
        "along": parameter_of(rows),
        "runs": len(ends),
        "larger": sum(first != "chaos" == last for first, last in ends),
        "smaller": sum(last != "chaos" == first for first, last in ends),
    }


def locked_places(rows: list[dict]) -> dict[float, Counter]:
    """Motions of the runs where a torus is locked to a cycle of several loops, or runs differ."""
    places = sorted(rows_by(rows, parameter_of(rows)).items())
    found = {place: Counter(map(motion, at)) for place, at in places}
    return {
        place: met for place, met in found.items() if len(met) > 1 or "loops" in next(iter(met))
    }


def chaos_next(tori: list[dict], atlas: list[dict], along: str) -> int:
    """Beside how many tori of an atlas the next larger value of a parameter with another class,
    that is not undecided, has chaos."""
    found = 0
    for torus in tori:
        larger = [
            row
            for row in atlas
            if row[along] > torus[along]
            and row["class"] not in (torus["class"], UNDECIDED)
            and fixed(row, along) == fixed(torus, along)
        ]
        following = min(larger, key=lambda row: row[along], default={"class": ""})
        found += following["class"] == "chaos"
    return found


def hopf_points_on(rows: list[dict], curves: list[Dataset], cycle_points: list[dict]) -> dict:
    """Hopf bifurcations along a route: where and of which kind, that of steady sliding first.

    That is where a pair of roots becomes unstable on the curves with the xi of the route, nearest
    to its epsilon. Those of stable cycles are torus bifurcations.
    """
    place, along = rows[0], parameter_of(rows)
    (plane,) = (one for one in curves if one.xi[0] == place["xi"])
    lost = plane.isel(point=(plane.unstable_roots == 0) & (plane.crossing > 0))
    first = lost.isel(point=abs(lost.epsilon.values - place["epsilon"]).argmin())
    sliding = float(first[along]), "subcritical" if first.l1 > 0 else "supercritical"
    cycles = torus_points(place, along, cycle_points)
    points = [sliding, *cycles.items()]
    supercritical = len(points) > 1 and {kind for _, kind in points} == {"supercritical"}
    return {
        **{"along": along, "fixed": fixed(place, along), "sliding": sliding, "cycles": cycles},
        "supercritical": supercritical,
    }
