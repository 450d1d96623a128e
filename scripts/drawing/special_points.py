"""How special points of cycles, and the curves of these, are drawn by their kind."""

from dataclasses import dataclass

import xarray as xr


@dataclass(frozen=True)
class PointStyle:
    """Of a kind of special points."""

    marker: str
    colour: str


STYLES = {
    "fold": PointStyle("D", "#7a1fa2"),
    "period_doubling": PointStyle("s", "#b00000"),
    "torus": PointStyle("^", "#006837"),
    "branching": PointStyle("X", "#606060"),
}


def in_words(kind: str) -> str:
    """Its name in a legend."""
    return {"torus": "torus bifurcation", "branching": "branch point"}.get(
        kind, kind.replace("_", " ")
    )


def words_of(names: xr.DataArray) -> list[str]:
    """Names of a file."""
    return names.values.astype(str).tolist()
