"""Lyapunov exponents: how often their error bars hold, and their cost beside JiTCDDE's."""

import json
import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from compare import divide, seconds_at
from measuring import (
    BUILD,
    HERE,
    configuration,
    describe_machine,
    measure_command,
    options_of,
    write_table,
)

PAST = (0.0, 0.0, math.log(1.1))
GAMMA = 0.8
ERROR_BARS = 3.0
"""Standard errors within which the true value is expected."""
TOLERANCE = 1e-8


@dataclass(frozen=True, kw_only=True)
class Motion:
    """A block, the name of its motion, and the time until it is on its attractor."""

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
"""Motions whose error bars are tested. At tau = 7, epsilon = 0.43 the motion is nearly
quasiperiodic and chaotic in turn, each for times of the order of 1e5: runs of 1e4 miss one kind."""
T_COVERED = 400000.0
RUNS = (40, 120)
"""Numbers of runs into which this time is cut; as much time after it gives the true values."""
EXPONENTS = 4


@cache
def interval_in_use() -> float:
    """Time between two orthonormalisations, from the project's configuration."""
    return configuration()["exponents"]["interval"]


def measure_here(
    motion: Motion, tolerance: float, t_measured: float, vectors: int, lists: list[int], flow: bool
) -> tuple[float, float, dict[int, np.ndarray]]:
    """CPU seconds, the time that they are for, and for each number of pieces an array
    (piece, vector, value and standard error)."""
    words = (
        motion.tau, motion.epsilon, motion.xi, GAMMA, *PAST, tolerance, motion.t_transient,
        t_measured, interval_in_use(), vectors + flow, "T" if flow else "F", len(lists), *lists,
    )  # fmt: skip
    _, answer = measure_command([BUILD / "exponents_worker"], " ".join(map(str, words)))
    first, *rest = answer.splitlines()
    seconds, passed = map(float, first.split())
    table = np.array([[float(word) for word in row.split()] for row in rest])
    pieces = {
        count: table[table[:, 0] == count][:, 3:].reshape(count, vectors, 2) for count in lists
    }
    return seconds, passed, pieces


def coverage_rows(motion: Motion) -> list[dict]:
    """How often the true exponents lie within the error bars of shorter runs."""
    lists = [2, *(2 * count for count in RUNS)]
    _, passed, pieces = measure_here(motion, TOLERANCE, 2 * T_COVERED, EXPONENTS - 1, lists, True)
    true = pieces[2][1, :, 0]
    rows = []
    for count in RUNS:
        value, error = np.moveaxis(pieces[2 * count][:count], 2, 0)
        away = value - true
        within = np.mean(np.abs(away) <= ERROR_BARS * error, axis=0)
        rows += [
            {
                "motion": motion.name,
                "length": passed / (2 * count),
                "runs": count,
                "exponent": 1 + vector,
                "value": float(true[vector]),
                "rms": rms(away[:, vector]),
                "error": rms(error[:, vector]),
                "within": float(within[vector]),
            }
            for vector in range(EXPONENTS - 1)
        ]
    return rows


def rms(values: np.ndarray) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(values**2)))


def measure_jitcdde(motion: Motion, tolerance: float, t_measured: float, vectors: int) -> dict:
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
    command = [HERE / ".venv" / "bin" / "python", HERE / "jitcdde_worker.py", "exponents"]
    return json.loads(measure_command(command, json.dumps(request))[1])


def means(found: dict, count: int) -> np.ndarray:
    """Exponents of each of a number of pieces (piece, vector): growth over length."""
    growth, length = np.array(found["growth"]), np.array(found["length"])
    long = len(length) // count
    growth = growth[: count * long].reshape(count, long, -1)
    return growth.sum(axis=1) / length[: count * long].reshape(count, long).sum(axis=1)[:, None]


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
    *(
        Comparison(motion=motion, exponent=exponent, across_flow=exponent == 2, **CYCLES)
        for motion in (PAPER_TORUS, OSCILLATION)
        for exponent in (1, 2)
    ),
)
"""Across the flow the exponent of a cycle that is zero needs no vector, so that of the other is the
first; without, the one that is zero."""
TOLERANCES = (1e-5, 1e-8)
COUNTS = (5, 10, 20, 40, 80, 160, 320)
"""Numbers of runs into which the time measured is cut, for errors of runs of this length."""


def ratio_rows(comparison: Comparison, tolerance: float) -> list[dict]:
    """Ratios of CPU time at equal errors."""
    motion, t_measured = comparison.motion, comparison.t_measured
    # a vector across the flow is the second of JiTCDDE's on a cycle, the first in chaos; ours runs
    # before and after it, since other processes may slow down both
    settings = (motion, tolerance, t_measured, 1, list(COUNTS), comparison.across_flow)
    before, passed, pieces = measure_here(*settings)
    theirs = measure_jitcdde(motion, tolerance, t_measured, comparison.exponent)
    after, *_ = measure_here(*settings)
    per_time = {
        "ours": (before + after) / 2 / passed,
        "jitcdde": theirs["seconds"] / sum(theirs["length"]),
    }
    true = true_value(comparison)
    points = {"ours": [], "jitcdde": []}
    for count in COUNTS:
        values = {
            "ours": pieces[count][:, 0, 0],
            "jitcdde": means(theirs, count)[:, comparison.exponent - 1],
        }
        for name, found in values.items():
            points[name].append((rms(found - true), t_measured / count * per_time[name]))
    costs = [
        {name: seconds_at(level, points[name]) for name in points} for level in comparison.levels
    ]
    return [
        {
            "motion": motion.name,
            "exponent": comparison.exponent,
            "tolerance": tolerance,
            "error": level,
            "our_seconds": cost["ours"],
            "jitcdde": divide(cost["jitcdde"], cost["ours"]),
            "our_microseconds_per_time": 1e6 * per_time["ours"],
            "jitcdde_microseconds_per_time": 1e6 * per_time["jitcdde"],
        }
        for level, cost in zip(comparison.levels, costs, strict=True)
    ]


def true_value(comparison: Comparison) -> float:
    """The exponent from a longer run at a tighter tolerance; that of the flow is 0."""
    if not comparison.across_flow:
        return 0.0
    _, _, pieces = measure_here(comparison.motion, 1e-9, 2 * comparison.t_measured, 1, [1], True)
    return float(pieces[1][0, 0, 0])


def main() -> None:
    """Measure and write the tables."""
    options = options_of("exponents").parse_args()
    header = describe_machine()[:2]
    meaning = "within: share of runs whose value is at most three of their errors from `value`"
    rows = [row for motion in MOTIONS for row in coverage_rows(motion)]
    write_table(options.output / "exponent-coverage.tsv", rows, [*header, meaning])
    meaning = "jitcdde: its CPU time over ours at equal error; empty where not reached"
    rows = [row for each in COMPARISONS for t in TOLERANCES for row in ratio_rows(each, t)]
    write_table(options.output / "exponent-ratios.tsv", rows, [*header, meaning])


if __name__ == "__main__":
    main()
