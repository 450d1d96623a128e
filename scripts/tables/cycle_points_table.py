"""Special points of cycles on all lines as one table."""

from pathlib import Path

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.hopf_points_table import digits

NUMBERS = ["tau", "epsilon", "xi", "gamma", "period", "v_most"]
"""Columns with all digits."""
ERRORS = ["multiplier_error", "mesh_error"]
"""Columns with two digits."""
COLUMNS = [
    *("of", "branch", "origin", "kind", *NUMBERS, "angle", "resonance"),
    *("unstable_before", "unstable_behind", *ERRORS),
]


def rows_of(line: str, cycles: xr.Dataset) -> list[dict]:
    """The points of one line, branch by branch."""
    kinds = np.char.strip(cycles.special_kind.values.astype(str))
    origins = np.char.strip(cycles.branch_origin.values.astype(str))
    points = [cycles.isel(special=i) for i in range(kinds.size)]
    return [
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
            **{key: f"{float(point[f'special_{key}']):.2g}" for key in ERRORS},
        }
        for kind, point in zip(kinds, points, strict=True)
    ]


def resonance(point: xr.Dataset) -> str:
    """The fraction p/q of a turn that is nearest to the angle of the pair."""
    return f"{int(point.special_resonance_turns)}:{int(point.special_resonance_periods)}"


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        rows = []
        for path in snakemake.input.cycles:
            rows += rows_of(Path(path).stem, read(path))
        write_table(snakemake.output[0], rows, COLUMNS)
