"""Error and time of this project's solver and of others on the same scenes (benchmarks/run)."""

import math
import platform
import subprocess
import sys
from pathlib import Path

import numpy as np
from measuring import add_limits, describe_machine, first_line, options_of, write_table
from project import ROOT, TABLES, configuration
from work_precision import measure, ratios
from workers import OURS, Scene, Solver, SolverError, Worker, chosen_solvers

from scripts.files.tsv import read_table
from scripts.studies.work_precision.plan import cases_of
from scripts.tables.accuracy import read_references

HORIZONS = TABLES / "trusted-horizons.tsv"
CHOICES = (OURS, "jitcdde", "desolve", "desolve_interpol_2")
TOLERANCES = tuple(float(f"1e-{k}") for k in range(3, 14))
LEVELS = tuple(10.0**-k for k in range(4, 13))
"""Errors at which times are compared."""


def reference_path(name: str) -> Path:
    """Where the workflow puts a scene's reference."""
    return ROOT / "results" / "references" / "trust" / f"{name}.tsv"


def compute_references(names: list[str]) -> None:
    """Let the project's workflow make the references of the scenes and the table of horizons."""
    files = [path.relative_to(ROOT) for path in (HORIZONS, *map(reference_path, names))]
    subprocess.run([ROOT / "reproduce", *files, "--quiet", "all"], stdout=sys.stderr, check=True)


def scenes_up_to_horizons(cases: dict[str, dict]) -> dict[str, Scene]:
    """The scenes of the study, each up to the time to which it can be trusted."""
    horizons = {row["scene"]: row["horizon"] for row in read_table(HORIZONS)}
    return {
        name: Scene(
            **{key: float(case[key]) for key in ("tau", "epsilon", "xi", "gamma")},
            past=(case["history"]["theta"], case["history"]["u"], math.log(case["history"]["v"])),
            t_end=horizons[name],
            sample_interval=case["sample_interval"],
        )
        for name, case in cases.items()
    }


def read_reference(name: str, scene: Scene) -> np.ndarray:
    """The solution of a scene in quadruple precision: rows of the time, theta, u and ln v."""
    found = read_references([reference_path(name)])[name]
    count = round(scene.t_end / scene.sample_interval) + 1
    return np.column_stack([found.time, found.state.T])[:count]


def rows_of_scene(
    name: str, scene: Scene, solvers: dict[str, Solver], repeats: int, limit: float
) -> list[dict]:
    """All solvers and tolerances on one scene."""
    print(f"benchmarks: {name}", file=sys.stderr)
    workers = {solver: Worker(made.command, scene) for solver, made in solvers.items()}
    rows = measure(workers, read_reference(name, scene), TOLERANCES, repeats, limit)
    return [{"scene": name, **row} for row in rows]


def ratio_rows(rows: list[dict]) -> list[dict]:
    """For each scene and level: our seconds, and each solver's time over ours."""
    return [
        {"scene": scene, "error": level}
        | ratios([row for row in rows if row["scene"] == scene], level)
        for scene in dict.fromkeys(row["scene"] for row in rows)
        for level in LEVELS
    ]


def main() -> None:
    """Measure and write the tables."""
    cases = cases_of(configuration())
    parser = options_of("benchmarks/run", TABLES)
    parser.add_argument("--scenes", nargs="+", choices=list(cases), default=list(cases))
    parser.add_argument("--solvers", nargs="+", choices=CHOICES, default=CHOICES)
    add_limits(parser)
    options = parser.parse_args()
    solvers = chosen_solvers(options.solvers)
    try:
        compute_references(list(cases))
        scenes = scenes_up_to_horizons(cases)
        rows = [
            row
            for name in options.scenes
            for row in rows_of_scene(
                name, scenes[name], solvers, options.repeats, options.time_limit
            )
        ]
    except (subprocess.CalledProcessError, SolverError) as failure:
        raise SystemExit(f"benchmarks: {failure}") from None
    header = [
        *describe_machine(),
        f"{first_line('R', '--version')}; Python {platform.python_version()}",
        "seconds: CPU time of the solver alone, median of repeats in one process",
        "error_max: largest error of theta, u, ln v over the samples, relative where above 1",
    ]
    write_table(options.output / "benchmarks.tsv", rows, header)
    meaning = "columns of solvers: their time over ours, at equal error; empty where not reached"
    write_table(options.output / "benchmark-ratios.tsv", ratio_rows(rows), [*header, meaning])


if __name__ == "__main__":
    main()
