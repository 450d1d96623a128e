# SPDX-License-Identifier: BSD-3-Clause
"""Other solvers beside this one at equal error (run peers)."""

import math

from measuring import add_limits, describe_machine, options_of, write_table
from work_precision import measure, ratios
from workers import OURS, SOLVERS, Scene, Solver, SolverError, Worker, chosen_solvers

LEVELS = tuple(10.0**-k for k in range(3, 13))
"""Errors at which times are compared."""
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(4, 30))
"""Of all solvers: RADAR5 at t works with 0.1 t**(2/3), so that small errors need small ones."""
REFERENCE_TOLERANCE = 1e-13
SAMPLES = 200
PAPER = {"past": (0.0, 0.0, math.log(1.1)), "gamma": 0.8}
STIFF = {"epsilon": 0.7, "xi": 0.5, "past": (0.0, 0.0, 0.4), "tau": 1.0, "t_end": 50.0}
CHAOS = {"tau": 7.0, "epsilon": 0.7, "xi": 0.5, "t_end": 50.0, **PAPER}
TORUS = {"tau": 10.0, "epsilon": 0.5, "xi": 0.8, "t_end": 100.0, **PAPER}
CASES = {
    "gamma 30": ("stiff", (), {**STIFF, "gamma": 30.0}),
    "gamma 100, tau 3": ("stiff", (), {**STIFF, "gamma": 100.0, "tau": 3.0}),
    "gamma 1000": ("stiff", (), {**STIFF, "gamma": 1e3}),
    "gamma 1e4, tau 0.1": ("stiff", (), {**STIFF, "gamma": 1e4, "tau": 0.1}),
    "gamma 1e4, tau 0.001": ("stiff", (), {**STIFF, "gamma": 1e4, "tau": 1e-3, "t_end": 10.0}),
    "chaos": ("mild", (), CHAOS),
    "torus": ("mild", (), TORUS),
    "chaos, f only": ("mild", ("rhs",), CHAOS),
    "torus, f only": ("mild", ("rhs",), TORUS),
    "gamma 100, f only": ("stiff", ("rhs",), {**STIFF, "gamma": 100.0}),
    "gamma 1e4, f only": ("stiff", ("rhs",), {**STIFF, "gamma": 1e4}),
    "gamma 1e6, f only": ("stiff", ("rhs",), {**STIFF, "gamma": 1e6}),
}
"""For each case: its kind, what makes this solver use f only, and the scene, nondimensional."""


def ratio_rows(name: str, solvers: dict[str, Solver], repeats: int, limit: float) -> list[dict]:
    """For each solver of the kind of a case and each error: our seconds, and its time over ours."""
    kind, form, parameters = CASES[name]
    others = [solver for solver, made in solvers.items() if solver != OURS and kind in made.kinds]
    if not others:
        return []
    scene = Scene(sample_interval=parameters["t_end"] / SAMPLES, **parameters)
    with Worker([SOLVERS[OURS].command[0], "radau13"], scene) as worker:
        reference = worker.samples(REFERENCE_TOLERANCE, limit)
    workers = {
        solver: Worker([*solvers[solver].command, *(form if solver == OURS else ())], scene)
        for solver in (OURS, *others)
    }
    rows = measure(workers, reference, TOLERANCES, repeats, limit)
    found = {level: ratios(rows, level) for level in LEVELS}
    return [
        {
            "case": name,
            "solver": solver,
            "error": level,
            "our_seconds": found[level]["our_seconds"],
            "ratio": found[level][solver],
        }
        for solver in others
        for level in LEVELS
    ]


def main() -> None:
    """Measure and write the table."""
    others = [name for name in SOLVERS if name != OURS]
    parser = options_of("run peers")
    parser.add_argument("--cases", nargs="+", choices=list(CASES), default=list(CASES))
    parser.add_argument("--solvers", nargs="+", choices=others, default=["radar5", "retard"])
    add_limits(parser)
    options = parser.parse_args()
    solvers = chosen_solvers(options.solvers)
    try:
        rows = [
            row
            for name in options.cases
            for row in ratio_rows(name, solvers, options.repeats, options.time_limit)
        ]
    except SolverError as failure:
        raise SystemExit(f"benchmarks: {failure}") from None
    if not rows:
        raise SystemExit("benchmarks: none of the solvers is for one of the cases")
    header = [
        *describe_machine(),
        "our_seconds: CPU time of the solver alone, median of repeats in one process",
        "error: largest of theta, u, ln v over 201 samples, relative where above 1",
        "ratio: the other solver's time over ours at equal error; empty where not reached",
    ]
    write_table(options.output / "peers.tsv", rows, header)


if __name__ == "__main__":
    main()
