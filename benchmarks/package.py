"""delaykit and other packages for Python on the equation of Mackey and Glass (benchmarks/run
package).

Each task is tried with tighter and tighter tolerances until its error is small enough. The time is
that of the loosest tolerance that passes.
"""

import math
import os
from dataclasses import dataclass

import numpy as np
from measuring import options_of, report, time_in_turns, write_table
from workers import SolverError, Task, Worker, command_of

PEERS = ("delaykit", "jitcdde", "ddeint", "scipy")
TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12)
TAU_CHAOS, TAU_CYCLE = 17.0, 6.0
T_RUN = 1e4 * TAU_CYCLE
TIMES_OF_RUN = T_RUN - np.linspace(20, 0, 11)
PUBLISHED = 1.186718107117
"""y(200) with tau = 17: fortran/dde/README.md"""
LARGEST, CLOSE = 0.0052, 0.001
"""Published largest exponent with tau = 17, and how near a value over 2e4 units can be."""
T_TRANSIENT, T_EXPONENTS = 1700.0, 20000.0
TAUS = tuple(np.linspace(5, 25, 400))
T_SCAN, T_EARLY = 2000.0, 50.0
"""Length of the runs of a scan, and when their error is taken: later it is that of chaos."""


@dataclass(frozen=True)
class Row:
    """A task of workers, in words, and its largest error."""

    meaning: str
    words: tuple
    task: Task
    error: float = 1e-6
    fresh: bool = False
    peers: tuple[str, ...] = PEERS


RUN = Task((TAU_CYCLE, *TIMES_OF_RUN))
ROWS = {
    "first": Row(
        *("first line to first number, y(200)", ("run",), Task((TAU_CHAOS, 200.0))), fresh=True
    ),
    "run": Row("1e4 delays, a cycle", ("run",), RUN),
    "tight": Row("the same, error 1e-9", ("run",), RUN, error=1e-9),
    "exponents": Row(
        *("4 exponents over 2e4 units", ("spectrum", 4, T_TRANSIENT)),
        Task((TAU_CHAOS,), T_TRANSIENT + T_EXPONENTS),
        error=CLOSE,
        peers=("delaykit", "jitcdde"),
    ),
    "scan": Row(
        *(f"scan of 400 values, {os.cpu_count()} cores", ("scan", T_EARLY), Task(TAUS, T_SCAN)),
        peers=("delaykit", "jitcdde", "scipy"),
    ),
}


def expected(name: str, limit: float) -> np.ndarray:
    """What the numbers begin with: published, or those of delaykit at a tight tolerance."""
    if name in ("first", "exponents"):
        return np.array([PUBLISHED if name == "first" else LARGEST])
    row = ROWS[name]
    with Worker(command_of("delaykit", *row.words), row.task) as worker:
        return numbers_of(worker, 1e-13, limit)


def numbers_of(worker: Worker, tolerance: float, limit: float) -> np.ndarray:
    """The states of samples; of exponents all."""
    table, _ = worker.numbers(tolerance, limit)
    return table[0] if len(table) == 1 and table.size > 2 else table[:, -1]


def row_of(peer: str, name: str, exact: np.ndarray, options) -> dict:
    """Time and error of the loosest tolerance whose error is small enough; empty if none is."""
    row = {"task": ROWS[name].meaning, "peer": peer, "version": "", "tolerance": math.nan}
    row |= {"error": math.nan, "clock": math.nan, "cpu": math.nan, "status": "too inaccurate"}
    one = ROWS[name]
    with Worker(command_of(peer, *one.words), one.task, fresh=one.fresh) as worker:
        for tolerance in TOLERANCES:
            try:
                found = numbers_of(worker, tolerance, options.time_limit)
            except SolverError as failure:
                return row | {"version": worker.version, "status": str(failure)}
            error = float(abs(found[: len(exact)] - exact).max())
            report(f"{peer}, {name}, {tolerance:g}: error {error:.1g}")
            if error <= one.error:
                timed = {"solver": peer, "tolerance": tolerance, "status": "ok"}
                time_in_turns([timed], {peer: worker}, options.repeats, options.time_limit)
                row |= {"tolerance": tolerance, "error": error, "status": timed["status"]}
                row |= {"clock": timed.get("clock"), "cpu": timed.get("seconds")}
                break
        return row | {"version": worker.version}


def main() -> None:
    """Measure and write."""
    parser = options_of("package", time_limit=120.0)
    parser.add_argument("--tasks", nargs="+", choices=list(ROWS), default=list(ROWS))
    parser.add_argument("--peers", nargs="+", choices=PEERS, default=PEERS)
    options = parser.parse_args()
    rows = []
    for name in options.tasks:
        exact = expected(name, options.time_limit)
        peers = [peer for peer in options.peers if peer in ROWS[name].peers]
        rows += [row_of(peer, name, exact, options) for peer in peers]
    meaning = "clock, cpu: seconds of the loosest tolerance with this error, median of repeats"
    write_table(options.output / "package.tsv", rows, [meaning])
