"""Times at equal error: the cost of an error level from measured points, and its ratios."""

import math
from collections.abc import Iterable
from itertools import pairwise

LEVELS = tuple(10.0**-k for k in range(4, 13))
"""Errors at which times are compared."""


def seconds_at(level: float, points: Iterable[tuple[float, float]]) -> float | None:
    """Least time for an error of at most `level`; None where no point reaches it.

    `points` are errors and seconds in the order of their tolerances; between neighbours the
    logarithm of time is linear in the logarithm of the error.
    """
    points = [(error, seconds) for error, seconds in points if error > 0 and seconds > 0]
    costs = [seconds for error, seconds in points if error <= level]
    for (error_a, seconds_a), (error_b, seconds_b) in pairwise(points):
        if min(error_a, error_b) < level < max(error_a, error_b):
            share = math.log(level / error_a) / math.log(error_b / error_a)
            costs.append(seconds_a * (seconds_b / seconds_a) ** share)
    return min(costs, default=None)


def ratio_rows(rows: list[dict], ours: str, solvers: list[str]) -> list[dict]:
    """For each scene and level: our seconds, and each solver's time over ours.

    `rows` are those of the table of benchmarks; only those whose status is ok count.
    """
    found = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        for level in LEVELS:
            cost = {
                solver: seconds_at(level, points_of(rows, scene, solver))
                for solver in (ours, *solvers)
            }
            ratios = {
                solver: cost[solver] / cost[ours] if cost[solver] and cost[ours] else None
                for solver in solvers
            }
            found.append({"scene": scene, "error": level, "our_seconds": cost[ours], **ratios})
    return found


def points_of(rows: list[dict], scene: str, solver: str) -> list[tuple[float, float]]:
    """Errors and seconds of one solver on one scene."""
    return [
        (row["error_max"], row["seconds"])
        for row in rows
        if (row["scene"], row["solver"], row["status"]) == (scene, solver, "ok")
    ]
