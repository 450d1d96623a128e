"""Other solvers beside this one at equal error (benchmarks/run peers).

A cell is a problem and what it gives besides f: nothing, its derivatives (jacobian), or its Taylor
series. RADAR5 is given derivatives where this solver is, and those by delayed values where delays
move: without them it looks for no breaking points. RETARD, JiTCDDE and deSolve use f alone.
"""

import argparse
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from measuring import measure, options_of, ratio_row, report, write_table
from workers import OURS, SOLVERS, Task, Worker, command_of

LEVELS = tuple(10.0**-k for k in range(3, 13))
"""Errors at which times are compared."""
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(4, 30))
"""Of all solvers: RADAR5 at t works with 0.1 t**(2/3), so that small errors need small ones."""
REFERENCE_TOLERANCE = 1e-13
SAMPLES = 200


@dataclass(frozen=True)
class Case:
    """A problem, and the kind of solvers that it is for."""

    task: Task
    given: tuple[str, ...]
    """What it can give besides f"""
    kind: str
    problem: str = "block"


def block(tau: float, epsilon: float, xi: float, gamma: float, t_end: float, v=None) -> Case:
    """The block, from near steady sliding; stiff where gamma is large."""
    stiff = gamma > 10.0
    past = (0.0, 0.0, math.log(v) if v else 0.4 if stiff else math.log(1.1))
    task = Task((tau, epsilon, xi, gamma, *past), t_end, t_end / SAMPLES)
    if stiff:
        return Case(task, ("f", "jacobian", "series"), "stiff")
    return Case(task, ("f", "series"), "mild")


def published(problem: str, t_end: float, *given: str, kind: str = "mild") -> Case:
    """A problem that has its own parameters."""
    return Case(Task((), t_end, t_end / SAMPLES), given, kind, problem)


CASES = {
    "fixed_point": block(0.0, 0.3, 0.8, 0.8, 100.0),
    "oscillation": block(10.0, 0.35, 0.8, 0.8, 100.0),
    "torus": block(10.0, 0.5, 0.8, 0.8, 100.0),
    "chaos": block(7.0, 0.7, 0.5, 0.8, 50.0),
    "true_torus": block(12.5, 0.5, 0.8, 0.8, 100.0),
    "stick_slip": block(0.1, 2.0, 0.5, 1e4, 50.0, v=1.1),
    "gamma 30": block(1.0, 0.7, 0.5, 30.0, 50.0),
    "gamma 100, tau 3": block(3.0, 0.7, 0.5, 100.0, 50.0),
    "gamma 1000": block(1.0, 0.7, 0.5, 1e3, 50.0),
    "gamma 1e4, tau 0.1": block(0.1, 0.7, 0.5, 1e4, 50.0),
    "gamma 1e4, tau 0.001": block(1e-3, 0.7, 0.5, 1e4, 10.0),
    "gamma 1e6": block(1.0, 0.7, 0.5, 1e6, 50.0),
    "mackey_glass": published("mackey_glass", 200.0, "f", "series"),
    "infection": published("infection", 40.0, "f", "series"),
    "wille_baker": published("wille_baker", 5.0, "f", "series"),
    "enzyme": published("enzyme", 160.0, "f", kind="stiff"),
    "waltman": published("waltman", 300.0, "f", "jacobian", kind="stiff"),
    "paul": published("paul", 10.0, "f", "jacobian", kind="moving"),
    "pantograph": published("pantograph", 100.0, "f", "jacobian", kind="moving"),
}
"""Scenes of the paper, stiffer blocks, and published problems; delays of the last three move."""


def others_of(case: Case, names: list[str]) -> list[str]:
    """Solvers that are for a case: some know the block alone."""
    return [
        name
        for name in names
        if case.kind in SOLVERS[name].kinds
        and (case.problem == "block" or "{problem}" in SOLVERS[name].command)
    ]


def reference_of(case: Case, limit: float) -> np.ndarray:
    """Samples by this solver's method of the highest order, with all that the problem gives."""
    filled = {"problem": case.problem, "given": case.given[-1]}
    with Worker(command_of(OURS, **filled, method="radau13"), case.task) as worker:
        return worker.numbers(REFERENCE_TOLERANCE, limit)[0]


def compare(
    name: str,
    cases: dict[str, Case],
    options: argparse.Namespace,
    tolerances: tuple[float, ...] = TOLERANCES,
    reference: Callable[[str], np.ndarray] | None = None,
) -> None:
    """Measure all cells, and write a table of all runs and one of ratios."""
    runs, ratios = [], []
    for scene, case in cases.items():
        others = others_of(case, options.solvers)
        for given in case.given if others else ():
            report(f"{scene}, {given}")
            filled = {"problem": case.problem, "given": given, "method": "auto"}
            workers = {one: Worker(command_of(one, **filled), case.task) for one in (OURS, *others)}
            exact = reference(scene) if reference else reference_of(case, options.time_limit)
            rows = measure(workers, exact, tolerances, options, count=options.count)
            cell = {"given": given, "scene": scene}
            runs += [
                cell | {key: value for key, value in row.items() if key not in ("turns", "clock")}
                for row in rows
            ]
            ratios += [
                {"case": scene, "given": given, "solver": other, "error": level}
                | ratio_row(rows, other, level)
                for other in others
                for level in LEVELS
            ]
    if not runs:
        raise SystemExit("benchmarks: none of the solvers is for one of the cases")
    meanings = [
        "given: what the problem gives this solver and RADAR5 besides f",
        "seconds: CPU time of the solver alone, median of repeats in one process",
        "error: largest over all samples, relative where above 1; of waltman over its largest",
    ]
    write_table(options.output / f"{name}-runs.tsv", runs, meanings)
    meanings += [
        "ratio: the other solver's time over ours at equal error; empty where not reached",
        "least, most: of the ratios of single repeats; instructions: ratio of counts",
    ]
    write_table(options.output / f"{name}.tsv", ratios, meanings)


def options_of_peers(name: str, cases: list[str], *solvers: str) -> argparse.Namespace:
    """Which cases and solvers are asked for, and how; `solvers` are those by default."""
    others = [other for other, solver in SOLVERS.items() if solver.kinds and other != OURS]
    parser = options_of(name)
    parser.add_argument("--cases", nargs="+", choices=cases, default=cases)
    parser.add_argument("--solvers", nargs="+", choices=others, default=list(solvers))
    parser.add_argument("--count", action="store_true")
    return parser.parse_args()


def main() -> None:
    """Measure and write."""
    options = options_of_peers("peers", list(CASES), "radar5", "retard")
    compare("peers", {name: CASES[name] for name in options.cases}, options)
