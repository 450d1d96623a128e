"""How often the error bars of Lyapunov exponents hold."""

import math

import numpy as np
from measuring import describe_machine, measure_command, options_of, write_table
from project import PROGRAM, TABLES, configuration

PAST = (0.0, 0.0, math.log(1.1))
GAMMA = 0.8
ERROR_BARS = 3.0
"""Standard errors within which the true value is expected."""
TOLERANCE = 1e-8
T_TRANSIENT = 20000.0
MOTIONS = {
    "cycle": (10.0, 0.35, 0.8),
    "torus with slow beats": (7.0, 0.40, 0.5),
    "torus": (12.5, 0.5, 0.8),
    "weak chaos": (7.0, 0.42, 0.5),
    "strong chaos": (7.0, 0.7, 0.5),
}
"""tau, epsilon and xi of motions whose error bars are tested. At tau = 7, epsilon = 0.43 the motion
is nearly quasiperiodic and chaotic in turn, for times of the order of 1e5: runs of 1e4 miss one."""
T_COVERED = 400000.0
RUNS = (40, 120)
"""Numbers of runs into which this time is cut; as much time after it gives the true values."""
EXPONENTS = 4


def measure_pieces(motion: str, lists: list[int]) -> tuple[float, dict[int, np.ndarray]]:
    """The time measured, and for each number of pieces an array (piece, exponent, value and
    standard error)."""
    interval = configuration()["exponents"]["interval"]
    words = (
        *MOTIONS[motion], GAMMA, *PAST, TOLERANCE, T_TRANSIENT, 2 * T_COVERED, interval,
        EXPONENTS, len(lists), *lists,
    )  # fmt: skip
    _, answer = measure_command([PROGRAM.with_name("exponents_worker")], " ".join(map(str, words)))
    passed, *rest = answer.splitlines()
    table = np.array([[float(word) for word in row.split()] for row in rest])
    pieces = {
        count: table[table[:, 0] == count][:, 3:].reshape(count, EXPONENTS - 1, 2)
        for count in lists
    }
    return float(passed), pieces


def coverage_rows(motion: str) -> list[dict]:
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
                "motion": motion,
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
    options = options_of("benchmarks/run exponents", TABLES).parse_args()
    header = describe_machine()[:2]
    meaning = "within: share of runs whose value is at most three of their errors from `value`"
    rows = [row for motion in MOTIONS for row in coverage_rows(motion)]
    write_table(options.output / "exponent-coverage.tsv", rows, [*header, meaning])


if __name__ == "__main__":
    main()
