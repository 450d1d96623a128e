"""Cycles by DDE-BIFTOOL and by this project: special points, and the cost of an orbit
(benchmarks/run cycles)."""

import math
from pathlib import Path

from measuring import options_of, report, write_table
from workers import OURS, Task, Worker, command_of

from scripts.files.tsv import as_digits
from scripts.plans.studies import merged

LINES = ("torus_in_epsilon", "chaos_in_epsilon", "chaos_in_tau", "torus_in_tau")
"""Lines of the configuration."""
PARAMETERS = ("tau", "epsilon", "xi", "gamma")
INTERVALS, DEGREE = 40, 5
ORBITS = 90
"""Orbits that DDE-BIFTOOL follows from each Hopf point."""
KINDS = ("fold", "torus", "period_doubling")
NEAR = 1e-3
"""Points of one kind at this distance are the same."""


def follow(
    program: str, command: list[str], line: str, settings: dict, limit: float
) -> tuple[dict, list[tuple[str, float]]]:
    """Cost of the orbits of a line with their multipliers, and special points by kind and place."""
    start, end = settings["window"]
    place = [start if name == settings["along"] else settings[name] for name in PARAMETERS]
    task = Task((start, end, INTERVALS, DEGREE, ORBITS, *place))
    with Worker(command, task) as worker:
        table, seconds = worker.numbers(1e-9, limit)
    orbits, error = table[table[:, 0] == 0, 1].sum(), table[table[:, 0] == 0, 2].max()
    cost = {"line": line, "program": program, "orbits": int(orbits)}
    cost |= {"seconds_per_orbit": seconds / orbits, "multiplier_error": float(error)}
    return cost, [(KINDS[int(kind) - 1], value) for kind, value, _ in table if kind > 0]


def side_by_side(line: str, ours: list[tuple[str, float]], theirs: list[tuple[str, float]]) -> list:
    """Rows of the table of points: pairs, then what one of the two has alone."""
    left, rows = list(theirs), []
    for kind, value in ours:
        same = [point for point in left if point[0] == kind and abs(point[1] - value) < NEAR]
        other = min(same, key=lambda point: abs(point[1] - value), default=None)
        if other:
            left.remove(other)
        rows.append(row_of(line, kind, value, other[1] if other else math.nan))
    return rows + [row_of(line, kind, math.nan, value) for kind, value in left]


def row_of(line: str, kind: str, ours: float, theirs: float) -> dict:
    """A row of the table of points, with all digits."""
    both = {"ours": as_digits(ours, 12), "biftool": as_digits(theirs, 12)}
    return {"line": line, "kind": kind, **both, "difference": abs(ours - theirs)}


def main() -> None:
    """Measure and write."""
    parser = options_of("cycles", time_limit=600.0)
    parser.add_argument("--biftool", type=Path, required=True, help="folder of DDE-BIFTOOL")
    parser.add_argument("--lines", nargs="+", choices=LINES, default=LINES)
    options = parser.parse_args()
    if not (options.biftool / "ddebiftool" / "br_contn.m").exists():
        parser.error(f"--biftool {options.biftool}: a folder with ddebiftool/br_contn.m expected")
    costs, rows = [], []
    for line in options.lines:
        report(line)
        settings = merged("config.yaml")["cycles"]["lines"][line]
        along = settings["along"]
        where = (options.biftool.resolve(), 1 + PARAMETERS.index(along))
        commands = {
            OURS: command_of("delaykit", "cycles", along),
            "DDE-BIFTOOL": command_of("biftool", *where),
        }
        (our_cost, ours), (their_cost, theirs) = (
            follow(program, command, line, settings, options.time_limit)
            for program, command in commands.items()
        )
        costs += [our_cost, their_cost]
        rows += side_by_side(line, ours, theirs)
    write_table(options.output / "cycle-points-by-biftool.tsv", rows, ["places of special points"])
    write_table(options.output / "cycle-costs.tsv", costs, ["seconds_per_orbit: CPU time"])
