"""How often the error bars of Lyapunov exponents hold (benchmarks/run exponents)."""

import numpy as np
from measuring import options_of, report, write_table
from workers import Task, Worker, command_of

ERROR_BARS = 3.0
"""Standard errors within which the true value is expected."""
GAMMA, TOLERANCE, T_TRANSIENT = 0.8, 1e-8, 5000.0
MOTIONS = {
    "cycle": (10.0, 0.35, 0.8),
    "torus with slow beats": (7.0, 0.40, 0.5),
    "torus": (12.5, 0.5, 0.8),
    "weak chaos": (7.0, 0.42, 0.5),
    "strong chaos": (7.0, 0.7, 0.5),
}
"""tau, epsilon and xi of motions whose error bars are tested. At tau = 7, epsilon = 0.43 the motion
is in turn nearly quasiperiodic and chaotic, for times of the order of 1e5: runs of 1e4 miss one."""
T_LONG, T_SHORT = 400000.0, 10000.0
"""Time of the run that gives the true values, and of each shorter run."""
VELOCITIES = np.linspace(1.05, 1.5, 40).tolist()
"""Velocities for t <= 0 of the shorter runs."""


def measured(motion: str, velocities: list[float], length: float, limit: float) -> np.ndarray:
    """Exponents but that of the flow, and their errors, of runs from velocities: an array (run, 2,
    exponent)."""
    task = Task((*MOTIONS[motion], GAMMA, *velocities), T_TRANSIENT + length)
    with Worker(command_of("delaykit", "exponents", T_TRANSIENT), task) as worker:
        found = worker.numbers(TOLERANCE, limit)[0].reshape(len(velocities), 2, -1)
    return np.array([np.delete(run, np.argmin(run[1]), axis=1) for run in found])


def coverage_rows(motion: str, runs: int, limit: float) -> list[dict]:
    """How often the true exponents lie within the error bars of shorter runs."""
    report(motion)
    [[true, _]] = measured(motion, [1.1], T_LONG, limit)
    found = measured(motion, VELOCITIES[:runs], T_SHORT, limit)
    away, error = found[:, 0] - true, found[:, 1]
    return [
        {
            **{"motion": motion, "length": T_SHORT, "runs": len(found)},
            **{"exponent": 1 + i, "value": float(value)},
            "rms": float(np.sqrt(np.mean(away[:, i] ** 2))),
            "error": float(np.sqrt(np.mean(error[:, i] ** 2))),
            "within": float(np.mean(abs(away[:, i]) <= ERROR_BARS * error[:, i])),
        }
        for i, value in enumerate(true)
    ]


def main() -> None:
    """Measure and write."""
    parser = options_of("exponents", time_limit=600.0)
    parser.add_argument("--motions", nargs="+", choices=list(MOTIONS), default=list(MOTIONS))
    parser.add_argument("--runs", type=int, default=len(VELOCITIES))
    options = parser.parse_args()
    rows = [
        row
        for motion in options.motions
        for row in coverage_rows(motion, options.runs, options.time_limit)
    ]
    meaning = "within: share of runs whose value is at most three of their errors from `value`"
    write_table(options.output / "exponent-coverage.tsv", rows, [meaning])
