"""Special points of the Hopf curves of all planes, and where scenes die and live, as one table."""

from pathlib import Path

import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.linear_stability_table import amplitude_death

COLUMNS = [
    *("of", "kind", "epsilon", "tau", "xi", "gamma", "unstable_pairs"),
    *("omega_1", "branch_1", "l1_1", "omega_2", "branch_2", "l1_2"),
    *("l2", "g2100", "g1011", "g1110", "g0021", "theta", "delta", "unfolding"),
    *("start_epsilon_1", "start_tau_1", "start_xi_1", "angle_1", "criticality_1", "torus_1"),
    *("start_epsilon_2", "start_tau_2", "start_xi_2", "angle_2", "criticality_2", "torus_2"),
]

COEFFICIENTS = ("g2100", "g1011", "g1110", "g0021", "theta", "delta")
"""Of a double Hopf point; real parts of g."""


def rows_of(plane: str, curves: xr.Dataset) -> list[dict]:
    """The points of one plane; of a single pair the columns of the second are empty."""
    kinds = curves.special_kind.values.astype(str)
    points = [curves.isel(special=i) for i in range(kinds.size)]
    return [
        {
            "of": plane,
            "kind": str(kind),
            **{key: digits(point[f"special_{key}"]) for key in ("epsilon", "tau", "xi")},
            "gamma": digits(curves.attrs["gamma"]),
            "unstable_pairs": int(point.special_unstable_pairs),
            **pair(point, 1),
            **pair(point, 2),
            **normal_form(str(kind), point),
            **start(str(kind), point, 1),
            **start(str(kind), point, 2),
        }
        for kind, point in zip(kinds, points, strict=True)
    ]


def death_rows_of(scene: str, stability: xr.Dataset) -> list[dict]:
    """Ends of the intervals of the delay in which a scene unstable without delay is stable."""
    rows = []
    for ends in amplitude_death(stability):
        for kind, tau in zip(("begin", "end"), ends, strict=True):
            crossing = stability.tau_of_change.values == tau
            if crossing.any():
                known = {key: digits(stability.attrs[key]) for key in ("epsilon", "xi", "gamma")}
                rows.append(
                    {
                        **dict.fromkeys(COLUMNS, ""),
                        **known,
                        "of": scene,
                        "kind": f"amplitude_death_{kind}",
                        "tau": digits(tau),
                        "unstable_pairs": 0,
                        "omega_1": digits(stability.tau_change_omega.values[crossing][0]),
                    }
                )
    return rows


def pair(point: xr.Dataset, number: int) -> dict:
    """One of the pairs on the axis."""
    there = float(point[f"special_omega_{number}"]) > 0
    return {
        f"omega_{number}": digits(point[f"special_omega_{number}"]) if there else "",
        f"branch_{number}": int(point[f"special_branch_{number}"]) if there else "",
        f"l1_{number}": digits(point[f"special_l1_{number}"], 6) if there else "",
    }


def normal_form(kind: str, point: xr.Dataset) -> dict:
    """Coefficients of a generalised or a double Hopf point."""
    keys = {"generalised_hopf": ("l2",), "double_hopf": COEFFICIENTS}.get(kind, ())
    found = {key: digits(point[f"special_{key}"], 6) for key in keys}
    found["unfolding"] = word(point.special_unfolding)
    return dict.fromkeys(("l2", *COEFFICIENTS), "") | found


def start(kind: str, point: xr.Dataset, number: int) -> dict:
    """Where a curve of folds (number 1) or of torus bifurcations starts."""
    there = kind == "double_hopf" or (kind == "generalised_hopf" and number == 1)
    found = {}
    for key in ("epsilon", "tau", "xi"):
        name = f"special_start_{key}_{number}"
        fixed = "0" if there else ""
        found[f"start_{key}_{number}"] = (
            digits(point[name], 6) if there and name in point else fixed
        )
    angle = f"angle_{number}"
    return found | {
        angle: digits(point[f"special_{angle}"]) if kind == "double_hopf" else "",
        **{
            f"{key}_{number}": word(point[f"special_{key}_{number}"])
            for key in ("criticality", "torus")
        },
    }


def word(value: xr.DataArray) -> str:
    """A word of the file."""
    return str(value.values)


def digits(value, number: int = 15) -> str:
    """A number with all digits that matter; below 1e-12 it is 0."""
    value = float(value)
    return f"{value:.{number}g}" if abs(value) > 1e-12 else "0"


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        rows = []
        for path in snakemake.input.curves:
            rows += rows_of(Path(path).stem, read(path))
        for path in snakemake.input.scenes:
            rows += death_rows_of(Path(path).stem, read(path))
        write_table(snakemake.output[0], rows, COLUMNS)
