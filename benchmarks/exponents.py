"""How often the error bars of Lyapunov exponents hold."""

import math
from dataclasses import dataclass

import numpy as np
from measuring import (
    BUILD,
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


def measure_pieces(motion: Motion, lists: list[int]) -> tuple[float, dict[int, np.ndarray]]:
    """The time measured, and for each number of pieces an array (piece, exponent, value and
    standard error)."""
    interval = configuration()["exponents"]["interval"]
    words = (
        motion.tau, motion.epsilon, motion.xi, GAMMA, *PAST, TOLERANCE, motion.t_transient,
        2 * T_COVERED, interval, EXPONENTS, len(lists), *lists,
    )  # fmt: skip
    _, answer = measure_command([BUILD / "exponents_worker"], " ".join(map(str, words)))
    passed, *rest = answer.splitlines()
    table = np.array([[float(word) for word in row.split()] for row in rest])
    pieces = {
        count: table[table[:, 0] == count][:, 3:].reshape(count, EXPONENTS - 1, 2)
        for count in lists
    }
    return float(passed), pieces


def coverage_rows(motion: Motion) -> list[dict]:
    """How often the true exponents lie within the error bars of shorter runs."""
    lists = [2, *(2 * count for count in RUNS)]
    passed, pieces = measure_pieces(motion, lists)
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


def main() -> None:
    """Measure and write the tables."""
    options = options_of("exponents").parse_args()
    header = describe_machine()[:2]
    meaning = "within: share of runs whose value is at most three of their errors from `value`"
    rows = [row for motion in MOTIONS for row in coverage_rows(motion)]
    write_table(options.output / "exponent-coverage.tsv", rows, [*header, meaning])


if __name__ == "__main__":
    main()
