"""Special points of cycles on all lines as one table."""

from pathlib import Path

import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import as_digits, read_table, rows_by, write_table
from scripts.models.models import PARAMETERS
from scripts.models.records import law_of
from scripts.studies.cycles.branches import cycles_there, most_of
from scripts.tables.attractor_tables import SAME_MAXIMUM
from scripts.tables.motion_rows import UNDECIDED

ERRORS = ["multiplier_error", "mesh_error"]
"""Columns with two digits."""
COLUMNS = [
    *("of", "law", "branch", "origin", "kind", *PARAMETERS, "period", "v_most"),
    *("angle", "resonance"),
    *("unstable_before", "unstable_behind", "criticality", "coefficient", "amplitude"),
    *("confirmed", *ERRORS, "coefficient_error"),
]
JUMP = 0.1
"""Share by which the greatest v changes where a sweep leaves a cycle for another one."""


def rows_of(line: str, cycles: xr.Dataset, swept: list[dict]) -> list[dict]:
    """The points of one line, branch by branch; `swept` are rows of the sweeps over it.

    Cusps of curves of folds that start on the line follow: they lie beside it, on no branch.
    """
    points = [cycles.isel(special=i) for i in range(cycles.sizes["special"])]
    rows = [{**row_of(point), "confirmed": confirmed(point, cycles, swept)} for point in points]
    for i in range(cycles.sizes["cusp"]):
        # beside the line its curve's parameters have other values
        axes = [key for key in cycles.attrs["parameters"].split() if f"curve_{key}" in cycles]
        cusp = place(cycles.isel(cusp=i), "cusp", axes)
        law = law_of(cycles.attrs, *axes)
        rows.append({"law": law, "kind": "cusp", **cusp, "confirmed": "not simulated"})
    return [{"of": line, "law": law_of(cycles.attrs), **row} for row in rows]


def place(point: xr.Dataset, name: str, axes: list[str]) -> dict:
    """Where a point lies over some axes, with its error; its variables begin with `name`."""
    numbers = [*dict.fromkeys([*PARAMETERS, *axes]), "period", most_of(point)]
    known = [key for key in numbers if f"{name}_{key}" in point]
    return {
        **{key: as_digits(point[f"{name}_{key}"], 12) for key in known},
        **{key: as_digits(point[f"{name}_{key}"], 2, zero=0) for key in ERRORS},
    }


def row_of(point: xr.Dataset) -> dict:
    """A special point on a branch; the angle and the resonance p:q next to it are those of tori."""
    row = {
        "kind": str(point.special_kind.values),
        "branch": int(point.special_branch),
        "origin": str(point.branch_origin.values[int(point.special_branch) - 1]),
        **place(point, "special", [point.attrs["along"]]),
        "unstable_before": int(point.special_unstable_before),
        "unstable_behind": int(point.special_unstable_behind),
        "criticality": str(point.special_criticality.values),
        "coefficient": as_digits(point.special_coefficient, 7, zero=0),
        "amplitude": as_digits(point.special_amplitude, 4, zero=0),
        "coefficient_error": as_digits(point.special_coefficient_error, 2, zero=0),
    }
    if row["kind"] == "torus":
        row["angle"] = as_digits(point.special_angle, 12)
        turns, periods = point.special_resonance_turns, point.special_resonance_periods
        row["resonance"] = f"{int(turns)}:{int(periods)}"
    return row


def confirmed(point: xr.Dataset, cycles: xr.Dataset, swept: list[dict]) -> str:
    """Whether a sweep that follows the stable cycle up to the point leaves it there."""
    along = cycles.attrs["along"]
    at, most = float(point[f"special_{along}"]), float(point[f"special_{most_of(point)}"])
    places = sorted({row[along] for row in swept})
    beside = [x for x in places if x <= at][-1:] + [x for x in places if x > at][:1]
    stable_on_no_side = min(int(point.special_unstable_before), int(point.special_unstable_behind))
    if len(beside) < 2 or stable_on_no_side:
        return "not simulated"
    # the point is that of a stable cycle on one of its sides
    stable = [
        (abs(cycle.most / most - 1), cycle.most, here, there)
        for here, there in (beside, beside[::-1])
        for cycle in cycles_there(cycles, here)
        if cycle.branch == int(point.special_branch) and cycle.unstable == 0
    ]
    if not stable:
        return "not simulated"
    _, most, here, there = min(stable)
    left = []
    for rows in rows_by(swept, "run").values():
        by_place = {row[along]: row for row in rows}
        cycle, other = by_place[here], by_place[there]
        share = abs(cycle["largest_maximum"] / most - 1)
        if cycle["class"] == "cycle" and share < SAME_MAXIMUM and other["class"] != UNDECIDED:
            left.append(leaves(cycle, other))
    if not left:
        return "not simulated"
    return "yes" if any(left) else "no"


def leaves(cycle: dict, other: dict) -> bool:
    """Whether the next row of a sweep is no longer on a cycle."""
    jump = abs(other["largest_maximum"] / cycle["largest_maximum"] - 1) > JUMP
    return other["class"] != "cycle" or other["period"] != cycle["period"] or jump


def sweeps_over(cycles: xr.Dataset, routes: list[dict]) -> list[dict]:
    """Rows of the sweeps of routes on the line of the cycles."""
    fixed = [key for key in PARAMETERS if key != cycles.attrs["along"]]
    return [
        row
        for row in routes
        if row["run"] in ("up", "down")
        # rows of other models have other parameters
        and law_of(row) == law_of(cycles.attrs)
        and all(row[key] == cycles.attrs[key] for key in fixed if key in cycles.attrs)
    ]


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        routes = [row for path in snakemake.input.routes for row in read_table(path)]
        rows = []
        for path in snakemake.input.cycles:
            cycles = read(path)
            rows += rows_of(Path(path).stem, cycles, sweeps_over(cycles, routes))
        write_table(snakemake.output[0], rows, COLUMNS)
