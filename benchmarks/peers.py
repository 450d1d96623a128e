"""RADAR5 and RETARD beside this project's solver at equal error (benchmarks/run peers)."""

import math
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from compare import divide, measure_errors, measure_seconds, seconds_at
from measuring import BUILD, describe_machine, options_of, write_table
from solvers import OURS_BINARY, Scene, SolverError, Worker

from scripts.tables.accuracy import Reference

LEVELS = tuple(10.0**-k for k in range(3, 13))
"""Errors at which times are compared."""
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(4, 30))
"""Of both solvers: RADAR5 at t works with 0.1 t**(2/3), so that small errors need small ones."""
REFERENCE_TOLERANCE = 1e-13
SAMPLES = 200
PAPER = {"past": (0.0, 0.0, math.log(1.1)), "gamma": 0.8}
STIFF = {"epsilon": 0.7, "xi": 0.5, "past": (0.0, 0.0, 0.4), "tau": 1.0, "t_end": 50.0}
CHAOS = {"tau": 7.0, "epsilon": 0.7, "xi": 0.5, "t_end": 50.0, **PAPER}
TORUS = {"tau": 10.0, "epsilon": 0.5, "xi": 0.8, "t_end": 100.0, **PAPER}
CASES = {
    "gamma 30": ("radar5", (), {**STIFF, "gamma": 30.0}),
    "gamma 100, tau 3": ("radar5", (), {**STIFF, "gamma": 100.0, "tau": 3.0}),
    "gamma 1000": ("radar5", (), {**STIFF, "gamma": 1e3}),
    "gamma 1e4, tau 0.1": ("radar5", (), {**STIFF, "gamma": 1e4, "tau": 0.1}),
    "gamma 1e4, tau 0.001": ("radar5", (), {**STIFF, "gamma": 1e4, "tau": 1e-3, "t_end": 10.0}),
    "chaos": ("retard", (), CHAOS),
    "torus": ("retard", (), TORUS),
    "chaos, f only": ("retard", ("rhs",), CHAOS),
    "torus, f only": ("retard", ("rhs",), TORUS),
    "gamma 100, f only": ("radar5", ("rhs",), {**STIFF, "gamma": 100.0}),
    "gamma 1e4, f only": ("radar5", ("rhs",), {**STIFF, "gamma": 1e4}),
    "gamma 1e6, f only": ("radar5", ("rhs",), {**STIFF, "gamma": 1e6}),
}
"""For each case: the other solver, what makes ours use f only, and the scene, nondimensional."""


def reference_of(scene: Scene) -> Reference:
    """The solution by the method of order 13 at a tight tolerance."""
    with Worker([OURS_BINARY, "radau13"], scene) as worker, tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "samples.tsv"
        worker.sample(REFERENCE_TOLERANCE, path, 60.0)
        samples = np.loadtxt(path)
    unknown = np.full(len(samples), math.nan)
    return Reference(
        status="ok",
        time=samples[:, 0],
        state=samples[:, 1:].T,
        uncertainty=unknown,
        amplification=unknown,
    )


def ratios_of(name: str, repeats: int, limit: float) -> list[dict]:
    """For each error: our seconds, and the other solver's time over ours."""
    other, form, parameters = CASES[name]
    scene = Scene(name=name, sample_interval=parameters["t_end"] / SAMPLES, **parameters)
    reference = reference_of(scene)
    workers = {
        "ours": Worker([OURS_BINARY, "auto", *form], replace(scene)),
        other: Worker([str(BUILD / f"{other}_worker")], replace(scene)),
    }
    rows = []
    try:
        for solver, worker in workers.items():
            found = measure_errors(worker, reference, limit, TOLERANCES)
            rows += [{"solver": solver, **row} for row in found]
        measure_seconds(rows, workers, repeats, limit)
    finally:
        for worker in workers.values():
            worker.stop()
    points = {
        solver: [
            (row["error_max"], row["seconds"])
            for row in rows
            if (row["solver"], row["status"]) == (solver, "ok")
        ]
        for solver in workers
    }
    found = []
    for level in LEVELS:
        ours = seconds_at(level, points["ours"])
        ratio = divide(seconds_at(level, points[other]), ours)
        row = {"case": name, "solver": other, "error": level, "our_seconds": ours}
        found.append({**row, "ratio": ratio})
    return found


def main() -> None:
    """Measure and write the table."""
    parser = options_of("peers")
    parser.add_argument("--cases", nargs="+", choices=list(CASES), default=list(CASES))
    parser.add_argument("--time-limit", type=float, default=60.0)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    try:
        rows = [
            row
            for name in options.cases
            for row in ratios_of(name, options.repeats, options.time_limit)
        ]
    except SolverError as failure:
        raise SystemExit(f"benchmarks: {failure}") from None
    header = [
        *describe_machine(),
        "our_seconds: CPU time of the solver alone, median of repeats in one process",
        "error: largest of theta, u, ln v over 201 samples, relative where above 1",
        "ratio: the other solver's time over ours at equal error; empty where not reached",
    ]
    write_table(options.output / "peers.tsv", rows, header)


if __name__ == "__main__":
    main()
