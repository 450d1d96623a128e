"""Cycles by DDE-BIFTOOL and by this project: special points, and the cost of an orbit."""

import tempfile
from pathlib import Path

import xarray as xr
from measuring import describe_machine, first_line, measure_command, options_of, write_table
from project import HERE, PROGRAM, TABLES, configuration

from scripts.models.models import PARAMETERS
from scripts.requests.write_namelist import write_namelist
from scripts.studies.cycles.plan import groups

LINES = ("torus_in_epsilon", "chaos_in_epsilon", "chaos_in_tau", "torus_in_tau")
"""Lines of the configuration."""
MESH = {"intervals": 40, "degree": 5}
ORBITS = 90
"""Orbits that DDE-BIFTOOL follows from each Hopf point."""
NEAR = 1e-3
"""Points of one kind at this distance are the same."""


def follow_here(config: dict, line: str) -> tuple[dict, list[tuple[str, float]]]:
    """Cost of the orbits of a line with their multipliers and special points, and these points.

    Without windows for curves, the program computes none.
    """
    config = {**config, "cycles": {**config["cycles"], "curves": {}, **MESH}}
    along = config["cycles"]["lines"][line]["along"]
    with tempfile.TemporaryDirectory() as folder:
        namelist, output = Path(folder) / "line.nml", Path(folder) / "line.nc"
        write_namelist(namelist, groups(config, line))
        seconds, _ = measure_command([PROGRAM, "cycles", namelist, output])
        found = xr.load_dataset(output)
    columns = (found[name].values.tolist() for name in ("special_kind", f"special_{along}"))
    error = float(found["multiplier_error"].max())
    points = list(zip(*columns, strict=True))
    return cost_row(line, "ours", found["branch"].size, seconds, error), points


def follow_by_biftool(
    config: dict, line: str, folder: Path
) -> tuple[dict, list[tuple[str, float]]]:
    """Cost of the orbits of the branches of a line with their multipliers, and special points."""
    settings = config["cycles"]["lines"][line]
    along = settings["along"]
    start, end = settings["window"]
    place = [start if name == along else settings[name] for name in PARAMETERS]
    words = [folder, PARAMETERS.index(along) + 1, place, [start, end], ORBITS, *MESH.values()]
    _, said = measure_command(["octave-cli", "--quiet", HERE / "biftool_worker.m", *words])
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
    return cost_row(line, "DDE-BIFTOOL", orbits, seconds, error), points


def cost_row(line: str, program: str, orbits: int, seconds: float, error: float) -> dict:
    """A row of the table of costs."""
    return {
        "line": line,
        "program": program,
        "orbits": orbits,
        "seconds_per_orbit": seconds / orbits if orbits else None,
        "multiplier_error": error,
    }


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
    row = {"line": line, "kind": kind, "ours": texts[0], "biftool": texts[1]}
    return {**row, "difference": abs(ours - theirs) if both else None}


def main() -> None:
    """Measure, compare and write the tables."""
    parser = options_of("benchmarks/run cycles", TABLES)
    parser.add_argument("--biftool", type=Path, required=True, help="folder of DDE-BIFTOOL")
    options = parser.parse_args()
    if not (options.biftool / "ddebiftool" / "br_contn.m").exists():
        parser.error(f"--biftool {options.biftool}: a folder with ddebiftool/br_contn.m expected")
    config = configuration()
    costs, rows = [], []
    for line in LINES:
        our_cost, ours = follow_here(config, line)
        their_cost, theirs = follow_by_biftool(config, line, options.biftool)
        costs += [our_cost, their_cost]
        rows += side_by_side(line, ours, theirs)
    header = [*describe_machine(), first_line("octave-cli", "--version")]
    write_table(options.output / "cycle-points-by-biftool.tsv", rows, header)
    write_table(options.output / "cycle-costs.tsv", costs, header)


if __name__ == "__main__":
    main()
