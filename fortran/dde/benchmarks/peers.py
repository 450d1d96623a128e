# SPDX-License-Identifier: BSD-3-Clause
"""Other solvers beside this one at equal error (run peers).

A cell is a problem and what it gives besides f: nothing, its derivatives (jacobian), or its Taylor
series. RADAR5 is given derivatives where this solver is; RETARD, JiTCDDE and deSolve use f alone.
"""

import math
import statistics
from dataclasses import dataclass

from measuring import add_limits, describe_machine, options_of, write_table
from work_precision import count_instructions, measure, ratios, spread
from workers import OURS, SOLVERS, Scene, SolverError, Worker, chosen_solvers

LEVELS = tuple(10.0**-k for k in range(3, 13))
"""Errors at which times are compared."""
COUNTED = LEVELS[:4]
"""Errors at which instructions are compared: those that most users ask for."""
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(4, 30))
"""Of all solvers: RADAR5 at t works with 0.1 t**(2/3), so that small errors need small ones."""
REFERENCE_TOLERANCE = 1e-13
SAMPLES = 200


@dataclass(frozen=True)
class Case:
    """A problem, nondimensional, and the kind of solvers that it is for."""

    kind: str
    scene: dict
    given: tuple[str, ...]
    """What it can give besides f"""
    problem: str = "block"


def block(tau: float, epsilon: float, xi: float, gamma: float, t_end: float, past=None) -> Case:
    """The block; stiff where gamma is large."""
    scene = {"tau": tau, "epsilon": epsilon, "xi": xi, "gamma": gamma, "t_end": t_end}
    if gamma > 10.0:
        scene["past"] = past or (0.0, 0.0, 0.4)
        return Case("stiff", scene, ("f", "jacobian", "series"))
    scene["past"] = past or (0.0, 0.0, math.log(1.1))
    return Case("mild", scene, ("f", "series"))


def published(problem: str, t_end: float, *given: str, kind: str = "mild") -> Case:
    """A problem that has its own parameters."""
    nothing = {"tau": 0.0, "epsilon": 0.0, "xi": 0.0, "gamma": 0.0, "past": (0.0, 0.0, 0.0)}
    return Case(kind, {**nothing, "t_end": t_end}, given, problem)


CASES = {
    "fixed_point": block(0.0, 0.3, 0.8, 0.8, 100.0),
    "oscillation": block(10.0, 0.35, 0.8, 0.8, 100.0),
    "torus": block(10.0, 0.5, 0.8, 0.8, 100.0),
    "chaos": block(7.0, 0.7, 0.5, 0.8, 50.0),
    "true_torus": block(12.5, 0.5, 0.8, 0.8, 100.0),
    "stick_slip": block(0.1, 2.0, 0.5, 1e4, 50.0, (0.0, 0.0, math.log(1.1))),
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
}
"""The six scenes of the paper, stiffer blocks, and published problems."""


def command_of(solver: str, case: Case, given: str) -> list[str]:
    """The command of a solver for a case."""
    program, *method = SOLVERS[solver].command
    if not SOLVERS[solver].any_problem:
        return SOLVERS[solver].command
    if solver == "radar5" and given == "series":
        given = "jacobian"
    return [program.replace("block", case.problem), *method, given]


def cell_rows(name: str, given: str, others: list[str], repeats: int, limit: float, count: bool):
    """For each solver and each error: our seconds, and its cost over ours."""
    case = CASES[name]
    scene = Scene(sample_interval=case.scene["t_end"] / SAMPLES, **case.scene)
    command = command_of(OURS, case, case.given[-1])
    with Worker([command[0], "radau13", command[-1]], scene) as worker:
        reference = worker.samples(REFERENCE_TOLERANCE, limit)
    workers = {one: Worker(command_of(one, case, given), scene) for one in (OURS, *others)}
    rows = measure(workers, reference, TOLERANCES, repeats, limit)
    if count:
        count_instructions(rows, workers, (COUNTED[-1] / 10, COUNTED[0] * 100))
    counted = [row for row in rows if "instructions" in row]
    found = []
    for other in others:
        for level in LEVELS:
            of_time = ratios(rows, level)
            of_count = ratios(counted, level, lambda row: row["instructions"]) if counted else {}
            least, most = spread(rows, level, other) or (None, None)
            row = {"case": name, "given": given, "solver": other, "error": level}
            row |= {"our_seconds": of_time["our_seconds"], "ratio": of_time[other]}
            row |= {"least": least, "most": most}
            found.append(row | {"instructions": of_count.get(other) if level in COUNTED else None})
    return found


def show(rows: list[dict]) -> None:
    """Print a table for each solver and what it is given, the worst cells first."""
    pairs = dict.fromkeys((row["solver"], row["given"]) for row in rows)
    for solver, given in pairs:
        own = [row for row in rows if (row["solver"], row["given"]) == (solver, given)]
        cases = {name: [row for row in own if row["case"] == name] for name in CASES}
        known = [row["ratio"] for row in own if row["ratio"]]
        if not known:
            continue
        print(f"\n{solver} over this solver, {given}: geometric mean "
              f"{statistics.geometric_mean(known):.2f}, least {min(known):.2f}")  # fmt: skip
        print(f"{'error':22}" + "".join(f"{level:>18.0e}" for level in LEVELS))
        least = {
            name: min((row["ratio"] for row in found if row["ratio"]), default=math.inf)
            for name, found in cases.items()
            if found
        }
        for name in sorted(least, key=least.get):
            print(f"{name:22}" + "".join(f"{cell_of(row):>18}" for row in cases[name]))


def cell_of(row: dict) -> str:
    """A ratio with its spread."""
    if not row["ratio"]:
        return "-"
    return f"{row['ratio']:.2f} ({row['least'] or 0:.2f}-{row['most'] or 0:.2f})"


def main() -> None:
    """Measure and write the table."""
    others = [name for name in SOLVERS if name != OURS]
    parser = options_of("run peers")
    parser.add_argument("--cases", nargs="+", choices=list(CASES), default=list(CASES))
    parser.add_argument("--solvers", nargs="+", choices=others, default=["radar5", "retard"])
    parser.add_argument("--count", action="store_true")
    add_limits(parser)
    options = parser.parse_args()
    solvers = chosen_solvers(options.solvers)
    rows = []
    try:
        for name in options.cases:
            own = [o for o, made in solvers.items() if o != OURS and CASES[name].kind in made.kinds]
            if CASES[name].problem != "block":
                own = [other for other in own if SOLVERS[other].any_problem]
            for given in CASES[name].given if own else ():
                rows += cell_rows(
                    name, given, own, options.repeats, options.time_limit, options.count
                )
    except SolverError as failure:
        raise SystemExit(f"benchmarks: {failure}") from None
    if not rows:
        raise SystemExit("benchmarks: none of the solvers is for one of the cases")
    show(rows)
    header = [
        *describe_machine(),
        "given: what the problem gives this solver and RADAR5 besides f",
        "our_seconds: CPU time of the solver alone, median of repeats in one process",
        "error: largest over 201 samples, relative where above 1",
        "ratio: the other solver's time over ours at equal error; empty where not reached",
        "least, most: of the ratios of single repeats; instructions: ratio of counts",
    ]
    write_table(options.output / "peers.tsv", rows, header)


if __name__ == "__main__":
    main()
