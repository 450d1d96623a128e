"""Error and time of this project's solver and of others on the same scenes (benchmarks/run)."""

import dataclasses
import math
import platform
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path

import numpy as np
from measuring import ROOT, describe_machine, first_line, options_of, write_table
from solvers import (
    HORIZONS,
    SOLVERS,
    Scene,
    SolverError,
    TimeLimitError,
    Worker,
    error_max,
    read_horizons,
    read_reference,
    read_study,
    reference_path,
    scene_of,
)

from scripts.tables.accuracy import Reference

OURS = "ours"
TOLERANCES = tuple(float(f"1e-{k}") for k in range(3, 14))
LEVELS = tuple(10.0**-k for k in range(4, 13))
"""Errors at which times are compared."""
BATCH_SECONDS = 0.1
"""A measurement repeats short integrations for about this time."""
LONG_SECONDS = 5.0
"""An integration longer than this is measured once."""
LONG_RUN_SCENE, LONG_RUN_TOLERANCE = "torus", 1e-8
LONG_RUN_LIMIT = 600.0
LAST_TIMES = (1e3, 1e4, 1e5, 1e6)
"""Ends of the long runs, each in a process of its own."""


def error_of(worker: Worker, tolerance: float, reference: Reference, limit: float) -> float:
    """Largest error of one run over the samples."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "samples.tsv"
        worker.sample(tolerance, path, limit)
        error = error_max(np.loadtxt(path, ndmin=2), worker.scene, reference)
    if not math.isfinite(error):
        raise SolverError("the result is not a number, and no error was reported")
    return error


def measure_errors(
    worker: Worker,
    reference: Reference,
    limit: float,
    tolerances: tuple[float, ...] = TOLERANCES,
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
                row["error_max"] = error_of(worker, tolerance, reference, limit)
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
                runs[id(row)] = runs_of(found)
            if repeat > 0 or found > LONG_SECONDS:
                measured[id(row)].append(found)
            if found > LONG_SECONDS:
                waiting.remove(row)
    for row in rows:
        if row["status"] == "ok":
            row["seconds"] = statistics.median(measured[id(row)])


def runs_of(seconds: float) -> int:
    """Number of integrations in one measurement."""
    return max(1, math.ceil(BATCH_SECONDS / max(seconds, 1e-3)))


def rows_of_scene(scene: Scene, solvers: list[str], repeats: int, limit: float) -> list[dict]:
    """All solvers and tolerances on one scene."""
    reference = read_reference(scene.name)
    workers = {name: Worker(SOLVERS[name], scene) for name in solvers}
    rows = []
    try:
        for name, worker in workers.items():
            print(f"benchmarks: {scene.name}: errors of {name}", file=sys.stderr)
            found = measure_errors(worker, reference, limit)
            first = {"scene": scene.name, "solver": name, "version": worker.version}
            rows += [{**first, **row} for row in found]
        print(f"benchmarks: {scene.name}: times", file=sys.stderr)
        in_turn = sorted(rows, key=lambda row: -row["tolerance"])
        measure_seconds(in_turn, workers, repeats, limit)
    finally:
        for worker in workers.values():
            worker.stop()
    return rows


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


def divide(cost: float | None, ours: float | None) -> float | None:
    """A ratio of times; None where one of them is not known."""
    return cost / ours if cost and ours else None


def ratio_rows(rows: list[dict], solvers: list[str]) -> list[dict]:
    """For each scene and level: our seconds, and each solver's time over ours."""
    found = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        points = {
            solver: [
                (row["error_max"], row["seconds"])
                for row in rows
                if (row["scene"], row["solver"], row["status"]) == (scene, solver, "ok")
            ]
            for solver in (OURS, *solvers)
        }
        for level in LEVELS:
            ours = seconds_at(level, points[OURS])
            ratios = {name: divide(seconds_at(level, points[name]), ours) for name in solvers}
            found.append({"scene": scene, "error": level, "our_seconds": ours, **ratios})
    return found


def long_run(scene: Scene, t_end: float) -> dict:
    """Seconds and memory of one run of this project's solver without samples."""
    with Worker(SOLVERS[OURS], dataclasses.replace(scene, t_end=t_end)) as worker:
        seconds = worker.seconds(LONG_RUN_TOLERANCE, 1, LONG_RUN_LIMIT)
        return {
            "scene": scene.name,
            "t_end": f"{t_end:.0f}",
            "tolerance": LONG_RUN_TOLERANCE,
            "seconds": seconds,
            "seconds_per_time": seconds / t_end,
            "peak_memory_mb": worker.peak_memory(),
        }


def compute_references(names: list[str]) -> None:
    """Let the project's workflow make the references of the scenes and the table of horizons."""
    files = [path.relative_to(ROOT) for path in (HORIZONS, *map(reference_path, names))]
    subprocess.run([ROOT / "reproduce", *files, "--quiet", "all"], stdout=sys.stderr, check=True)


def main() -> None:
    """Measure and write the tables."""
    study = read_study()
    names, solvers = list(study["cases"]), list(SOLVERS)
    parser = options_of("")
    parser.add_argument("--scenes", nargs="+", choices=names, default=names)
    parser.add_argument("--solvers", nargs="+", choices=solvers, default=solvers)
    parser.add_argument("--time-limit", type=float, default=60.0)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    try:
        compute_references(names)
        scenes = {name: scene_of(study, read_horizons(), name) for name in names}
        rows = [
            row
            for name in options.scenes
            for row in rows_of_scene(
                scenes[name], options.solvers, options.repeats, options.time_limit
            )
        ]
        long_runs = [long_run(scenes[LONG_RUN_SCENE], t_end) for t_end in LAST_TIMES]
    except (subprocess.CalledProcessError, SolverError) as failure:
        raise SystemExit(f"benchmarks: {failure}") from None
    header = [
        *describe_machine(),
        f"{first_line('R', '--version')}; Python {platform.python_version()}",
        "seconds: CPU time of the solver alone, median of repeats in one process",
        "error_max: largest error of theta, u, ln v over the samples, relative where above 1",
    ]
    write_table(options.output / "benchmarks.tsv", rows, header)
    others = [name for name in options.solvers if name != OURS]
    meaning = "columns of solvers: their time over ours, at equal error; empty where not reached"
    ratios = ratio_rows(rows, others)
    write_table(options.output / "benchmark-ratios.tsv", ratios, [*header, meaning])
    write_table(options.output / "long-runs.tsv", long_runs, header[:3])


if __name__ == "__main__":
    main()
