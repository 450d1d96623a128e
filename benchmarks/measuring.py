"""What all benchmarks share: errors, times, instructions, ratios at equal error, tables."""

import argparse
import datetime
import math
import platform
import shutil
import statistics
import subprocess
import sys
from collections.abc import Callable, Iterable
from itertools import pairwise
from pathlib import Path

import numpy as np
from workers import BUILD, OURS, SolverError, TimeLimitError, Worker

from scripts.files import tsv

BATCH_SECONDS = 0.1
"""A measurement repeats short runs for about this time."""
LONG_SECONDS = 5.0
"""A run longer than this is measured once."""
COUNTED = (1e-6, 1e-3)
"""Errors at which instructions are compared: those that most users ask for."""


def options_of(name: str, time_limit: float = 60.0) -> argparse.ArgumentParser:
    """The options of a benchmark, whose tables go to a folder."""
    parser = argparse.ArgumentParser(prog=f"benchmarks/run {name}", allow_abbrev=False)
    parser.add_argument("--output", type=folder, default=str(BUILD))
    parser.add_argument("--time-limit", type=float, default=time_limit)
    parser.add_argument("--repeats", type=int, default=5)
    return parser


def folder(text: str) -> Path:
    """A folder, which is made before anything is measured for it."""
    Path(text).mkdir(parents=True, exist_ok=True)
    return Path(text)


def report(*words) -> None:
    """Say what is measured next."""
    print("benchmarks:", *words, file=sys.stderr)


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


def measure(
    workers: dict[str, Worker],
    reference: np.ndarray,
    tolerances: Iterable[float],
    options: argparse.Namespace,
    count: bool = False,
) -> list[dict]:
    """A row for each solver and tolerance, with error and seconds or why there are none."""
    try:
        rows = [
            {"solver": name, "version": worker.version, **row}
            for name, worker in workers.items()
            for row in measure_errors(worker, reference, tolerances, options.time_limit)
        ]
        in_turn = sorted(rows, key=lambda row: -row["tolerance"])
        time_in_turns(in_turn, workers, options.repeats, options.time_limit)
        for row in rows if count else ():
            if row["status"] == "ok" and COUNTED[0] / 10 <= row["error_max"] <= COUNTED[1] * 100:
                row["instructions"] = workers[row["solver"]].instructions(row["tolerance"])
    finally:
        for worker in workers.values():
            worker.stop()
    return rows


def measure_errors(
    worker: Worker, reference: np.ndarray, tolerances: Iterable[float], limit: float
) -> list[dict]:
    """A row for each tolerance, with its error or why there is none.

    After a run that took too long no tighter tolerance is tried.
    """
    rows, too_long = [], None
    for tolerance in tolerances:
        row = {"tolerance": tolerance, "t_end": worker.task.t_end, "status": "ok"}
        row |= {"error_max": math.nan, "seconds": math.nan, "memory": math.nan}
        if too_long:
            row["status"] = f"not tried: {too_long:g} took too long"
        else:
            try:
                error = error_max(worker.numbers(tolerance, limit)[0], reference)
                if not math.isfinite(error):
                    raise SolverError("the result is not a number, and no error was reported")
                row |= {"error_max": error, "memory": worker.memory()}
            except SolverError as failure:
                row["status"] = str(failure)
                too_long = tolerance if isinstance(failure, TimeLimitError) else None
        rows.append(row)
    return rows


def time_in_turns(rows: list[dict], workers: dict[str, Worker], repeats: int, limit: float) -> None:
    """Add the seconds of CPU and clock to rows of solvers and tolerances: solvers take turns, the
    median counts.

    The first turn shows how many runs make one measurement, and counts if it was long.
    """
    waiting = [row for row in rows if row["status"] == "ok"]
    turns = {id(row): [] for row in waiting}
    runs = {id(row): 1 for row in waiting}
    for repeat in range(repeats + 1):
        for row in list(waiting):
            worker = workers[row["solver"]]
            number = runs[id(row)]
            try:
                found = worker.seconds(row["tolerance"], number, limit + BATCH_SECONDS)
            except SolverError as failure:
                row |= {"status": str(failure), "error_max": math.nan}
                waiting.remove(row)
                continue
            if repeat == 0:
                runs[id(row)] = max(1, math.ceil(BATCH_SECONDS / max(found, 1e-3)))
            if repeat > 0 or found > LONG_SECONDS:
                turns[id(row)].append((found, worker.clock / number))
            if found > LONG_SECONDS:
                waiting.remove(row)
    for row in rows:
        if row["status"] == "ok":
            row["turns"], clocks = map(list, zip(*turns[id(row)], strict=True))
            row["seconds"], row["clock"] = map(statistics.median, (row["turns"], clocks))


def cost_at(level: float, points: Iterable[tuple[float, float]]) -> float:
    """Least cost of an error of at most `level`; NaN where no point reaches it.

    `points` are errors and costs in the order of their tolerances; between neighbours the
    logarithm of the cost is linear in the logarithm of the error.
    """
    points = [(error, cost) for error, cost in points if error > 0 and cost > 0]
    costs = [cost for error, cost in points if error <= level]
    for (error_a, cost_a), (error_b, cost_b) in pairwise(points):
        if min(error_a, error_b) < level < max(error_a, error_b):
            share = math.log(level / error_a) / math.log(error_b / error_a)
            costs.append(cost_a * (cost_b / cost_a) ** share)
    return min(costs, default=math.nan)


def ratio_row(rows: list[dict], other: str, level: float) -> dict:
    """At equal error: our seconds, and the cost of another solver over ours.

    The ratio of times, its least and its largest of single turns, and that of instructions; NaN
    where one of the two does not reach the error.
    """
    well = [row for row in rows if row["status"] == "ok"]

    def cost_of(solver: str, cost: Callable) -> float:
        own = [row for row in well if row["solver"] == solver]
        return cost_at(level, [(row["error_max"], cost(row)) for row in own])

    def ratio(cost: Callable) -> float:
        return cost_of(other, cost) / cost_of(OURS, cost)

    turns = range(min((len(row["turns"]) for row in well), default=0))
    single = [ratio(lambda row, i=i: row["turns"][i]) for i in turns]
    counted = COUNTED[0] <= level <= COUNTED[1]
    return {
        "our_seconds": cost_of(OURS, lambda row: row["seconds"]),
        "ratio": ratio(lambda row: row["seconds"]),
        "least": min(single, default=math.nan),
        "most": max(single, default=math.nan),
        "instructions": ratio(lambda row: row.get("instructions", 0)) if counted else math.nan,
    }


def describe_machine() -> list[str]:
    """Date, machine and compilers of a measurement, a line each."""
    models = [
        line.partition(":")[2].strip()
        for line in Path("/proc/cpuinfo").read_text().splitlines()
        if line.startswith("model name")
    ]
    versions = [first_line(name, "--version") for name in ("gfortran", "gcc", "R", "octave-cli")]
    return [
        f"date: {datetime.date.today()}",
        f"machine: {models[0] if models else 'unknown'}, {platform.system()} {platform.release()}",
        f"compilers: {versions[0]}; {versions[1]}",
        f"{versions[2]}; {versions[3]}; Python {platform.python_version()}",
    ]


def first_line(*command: str) -> str:
    """The first line of a command's output, if there is the command."""
    if not shutil.which(command[0]):
        return f"no {command[0]}"
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\n")[0]


def write_table(path: Path, rows: list[dict], meanings: Iterable[str]) -> None:
    """Write rows below lines that begin with #: the machine, and meanings of columns."""
    header = "".join(f"# {line}\n" for line in (*describe_machine(), *meanings))
    tsv.write_table(path, rows)
    path.write_text(header + path.read_text())
