"""Cost of a step of this solver with many equations and many delays (benchmarks/run sizes)."""

import argparse
import itertools
import math

from measuring import options_of, report, time_in_turns, write_table
from workers import OURS, Task, Worker, command_of

FAMILIES = {
    "equations": lambda size: (size, size, 0.0),
    "delays": lambda size: (1, size, 1.0),
    "both": lambda size: (size, size, 1.0),
}
"""Numbers of equations and delays, and the longest delay less the shortest: n equations with one
delay, one equation with n delays, and n equations each with its own."""
SIZES = (1, 10, 100, 1000, 10_000)
METHODS = {
    "bs5": ("f",),
    "dop853": ("f",),
    "taylor": ("series",),
    "radau5": ("f", "jacobian"),
    "radau13": ("f", "jacobian"),
}
"""Each with what the problem gives."""
T_END = 20.0
TOLERANCE = 1e-6


def row_of(
    family: str, size: int, method: str, given: str, options: argparse.Namespace, count: bool
) -> dict:
    """A row of the table; the method and evaluations of f alone take turns."""
    task = Task(FAMILIES[family](size), T_END)
    workers = {
        name: Worker(command_of(OURS, problem="cells", method=name, given=given), task)
        for name in (method, "f")
    }
    rows = [{"solver": name, "tolerance": TOLERANCE, "status": "ok"} for name in workers]
    try:
        [[[accepted, steps, evaluations]], [[_, _, calls]]] = (
            worker.numbers(TOLERANCE, options.time_limit)[0] for worker in workers.values()
        )
        time_in_turns(rows, workers, options.repeats, options.time_limit)
        memory = workers[method].memory()
        costs = [rows[0]["seconds"] / steps, rows[1]["seconds"] / calls]
        counts = [math.nan, math.nan]
        if count:
            counts = [worker.instructions(TOLERANCE) for worker in workers.values()]
            counts = [counts[0] / steps, counts[0] / steps / (counts[1] / calls)]
    finally:
        for worker in workers.values():
            worker.stop()
    row = {"family": family, "size": size, "method": method, "given": given}
    row |= {"accepted": int(accepted), "steps": int(steps), "evaluations": int(evaluations)}
    row |= {"microseconds": 1e6 * costs[0], "over_f": costs[0] / costs[1]}
    row |= {"instructions": counts[0], "instructions_over_f": counts[1], "memory": memory}
    return row


def main() -> None:
    """Measure and write."""
    parser = options_of("sizes")
    parser.add_argument("--count", action="store_true")
    parser.add_argument("--sizes", nargs="+", type=int, choices=SIZES, default=SIZES)
    options = parser.parse_args()
    rows = []
    for family, size in itertools.product(FAMILIES, options.sizes):
        report(f"{family}, {size}")
        rows += [
            row_of(family, size, method, given, options, options.count)
            for method, all_given in METHODS.items()
            for given in all_given
        ]
    meanings = [
        "family: equations with one delay, delays of one equation, or both, each with its own",
        "given: what the problem gives besides f; differences are banded where only f is given",
        f"tolerance {TOLERANCE:g}, t = 0 to {T_END:g}; steps: with rejected ones",
        "microseconds: CPU time of a step, over_f: over that of one evaluation of f",
        "instructions: of a run over its steps, instructions_over_f: over those of f",
        "memory: peak of the runs in MB, over that of the process at its start",
    ]
    write_table(options.output / "sizes.tsv", rows, meanings)
