"""Special points of cycles on all lines as one table."""

from pathlib import Path

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import read_table, write_table
from scripts.namelists.study_cases import PARAMETERS
from scripts.tables.attractor_tables import SAME_MAXIMUM
from scripts.tables.cycle_branches import cycles_there
from scripts.tables.hopf_points_table import digits
from scripts.tables.motion_rows import UNDECIDED

NUMBERS = ["tau", "epsilon", "xi", "gamma", "period", "v_most"]
"""Columns with all digits."""
ERRORS = ["multiplier_error", "mesh_error"]
"""Columns with two digits."""
COLUMNS = [
    *("of", "branch", "origin", "kind", *NUMBERS, "angle", "resonance"),
    *("unstable_before", "unstable_behind", "criticality", "coefficient", "amplitude"),
    *("confirmed", *ERRORS, "coefficient_error"),
]
JUMP = 0.1
"""Share by which the greatest v changes where a sweep leaves a cycle for another one."""


def rows_of(line: str, cycles: xr.Dataset, swept: list[dict]) -> list[dict]:
    """The points of one line, branch by branch; `swept` are rows of the sweeps over it."""
    kinds = cycles.special_kind.values.astype(str)
    origins = cycles.branch_origin.values.astype(str)
    points = [cycles.isel(special=i) for i in range(kinds.size)]
    rows = [
        {
            "of": line,
            "branch": int(point.special_branch),
            "origin": str(origins[int(point.special_branch) - 1]),
            "kind": str(kind),
            **{key: digits(point[f"special_{key}"], 12) for key in NUMBERS},
            "angle": digits(point.special_angle, 12) if kind == "torus" else "",
            "resonance": resonance(point) if kind == "torus" else "",
            "unstable_before": int(point.special_unstable_before),
            "unstable_behind": int(point.special_unstable_behind),
            "criticality": str(point.special_criticality.values.astype(str)),
            "coefficient": if_known(point.special_coefficient, 7),
            "amplitude": if_known(point.special_amplitude, 4),
            "confirmed": confirmed(point, cycles, swept),
            **{key: f"{float(point[f'special_{key}']):.2g}" for key in ERRORS},
            "coefficient_error": if_known(point.special_coefficient_error, 2),
        }
        for kind, point in zip(kinds, points, strict=True)
    ]
    return rows + [cusp_row(line, cycles.isel(cusp=i)) for i in range(cycles.sizes["cusp"])]


def if_known(value: xr.DataArray, digits: int) -> str:
    """A number with `digits` digits, or nothing."""
    return "" if np.isnan(value) else f"{float(value):.{digits}g}"


def cusp_row(line: str, cusp: xr.Dataset) -> dict:
    """A cusp of a curve of folds that starts on the line; it lies beside the line, on no branch."""
    return {
        **dict.fromkeys(COLUMNS, ""),
        "of": line,
        "kind": "cusp",
        **{key: digits(cusp[f"cusp_{key}"], 12) for key in NUMBERS},
        "confirmed": "not simulated",
        **{key: f"{float(cusp[f'cusp_{key}']):.2g}" for key in ERRORS},
    }


def resonance(point: xr.Dataset) -> str:
    """The fraction p/q of a turn that is nearest to the angle of the pair."""
    return f"{int(point.special_resonance_turns)}:{int(point.special_resonance_periods)}"


def confirmed(point: xr.Dataset, cycles: xr.Dataset, swept: list[dict]) -> str:
    """Whether a sweep that follows the stable cycle up to the point leaves it there."""
    along = cycles.attrs["along"]
    place = float(point[f"special_{along}"])
    places = sorted({row[along] for row in swept})
    beside = [x for x in places if x <= place][-1:] + [x for x in places if x > place][:1]
    if len(beside) < 2:
        return "not simulated"
    # the point is that of a stable cycle on one of its sides
    known = [
        (abs(cycle.most / float(point.special_v_most) - 1), cycle.most, here, there)
        for here, there in (beside, beside[::-1])
        for cycle in cycles_there(cycles, here)
        if cycle.branch == int(point.special_branch) and cycle.unstable == 0
    ]
    if not known or min(int(point.special_unstable_before), int(point.special_unstable_behind)):
        return "not simulated"
    _, most, here, there = min(known)
    left = []
    for run in {row["run"] for row in swept}:
        at = {row[along]: row for row in swept if row["run"] == run}
        own, other = at[here], at[there]
        follows = own["class"] == "cycle" and abs(own["largest_maximum"] / most - 1) < SAME_MAXIMUM
        if follows and other["class"] != UNDECIDED:
            left.append(
                other["class"] != "cycle"
                or other["period"] != own["period"]
                or abs(other["largest_maximum"] / own["largest_maximum"] - 1) > JUMP
            )
    if not left:
        return "not simulated"
    return "yes" if any(left) else "no"


def sweeps_over(cycles: xr.Dataset, routes: list[dict]) -> list[dict]:
    """Rows of the sweeps of routes on the line of the cycles."""
    fixed = [key for key in PARAMETERS if key != cycles.attrs["along"]]
    return [
        row
        for row in routes
        if row["run"] in ("up", "down") and all(row[key] == cycles.attrs[key] for key in fixed)
    ]


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        routes = [row for path in snakemake.input.routes for row in read_table(path)]
        rows = []
        for path in snakemake.input.cycles:
            cycles = read(path)
            rows += rows_of(Path(path).stem, cycles, sweeps_over(cycles, routes))
        write_table(snakemake.output[0], rows, COLUMNS)
