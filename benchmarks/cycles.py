"""Cycles by DDE-BIFTOOL and by this project: special points, and the cost of an orbit."""

import argparse
import os
import resource
import subprocess
import tempfile
from pathlib import Path

import xarray as xr
from compare import first_line, machine, write_table
from scenes import ROOT
from workers import BUILD, HERE

from scripts.config.check_config import checked
from scripts.config.read_config import read
from scripts.namelists.program_groups import cycles_groups
from scripts.namelists.study_cases import PARAMETERS
from scripts.namelists.write_namelist import write_namelist

LINES = ("torus_in_epsilon", "chaos_in_epsilon", "chaos_in_tau", "torus_in_tau")
"""Lines of the configuration."""
MESH = {"intervals": 40, "degree": 5}
ORBITS = 90
"""Orbits that DDE-BIFTOOL follows from each Hopf point."""
NEAR = 1e-3
"""Points of one kind at this distance are the same."""
POINT_COLUMNS = ("line", "kind", "ours", "biftool", "difference")
COST_COLUMNS = ("line", "program", "orbits", "seconds_per_orbit", "multiplier_error")


def seconds_of(command: list) -> tuple[float, str]:
    """CPU seconds of a command that must succeed, and what it says."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    run = subprocess.run(
        [str(word) for word in command],
        capture_output=True,
        text=True,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
    )
    if run.returncode != 0:
        raise SystemExit(f"benchmarks: {command[0]}: {run.stderr.strip()}")
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, run.stdout


def by_us(config: dict, line: str) -> tuple[dict, list[tuple[str, float]]]:
    """Cost of the orbits of a line with their multipliers and special points, and these points.

    Without windows for curves, the program computes none.
    """
    config = {**config, "cycles": {**config["cycles"], "curves": {}, **MESH}}
    along = config["cycles"]["lines"][line]["along"]
    with tempfile.TemporaryDirectory() as folder:
        namelist, output = Path(folder) / "line.nml", Path(folder) / "line.nc"
        write_namelist(namelist, cycles_groups(config, line))
        seconds, _ = seconds_of([BUILD / "bin" / "cycles", namelist, output])
        with xr.open_dataset(output) as found:
            orbits = found["branch"].size
            points = list(
                zip(
                    found["special_kind"].values.tolist(),
                    found[f"special_{along}"].values.tolist(),
                    strict=True,
                )
            )
            error = float(found["multiplier_error"].max())
    return cost(line, "ours", orbits, seconds, error), points


def by_biftool(config: dict, line: str, folder: Path) -> tuple[dict, list[tuple[str, float]]]:
    """Cost of the orbits of the branches of a line with their multipliers, and special points."""
    settings = config["cycles"]["lines"][line]
    along = settings["along"]
    start, end = settings["window"]
    place = [start if name == along else settings[name] for name in PARAMETERS]
    words = [folder, PARAMETERS.index(along) + 1, place, [start, end], ORBITS, *MESH.values()]
    _, said = seconds_of(["octave-cli", "--quiet", HERE / "biftool_worker.m", *words])
    return read_answer(line, said)


def read_answer(line: str, said: str) -> tuple[dict, list[tuple[str, float]]]:
    """What the worker says: branches and special points, among words of DDE-BIFTOOL."""
    orbits, seconds, error = 0, 0.0, 0.0
    points = []
    for kind, *values in (text.split() for text in said.splitlines() if text):
        if kind == "branch":
            orbits += int(values[0])
            seconds += float(values[1]) + float(values[2])
            error = max(error, float(values[3]))
        elif kind in ("fold", "torus", "period_doubling"):
            points.append((kind, float(values[0])))
    return cost(line, "DDE-BIFTOOL", orbits, seconds, error), points


def cost(line: str, program: str, orbits: int, seconds: float, error: float) -> dict:
    """A row of the table of costs."""
    each = seconds / orbits if orbits else None
    return dict(zip(COST_COLUMNS, (line, program, orbits, each, error), strict=True))


def side_by_side(line: str, ours: list[tuple[str, float]], theirs: list[tuple[str, float]]) -> list:
    """Rows of the table of points: pairs, then what one of the two has alone."""
    left, rows = list(theirs), []
    for kind, value in ours:
        same = [point for point in left if point[0] == kind and abs(point[1] - value) < NEAR]
        other = min(same, key=lambda point: abs(point[1] - value), default=None)
        if other:
            left.remove(other)
        rows.append(row_of(line, kind, value, other and other[1]))
    return rows + [row_of(line, kind, None, value) for kind, value in left]


def row_of(line: str, kind: str, ours: float | None, theirs: float | None) -> dict:
    """A row of the table of points, with all digits."""
    both = ours is not None and theirs is not None
    texts = ["" if value is None else f"{value:.12g}" for value in (ours, theirs)]
    difference = abs(ours - theirs) if both else None
    return dict(zip(POINT_COLUMNS, (line, kind, *texts, difference), strict=True))


def main() -> None:
    """Measure, compare and write the tables."""
    parser = argparse.ArgumentParser(prog="benchmarks/run cycles", allow_abbrev=False)
    parser.add_argument("--biftool", type=Path, required=True, help="folder of DDE-BIFTOOL")
    parser.add_argument("--output", type=Path, default=ROOT / "results" / "tables")
    options = parser.parse_args()
    if not (options.biftool / "ddebiftool" / "br_contn.m").exists():
        parser.error(f"--biftool {options.biftool}: a folder with ddebiftool/br_contn.m expected")
    config = checked(read(ROOT / "config" / "config.yaml"))
    costs, rows = [], []
    for line in LINES:
        our_cost, ours = by_us(config, line)
        their_cost, theirs = by_biftool(config, line, options.biftool)
        costs += [our_cost, their_cost]
        rows += side_by_side(line, ours, theirs)
    header = [*machine()[:3], first_line("octave-cli", "--version")]
    write_table(options.output / "cycle-points-by-biftool.tsv", list(POINT_COLUMNS), rows, header)
    write_table(options.output / "cycle-costs.tsv", list(COST_COLUMNS), costs, header)


if __name__ == "__main__":
    main()
