"""Special points of the Hopf curves of all planes, and where scenes die and live, as one table."""

from pathlib import Path

import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import as_digits, write_table
from scripts.models.records import law_of
from scripts.tables.amplitude_death import amplitude_death
from scripts.tables.motion_rows import AXES_FIRST

COLUMNS = [
    *("of", "law", "kind", *AXES_FIRST, "unstable_roots"),
    *("omega_1", "branch_1", "l1_1", "omega_2", "branch_2", "l1_2"),
    *("l2", "g2100", "g1011", "g1110", "g0021", "theta", "delta", "unfolding"),
    *("start_epsilon_1", "start_tau_1", "start_xi_1", "angle_1", "criticality_1", "torus_1"),
    *("start_epsilon_2", "start_tau_2", "start_xi_2", "angle_2", "criticality_2", "torus_2"),
]
COEFFICIENTS = {
    "generalised_hopf": ["l2"],
    "double_hopf": ["g2100", "g1011", "g1110", "g0021", "theta", "delta"],
}
"""Normal form of a kind of points; real parts of g."""
CURVES = {"generalised_hopf": [1], "double_hopf": [1, 2]}
"""Numbers of the curves of folds or of torus bifurcations that start at a kind of points."""


def rows_of(plane: str, curves: xr.Dataset) -> list[dict]:
    """The special points of one plane; a row has the columns that its kind of points fills."""
    points = [curves.isel(special=i) for i in range(curves.sizes["special"])]
    fixed = {key: as_digits(curves.attrs[key]) for key in AXES_FIRST if key in curves.attrs}
    return [
        {"of": plane, "law": law_of(curves.attrs), **row_of(point, curves), **fixed}
        for point in points
    ]


def row_of(point: xr.Dataset, curves: xr.Dataset) -> dict:
    """One special point: its place, the pairs on the axis, the normal form, curves that start."""
    kind, names = str(point.special_kind.values), curves.attrs["parameters"].split()
    row = {
        "kind": kind,
        **{key: as_digits(point[f"special_{key}"]) for key in names if f"special_{key}" in point},
        "unstable_roots": int(point.special_unstable_roots),
        **{key: as_digits(point[f"special_{key}"], 6) for key in COEFFICIENTS.get(kind, [])},
        "unfolding": str(point.special_unfolding.values),
    }
    for i in (1, 2):
        if point[f"special_omega_{i}"] > 0:
            row[f"omega_{i}"] = as_digits(point[f"special_omega_{i}"])
            row[f"branch_{i}"] = int(point[f"special_branch_{i}"])
            row[f"l1_{i}"] = as_digits(point[f"special_l1_{i}"], 6)
        for key in (f"criticality_{i}", f"torus_{i}"):
            row[key] = str(point[f"special_{key}"].values)
    for i in CURVES.get(kind, []):
        # parameters that are fixed in the plane have no direction
        for key in (f"start_{name}_{i}" for name in names):
            if f"special_{key}" in point:
                row[key] = as_digits(point[f"special_{key}"], 6)
        if kind == "double_hopf":
            row[f"angle_{i}"] = as_digits(point[f"special_angle_{i}"])
    return row


def death_rows_of(scene: str, stability: xr.Dataset) -> list[dict]:
    """Ends of the intervals of the delay in which a scene unstable without delay is stable."""
    keys = [key for key in AXES_FIRST if key != "tau" and key in stability.attrs]
    known = {key: as_digits(stability.attrs[key]) for key in keys}
    rows = []
    for ends in amplitude_death(stability):
        for kind, tau in zip(("begin", "end"), ends, strict=True):
            crossing = stability.tau_of_change.values == tau
            if crossing.any():
                omega = stability.tau_change_omega.values[crossing][0]
                row = {"of": scene, "law": law_of(stability.attrs)}
                row |= {"kind": f"amplitude_death_{kind}", **known, "tau": as_digits(tau)}
                rows.append({**row, "unstable_roots": 0, "omega_1": as_digits(omega)})
    return rows


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        rows = []
        for path in snakemake.input.curves:
            rows += rows_of(Path(path).stem, read(path))
        for path in snakemake.input.scenes:
            rows += death_rows_of(Path(path).stem, read(path))
        write_table(snakemake.output[0], rows, COLUMNS)
