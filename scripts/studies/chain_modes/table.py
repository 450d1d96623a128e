"""Modes of a chain in planes of epsilon and tau: where each becomes unstable, which is first."""

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table


def by_plane(curves: list, planes: list) -> list[list]:
    """Curves of the modes of each plane."""
    size = len(curves) // max(1, len(planes))
    return [curves[i * size : (i + 1) * size] for i in range(len(planes))]


def stiffness_of(mode: xr.Dataset) -> float:
    """s = 1 + kappa mu of a mode: it is one block at gamma sqrt(s) and xi s."""
    return 1.0 + float(mode.attrs.get("kappa", 0.0) * mode.attrs.get("mode_eigenvalue", 0.0))


def mode_rows(plane: str, modes: list[xr.Dataset]) -> list[dict]:
    """A row for each mode: the block that it is, and the least epsilon on its Hopf curves.

    A mode without a curve in the window has none. The critical mode has the least of all.
    """
    rows = [
        {
            "plane": plane,
            "s": s,
            "block_xi": s * float(mode.attrs["xi"]),
            "block_gamma": np.sqrt(s) * float(mode.attrs["gamma"]),
            **least_of(mode),
            "unstable_share": float((mode.map_unstable_roots.values > 0).mean()),
        }
        for s, mode in zip(map(stiffness_of, modes), modes, strict=True)
    ]
    least = min((row["epsilon"] for row in rows if not np.isnan(row["epsilon"])), default=np.nan)
    return [{**row, "critical": "yes" if row["epsilon"] == least else "no"} for row in rows]


def least_of(mode: xr.Dataset) -> dict:
    """The least epsilon on the Hopf curves, the delay there, and the frequency omega."""
    if mode.sizes["point"] == 0:
        return {"epsilon": np.nan, "tau": np.nan, "omega": np.nan}
    point = mode.isel(point=int(mode.epsilon.values.argmin()))
    # a curve may end at tau = 0 but for rounding
    return {key: max(0.0, float(point[key])) for key in ("epsilon", "tau", "omega")}


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        planes = snakemake.params.planes
        runs = by_plane([read(path) for path in snakemake.input.modes], planes)
        rows = [mode_rows(plane, modes) for plane, modes in zip(planes, runs, strict=True)]
        write_table(snakemake.output[0], [row for of_plane in rows for row in of_plane])
