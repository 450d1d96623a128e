"""The scenes of the study work_precision in other solvers, up to their horizons and against the
references in quadruple precision of the workflow (benchmarks/run scenes)."""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
from peers import Case, compare, options_of_peers
from workers import Task

from scripts.config.check_config import checked
from scripts.files.tsv import read_table
from scripts.plans.studies import merged
from scripts.studies.work_precision.plan import cases_of
from scripts.tables.accuracy import read_references

ROOT = Path(__file__).resolve().parents[1]
HORIZONS = "results/tables/trusted-horizons.tsv"
REFERENCE = "results/references/trust/{}.tsv"
"""Where the workflow puts a scene's reference."""
TOLERANCES = tuple(float(f"1e-{k}") for k in range(3, 14))


def case_of(scene: dict, horizon: float) -> Case:
    """A scene up to the time to which it can be trusted; all solvers try it."""
    history = scene["history"]
    past = (history["theta"], history["u"], math.log(history["v"]))
    parameters = (*(float(scene[key]) for key in ("tau", "epsilon", "xi", "gamma")), *past)
    task = Task(parameters, horizon, scene["sample_interval"])
    return Case(task, ("series",), "mild")


def read_reference(name: str, task: Task) -> np.ndarray:
    """The solution of a scene in quadruple precision: rows of the time, theta, u and ln v."""
    found = read_references([ROOT / REFERENCE.format(name)])[name]
    count = round(task.t_end / task.sample_interval) + 1
    return np.column_stack([found.time, found.state.T])[:count]


def main() -> None:
    """Measure and write."""
    scenes = cases_of(checked(merged("config.yaml")))
    solvers = ("jitcdde", "desolve", "desolve_interpol_2")
    options = options_of_peers("scenes", list(scenes), *solvers)
    files = [HORIZONS, *map(REFERENCE.format, scenes)]
    made = [ROOT / "reproduce", *files, "--quiet", "all"]
    subprocess.run(made, stdout=sys.stderr, check=True)
    horizons = {row["scene"]: row["horizon"] for row in read_table(ROOT / HORIZONS)}
    cases = {name: case_of(scenes[name], horizons[name]) for name in options.cases}
    compare(
        *("scenes", cases, options, TOLERANCES),
        reference=lambda name: read_reference(name, cases[name].task),
    )
