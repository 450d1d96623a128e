"""Chains of blocks by this project's package and by JiTCDDE (benchmarks/run chains)."""

import numpy as np
from measuring import error_max, measure, options_of, report, write_table
from workers import OURS, Task, Worker, command_of

PLACES = {0.8: (10.0, 0.5, 0.8), 1e8: (12.0, 0.62, 0.5)}
"""tau, epsilon and xi by gamma, at which blocks do not come to rest; kappa is 1."""
TOLERANCES = (1e-6, 1e-8)
APART = (0.0, 0.0, 0.5)
"""How far theta, u and ln v of blocks are apart for t <= 0: around 0, 0 and ln 1.1."""
T_SAMPLED, SAMPLE_INTERVAL = 40.0, 0.5
"""Errors and differences are the largest of theta, u, ln v over samples up to this time."""
T_ENDS = {1: 20000.0, 10: 2000.0, 100: 200.0, 1000: 40.0, 10000: 40.0}
"""Ends of the runs that are timed, by number of blocks."""
REFERENCE_TOLERANCE = 1e-12
COMPARED = {"free": (2, 3, 5, 20), "ring": (3, 5, 20), "plate": (2, 3, 5, 20)}
"""Numbers of blocks whose trajectories are compared, by ends."""
COMPARED_APART = (0.1, 0.1, 0.3)
COMPARED_TOLERANCES = (1e-8, 1e-10, 1e-12)
THEIR_TOLERANCE = 1e-11
"""Tolerance of JiTCDDE in comparisons."""


def task_of(blocks: int, gamma: float, apart: tuple, t_end: float = T_SAMPLED) -> Task:
    """A chain, whose blocks begin apart from each other."""
    share = np.random.default_rng(1).uniform(-1.0, 1.0, (blocks, 3))
    past = np.array([0.0, 0.0, np.log(1.1)]) + apart * share
    return Task((*PLACES[gamma], gamma, *past.ravel()), t_end, SAMPLE_INTERVAL)


def worker_of(solver: str, task: Task, ends: str = "free") -> Worker:
    """A solver of a chain, which takes kappa, the ends, and the last time of samples."""
    return Worker(command_of(solver, "chain", 1.0, ends, T_SAMPLED), task)


def cost_rows(blocks: int, gamma: float, options) -> list[dict]:
    """Rows of both solvers at all tolerances."""
    report(f"{blocks} blocks, gamma = {gamma:g}")
    task = task_of(blocks, gamma, APART, T_ENDS[blocks])
    workers = {OURS: worker_of("delaykit", task), "jitcdde": worker_of("jitcdde", task)}
    with workers[OURS] as ours:
        reference, _ = ours.numbers(REFERENCE_TOLERANCE, options.time_limit)
    rows = measure(workers, reference, TOLERANCES, options)
    scale = task.t_end * blocks
    return [
        {
            **{"blocks": blocks, "gamma": gamma, "tolerance": row["tolerance"]},
            **{"solver": row["solver"], "status": row["status"], "error_max": row["error_max"]},
            "seconds_per_time_and_block": row["seconds"] / scale,
            "set_up_seconds": workers[row["solver"]].set_up_seconds,
            "memory": row["memory"],
        }
        for row in rows
    ]


def difference_row(ends: str, blocks: int, limit: float) -> dict:
    """Differences of trajectories from the one by JiTCDDE at its tightest tolerance."""
    report(f"{blocks} blocks, {ends}")
    task = task_of(blocks, 0.8, COMPARED_APART)
    with worker_of("jitcdde", task, ends) as theirs, worker_of("delaykit", task, ends) as ours:
        others, _ = theirs.numbers(THEIR_TOLERANCE, limit)
        differences = {
            f"at {tolerance:g}": error_max(ours.numbers(tolerance, limit)[0], others)
            for tolerance in COMPARED_TOLERANCES
        }
    return {"ends": ends, "blocks": blocks, **differences}


def main() -> None:
    """Measure and write."""
    parser = options_of("chains", time_limit=100.0)
    parser.add_argument("--blocks", nargs="+", type=int, choices=list(T_ENDS), default=list(T_ENDS))
    options = parser.parse_args()
    differences = [
        difference_row(ends, blocks, options.time_limit)
        for ends, numbers in COMPARED.items()
        for blocks in numbers
    ]
    costs = [
        row
        for blocks in options.blocks
        for gamma in PLACES
        for row in cost_rows(blocks, gamma, options)
    ]
    meanings = [
        f"at {THEIR_TOLERANCE:g} by JiTCDDE, at other tolerances by this project's package:",
        f"largest differences of theta, u, ln v up to t = {T_SAMPLED:g}, relative above 1",
    ]
    write_table(options.output / "chain-differences.tsv", differences, meanings)
    meanings = [
        "seconds_per_time_and_block: CPU time without set-up, median of repeats",
        f"error_max: largest error of theta, u, ln v over samples up to t = {T_SAMPLED:g}; the",
        f"reference is this project's at {REFERENCE_TOLERANCE:g}",
        "set_up_seconds: CPU time in which the solver makes and compiles the equations",
        "memory: peak in MB, over that of the process at its start",
    ]
    write_table(options.output / "chain-costs.tsv", costs, meanings)
