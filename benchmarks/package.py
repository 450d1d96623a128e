"""delaykit and other packages for Python on the equation of Mackey and Glass, and on networks
(benchmarks/run package).

The time is that of the loosest tolerance whose error is small enough.
"""

import argparse
import os
from dataclasses import dataclass

import numpy as np
from measuring import measure_errors, options_of, report, time_in_turns, write_table
from workers import Task, Worker, command_of

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
    """A task of workers in words, its largest error, and what it is compared with: pairs of a time,
    or a delay, and the value; by default those of delaykit at a tight tolerance."""

    meaning: str
    words: tuple
    task: Task
    error: float = 1e-6
    exact: tuple = ()
    fresh: bool = False
    peers: tuple[str, ...] = PEERS


RUN = ("run",), Task((TAU_CYCLE, *TIMES_OF_RUN))
FIRST = ("run",), Task((TAU_CHAOS, 200.0))
T_PHASES = 20.0
BOTH = ("delaykit", "jitcdde")
SPECTRUM = ("spectrum", 4, T_TRANSIENT), Task((TAU_CHAOS,), T_TRANSIENT + T_EXPONENTS)
SCAN = ("scan", T_EARLY), Task(TAUS, T_SCAN)
ROWS = {
    "first": Row("first line to first number, y(200)", *FIRST, 1e-6, ((200.0, PUBLISHED),), True),
    "run": Row("1e4 delays, a cycle", *RUN),
    "tight": Row("the same, error 1e-9", *RUN, 1e-9),
    "exponents": Row(
        *("4 exponents over 2e4 units", *SPECTRUM, CLOSE, ((TAU_CHAOS, LARGEST),)),
        peers=BOTH,
    ),
    "scan": Row(f"scan of 400 values, {os.cpu_count()} cores", *SCAN),
}
for n in (10, 30, 100):
    kuramoto = (("kuramoto",), Task((float(n),), T_PHASES))
    words = f"{n} phases, {n * (n - 1)} delays"
    ROWS[f"phases_{n}_first"] = Row(
        f"{words}: to the first number", *kuramoto, 1e-5, fresh=True, peers=BOTH
    )
    ROWS[f"phases_{n}"] = Row(f"{words}: a run", *kuramoto, 1e-5, peers=BOTH)


def rows_of(name: str, options: argparse.Namespace) -> list[dict]:
    """A row for each peer, of the loosest tolerance that passes; the last if none does."""
    row = ROWS[name]
    workers = {
        peer: Worker(command_of(peer, *row.words), row.task, fresh=row.fresh)
        for peer in options.peers
        if peer in row.peers
    }
    exact = np.array(row.exact)
    if not row.exact:
        with Worker(command_of("delaykit", *row.words), row.task) as worker:
            exact, _ = worker.numbers(1e-13, options.time_limit)
    found = []
    try:
        for peer, worker in workers.items():
            report(f"{name}, {peer}")
            errors = measure_errors(worker, exact, TOLERANCES, options.time_limit)
            passing = [one for one in errors if one["error_max"] <= row.error]
            status = {} if passing else {"status": f"not {row.error:g}: {errors[-1]['status']}"}
            own = {"task": row.meaning, "solver": peer, "version": worker.version}
            found.append(own | (passing or errors[-1:])[0] | status)
        time_in_turns(found, workers, options.repeats, options.time_limit)
    finally:
        for worker in workers.values():
            worker.stop()
    columns = ("task", "solver", "version", "status", "tolerance", "error_max", "clock", "seconds")
    return [{key: one.get(key, np.nan) for key in columns} for one in found]


def main() -> None:
    """Measure and write."""
    parser = options_of("package", time_limit=120.0)
    parser.add_argument("--tasks", nargs="+", choices=list(ROWS), default=list(ROWS))
    parser.add_argument("--peers", nargs="+", choices=PEERS, default=PEERS)
    options = parser.parse_args()
    rows = [row for name in options.tasks for row in rows_of(name, options)]
    meaning = "clock, seconds: by the clock and of CPU, median of repeats"
    write_table(options.output / "package.tsv", rows, [meaning])
