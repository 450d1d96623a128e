"""Lyapunov exponents: how often their error bars hold, and their cost beside JiTCDDE's."""

import argparse
import json
import os
import subprocess
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from compare import machine, write_table
from ratios import seconds_at
from scenes import ROOT
from workers import BUILD, HERE

from scripts.config.check_config import checked
from scripts.config.read_config import read

PAST = (0.0, 0.0, float(np.log(1.1)))
GAMMA = 0.8
ERROR_BARS = 3.0
"""Standard errors within which the true value is expected."""
TOLERANCE = 1e-8


@dataclass(frozen=True, kw_only=True)
class Motion:
    """A block, what its motion is, and the time until it is on its attractor."""

    name: str
    tau: float
    epsilon: float
    xi: float
    t_transient: float = 20000.0


MOTIONS = (
    Motion(name="cycle", tau=10.0, epsilon=0.35, xi=0.8),
    Motion(name="torus with slow beats", tau=7.0, epsilon=0.40, xi=0.5),
    Motion(name="torus", tau=12.5, epsilon=0.5, xi=0.8),
    Motion(name="weak chaos", tau=7.0, epsilon=0.42, xi=0.5),
    Motion(name="strong chaos", tau=7.0, epsilon=0.7, xi=0.5),
)
"""Those whose error bars are tested. At tau = 7, epsilon = 0.43 the motion is nearly quasiperiodic
and chaotic in turn, each for times of the order of 1e5: no run of 1e4 can know both."""

T_COVERED = 400000.0
RUNS = (40, 120)
"""Into how many runs this time is cut; as much time after it gives the true values."""
EXPONENTS = 4

COVERAGE_COLUMNS = ("motion", "length", "runs", "exponent", "value", "rms", "error", "within")


@cache
def interval_in_use() -> float:
    """Time between two orthonormalisations, from the project's configuration."""
    return checked(read(ROOT / "config" / "config.yaml"))["exponents"]["interval"]


def ours(
    motion: Motion,
    tolerance: float,
    t_measured: float,
    vectors: int,
    lists: list[int],
    flow: bool,
) -> tuple[float, float, dict[int, np.ndarray]]:
    """CPU seconds, the time that they are for, and for each number of pieces an array
    (piece, vector, value and standard error)."""
    words = (
        motion.tau, motion.epsilon, motion.xi, GAMMA, *PAST, tolerance, motion.t_transient,
        t_measured, interval_in_use(), vectors + flow, "T" if flow else "F", len(lists), *lists,
    )  # fmt: skip
    line = " ".join(map(str, words))
    run = subprocess.run([BUILD / "exponents_worker"], input=line, capture_output=True, text=True)
    if run.returncode != 0:
        raise SystemExit(f"benchmarks: {run.stderr.strip()}")
    first, *rest = run.stdout.splitlines()
    seconds, passed = map(float, first.split())
    table = np.array([[float(word) for word in row.split()] for row in rest])
    pieces = {
        count: table[table[:, 0] == count][:, 3:].reshape(count, vectors, 2) for count in lists
    }
    return seconds, passed, pieces


def coverage(motion: Motion) -> list[dict]:
    """How often the true exponents lie within the error bars of shorter runs."""
    doubled = [2 * count for count in RUNS]
    _, passed, pieces = ours(motion, TOLERANCE, 2 * T_COVERED, EXPONENTS - 1, [2, *doubled], True)
    true = pieces[2][1, :, 0]
    rows = []
    for count in RUNS:
        value, error = np.moveaxis(pieces[2 * count][:count], 2, 0)
        away = value - true
        rows += [
            {
                "motion": motion.name,
                "length": passed / (2 * count),
                "runs": count,
                "exponent": 1 + vector,
                "value": float(true[vector]),
                "rms": rms(away[:, vector]),
                "error": rms(error[:, vector]),
                "within": float(np.mean(np.abs(away) <= ERROR_BARS * error, axis=0)[vector]),
            }
            for vector in range(EXPONENTS - 1)
        ]
    return rows


def rms(values: np.ndarray) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(values**2)))


def jitcdde(motion: Motion, tolerance: float, t_measured: float, vectors: int) -> dict:
    """CPU seconds, and growth and length of each interval."""
    request = {
        "tau": motion.tau,
        "epsilon": motion.epsilon,
        "xi": motion.xi,
        "gamma": GAMMA,
        "past": PAST,
        "vectors": vectors,
        "tolerance": tolerance,
        "interval": interval_in_use(),
        "t_transient": motion.t_transient,
        "t_measured": t_measured,
    }
    # without this project's packages, which stand in PYTHONPATH
    environment = {key: word for key, word in os.environ.items() if key != "PYTHONPATH"}
    run = subprocess.run(
        [HERE / ".venv" / "bin" / "python", HERE / "jitcdde_lyap_worker.py"],
        input=json.dumps(request),
        capture_output=True,
        text=True,
        env={**environment, "OMP_NUM_THREADS": "1"},
    )
    if run.returncode != 0:
        raise SystemExit(f"benchmarks: {run.stderr.strip()}")
    return json.loads(run.stdout)


def means(found: dict, count: int, smooth: bool) -> np.ndarray:
    """Exponents of each of a number of pieces (piece, vector): the mean over the piece, with level
    weights, or with this project's smooth ends."""
    growth, length = np.array(found["growth"]), np.array(found["length"])
    long = len(length) // count
    growth = growth[: count * long].reshape(count, long, -1)
    length = length[: count * long].reshape(count, long)
    weight = np.array([smooth_ends(row) for row in length]) if smooth else np.ones_like(length)
    return np.einsum("ij,ijk->ik", weight, growth) / np.sum(weight * length, axis=1)[:, None]


def smooth_ends(length: np.ndarray) -> np.ndarray:
    """Weights that rise like exp(-1/x) over the first quarter of the time and fall at its end."""
    middle = (np.cumsum(length) - length / 2) / np.sum(length)
    x = np.clip(4 * np.minimum(middle, 1 - middle), 1e-9, 1 - 1e-9)
    return (1 - np.tanh((1 / x - 1 / (1 - x)) / 2)) / 2


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """An exponent of a motion that both solvers measure, and errors at which costs are compared."""

    motion: Motion
    exponent: int
    across_flow: bool
    t_measured: float
    levels: tuple[float, ...]


CHAOS = Motion(name="chaos (5b)", tau=7.0, epsilon=0.7, xi=0.5)
PAPER_TORUS = Motion(name="cycle (5a)", tau=10.0, epsilon=0.5, xi=0.8)
OSCILLATION = Motion(name="oscillation (4b)", tau=10.0, epsilon=0.35, xi=0.8)
CYCLES = {"t_measured": 200000.0, "levels": (1e-4, 1e-5, 1e-6)}
COMPARISONS = (
    Comparison(
        motion=CHAOS, exponent=1, across_flow=True, t_measured=400000.0, levels=(4e-3, 2e-3)
    ),
    Comparison(motion=PAPER_TORUS, exponent=1, across_flow=False, **CYCLES),
    Comparison(motion=PAPER_TORUS, exponent=2, across_flow=True, **CYCLES),
    Comparison(motion=OSCILLATION, exponent=1, across_flow=False, **CYCLES),
    Comparison(motion=OSCILLATION, exponent=2, across_flow=True, **CYCLES),
)
"""Across the flow the exponent of a cycle that is zero needs no vector, so that of the other is the
first; without, the one that is zero."""
TOLERANCES = (1e-5, 1e-8)
COUNTS = (5, 10, 20, 40, 80, 160, 320)
"""Into how many runs the time measured is cut for errors of runs of this length."""
RATIO_COLUMNS = (
    "motion", "exponent", "tolerance", "error", "our_seconds", "jitcdde", "jitcdde_smooth",
    "our_microseconds_per_time", "jitcdde_microseconds_per_time",
)  # fmt: skip


def compared(comparison: Comparison, tolerance: float) -> list[dict]:
    """Ratios of CPU time at equal errors."""
    motion, t_measured = comparison.motion, comparison.t_measured
    lists = list(COUNTS)
    # a vector across the flow is the second of JiTCDDE's on a cycle, the first in chaos; ours runs
    # before and after it, since other processes may slow down both
    before, passed, pieces = ours(motion, tolerance, t_measured, 1, lists, comparison.across_flow)
    theirs = jitcdde(motion, tolerance, t_measured, comparison.exponent)
    after, *_ = ours(motion, tolerance, t_measured, 1, lists, comparison.across_flow)
    seconds = (before + after) / 2
    per_time = {"ours": seconds / passed, "jitcdde": theirs["seconds"] / sum(theirs["length"])}
    true = true_value(comparison)
    points = {"ours": [], "jitcdde": [], "jitcdde_smooth": []}
    for count in COUNTS:
        cost = t_measured / count
        points["ours"].append((rms(pieces[count][:, 0, 0] - true), cost * per_time["ours"]))
        for name, smooth in (("jitcdde", False), ("jitcdde_smooth", True)):
            values = means(theirs, count, smooth)[:, comparison.exponent - 1]
            points[name].append((rms(values - true), cost * per_time["jitcdde"]))
    rows = []
    for level in comparison.levels:
        cost = {name: seconds_at(level, found) for name, found in points.items()}
        rows.append(
            {
                "motion": motion.name,
                "exponent": comparison.exponent,
                "tolerance": tolerance,
                "error": level,
                "our_seconds": cost["ours"],
                **{
                    name: cost[name] / cost["ours"] if cost[name] and cost["ours"] else None
                    for name in ("jitcdde", "jitcdde_smooth")
                },
                "our_microseconds_per_time": 1e6 * per_time["ours"],
                "jitcdde_microseconds_per_time": 1e6 * per_time["jitcdde"],
            }
        )
    return rows


def true_value(comparison: Comparison) -> float:
    """From a longer run of our own at a tighter tolerance; the exponent of the flow is 0."""
    if not comparison.across_flow:
        return 0.0
    _, _, pieces = ours(
        comparison.motion, 1e-9, 2 * comparison.t_measured, 1, [1], comparison.across_flow
    )
    return float(pieces[1][0, 0, 0])


def main() -> None:
    """Measure and write the tables."""
    parser = argparse.ArgumentParser(prog="benchmarks/run exponents", allow_abbrev=False)
    parser.add_argument("--output", type=Path, default=ROOT / "results" / "tables")
    options = parser.parse_args()
    header = machine()[:2]
    meaning = "within: share of runs whose value is at most three of their errors from `value`"
    rows = [row for motion in MOTIONS for row in coverage(motion)]
    write_table(
        options.output / "exponent-coverage.tsv", list(COVERAGE_COLUMNS), rows, [*header, meaning]
    )
    meaning = "jitcdde: its CPU time over ours at equal error; empty where not reached"
    rows = [row for each in COMPARISONS for t in TOLERANCES for row in compared(each, t)]
    write_table(
        options.output / "exponent-ratios.tsv", list(RATIO_COLUMNS), rows, [*header, meaning]
    )


if __name__ == "__main__":
    main()
