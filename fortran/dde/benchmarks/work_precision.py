# SPDX-License-Identifier: BSD-3-Clause
"""Error and time of solvers on one scene, and their ratios at equal error."""

import math
import statistics
from collections.abc import Callable, Iterable
from itertools import pairwise

import numpy as np
from workers import OURS, SolverError, TimeLimitError, Worker

BATCH_SECONDS = 0.1
"""A measurement repeats short integrations for about this time."""
LONG_SECONDS = 5.0
"""An integration longer than this is measured once."""


def measure(
    workers: dict[str, Worker],
    reference: np.ndarray,
    tolerances: tuple[float, ...],
    repeats: int,
    limit: float,
) -> list[dict]:
    """A row for each solver and tolerance, with error and seconds or why there are none."""
    try:
        rows = [
            {"solver": name, "version": worker.version, **row}
            for name, worker in workers.items()
            for row in measure_errors(worker, reference, tolerances, limit)
        ]
        in_turn = sorted(rows, key=lambda row: -row["tolerance"])
        measure_seconds(in_turn, workers, repeats, limit)
    finally:
        for worker in workers.values():
            worker.stop()
    return rows


def error_max(samples: np.ndarray, reference: np.ndarray) -> float:
    """Largest error over all samples, rows of the time and the state; NaN where one is missing.

    It is relative to the component of the reference where that is above 1.
    """
    if samples.shape != reference.shape:
        return math.nan
    if not abs(samples - reference)[:, 0].max() <= 1e-6:
        return math.nan
    error = abs(samples - reference) / np.maximum(1.0, abs(reference))
    return float(error[:, 1:].max())


def measure_errors(
    worker: Worker, reference: np.ndarray, tolerances: tuple[float, ...], limit: float
) -> list[dict]:
    """A row for each tolerance, with its error or why there is none.

    After a run that took too long no tighter tolerance is tried.
    """
    rows, too_long = [], None
    for tolerance in tolerances:
        row = {"tolerance": tolerance, "t_end": worker.scene.t_end, "status": "ok"}
        row |= {"error_max": None, "seconds": None}
        if too_long:
            row["status"] = f"not tried: {too_long:g} took too long"
        else:
            try:
                error = error_max(worker.samples(tolerance, limit), reference)
                if not math.isfinite(error):
                    raise SolverError("the result is not a number, and no error was reported")
                row["error_max"] = error
            except SolverError as failure:
                row["status"] = str(failure)
                too_long = tolerance if isinstance(failure, TimeLimitError) else None
        rows.append(row)
    return rows


def measure_seconds(
    rows: list[dict], workers: dict[str, Worker], repeats: int, limit: float
) -> None:
    """Add the seconds to the rows of one scene: solvers take turns, the median counts.

    The first turn shows how many integrations make one measurement, and counts if it was long.
    """
    waiting = [row for row in rows if row["status"] == "ok"]
    measured = {id(row): [] for row in waiting}
    runs = {id(row): 1 for row in waiting}
    for repeat in range(repeats + 1):
        for row in list(waiting):
            worker = workers[row["solver"]]
            try:
                found = worker.seconds(row["tolerance"], runs[id(row)], limit + BATCH_SECONDS)
            except SolverError as failure:
                row |= {"status": str(failure), "error_max": None}
                waiting.remove(row)
                continue
            if repeat == 0:
                runs[id(row)] = max(1, math.ceil(BATCH_SECONDS / max(found, 1e-3)))
            if repeat > 0 or found > LONG_SECONDS:
                measured[id(row)].append(found)
            if found > LONG_SECONDS:
                waiting.remove(row)
    for row in rows:
        if row["status"] == "ok":
            row["turns"] = measured[id(row)]
            row["seconds"] = statistics.median(row["turns"])


def count_instructions(rows: list[dict], workers: dict[str, Worker], errors: tuple) -> None:
    """Add the instructions of one integration to rows with an error in a range."""
    for row in rows:
        if row["status"] == "ok" and errors[0] <= row["error_max"] <= errors[1]:
            worker = workers[row["solver"]]
            # the first ones of a process prepare what later ones use
            few, more = (worker.instructions(row["tolerance"], runs) for runs in (2, 4))
            row["instructions"] = (more - few) / 2


def cost_at(level: float, points: Iterable[tuple[float, float]]) -> float | None:
    """Least cost of an error of at most `level`; None where no point reaches it.

    `points` are errors and costs in the order of their tolerances; between neighbours the
    logarithm of the cost is linear in the logarithm of the error.
    """
    points = [(error, cost) for error, cost in points if error > 0 and cost > 0]
    costs = [cost for error, cost in points if error <= level]
    for (error_a, cost_a), (error_b, cost_b) in pairwise(points):
        if min(error_a, error_b) < level < max(error_a, error_b):
            share = math.log(level / error_a) / math.log(error_b / error_a)
            costs.append(cost_a * (cost_b / cost_a) ** share)
    return min(costs, default=None)


def ratios(rows: list[dict], level: float, cost: Callable = lambda row: row["seconds"]) -> dict:
    """At equal error: what this solver costs, and the cost of each other one over it.

    None where one of the costs is not known.
    """
    points = {row["solver"]: [] for row in rows}
    for row in rows:
        if row["status"] == "ok":
            points[row["solver"]].append((row["error_max"], cost(row)))
    costs = {name: cost_at(level, found) for name, found in points.items()}
    ours = costs.pop(OURS)
    found = {name: cost / ours if cost and ours else None for name, cost in costs.items()}
    return {"our_seconds": ours, **found}


def spread(rows: list[dict], level: float, solver: str) -> tuple[float, float] | None:
    """The least and the largest ratio at equal error of one turn of measurements."""
    turns = min((len(row["turns"]) for row in rows if row["status"] == "ok"), default=0)
    found = [ratios(rows, level, lambda row, i=i: row["turns"][i])[solver] for i in range(turns)]
    found = [ratio for ratio in found if ratio]
    return (min(found), max(found)) if found else None
