"""Special points of the Hopf curves of all planes, and where scenes die and live, as one table."""

from pathlib import Path

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.linear_stability_table import amplitude_death

COLUMNS = [
    *("of", "kind", "epsilon", "tau", "xi", "gamma", "unstable_pairs"),
    *("omega_1", "branch_1", "l1_1", "omega_2", "branch_2", "l1_2"),
]


def rows_of(plane: str, curves: xr.Dataset) -> list[dict]:
    """The points of one plane; of a single pair the columns of the second are empty."""
    kinds = np.char.strip(curves.special_kind.values.astype(str))
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
