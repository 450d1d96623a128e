"""How special points of cycles, and the curves of these, are drawn by their kind."""

import xarray as xr

STYLES = {
    "fold": ("D", "#7a1fa2"),
    "period_doubling": ("s", "#b00000"),
    "torus": ("^", "#006837"),
    "branching": ("X", "#606060"),
}
"""Marker and colour of each kind."""


def in_words(kind: str) -> str:
    """Its name in a legend."""
    return {"torus": "torus bifurcation", "branching": "branch point"}.get(
        kind, kind.replace("_", " ")
    )


def words_of(names: xr.DataArray) -> list[str]:
    """Names of a file."""
    return names.values.astype(str).tolist()
