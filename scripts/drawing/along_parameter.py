"""What figures along one parameter share: the scenes on a line, and the maxima of a run."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from scripts.drawing.style import FAINT
from scripts.models.records import is_on

LETTER = 4.5
"""How wide a letter of a name is, in points."""


def mark_scenes(axes: Axes, scenes: dict[str, dict], place: dict, along: str) -> None:
    """A line with its name at each scene whose fixed parameters are those of a place.

    The name is left of the line if that of the scene before leaves room there.
    """
    first, last = axes.get_xlim()
    letter = LETTER / (72 * axes.figure.get_figwidth() * axes.get_position().width)
    known = {name: one for name, one in scenes.items() if first <= one.get(along, np.nan) <= last}
    there = [(one[along], name) for name, one in known.items() if is_on(one, place, along)]
    taken = first
    for x, name in sorted(there):
        width = letter * len(name) * (last - first)
        is_left = x - width >= taken
        taken = x if is_left else x + width
        axes.axvline(x, color=FAINT, lw=0.6, zorder=0)
        axes.annotate(
            name.replace("_", " "),
            (x, 1),
            xycoords=("data", "axes fraction"),
            xytext=(-2 if is_left else 2, -1),
            textcoords="offset points",
            ha="right" if is_left else "left",
            va="top",
            fontsize=7,
        )


def maxima_of(run: xr.Dataset, along: str) -> tuple[np.ndarray, np.ndarray]:
    """Places and values of all maxima of v that a run has kept."""
    varied = run[along if along in run else f"history_{along}"]
    places = np.broadcast_to(varied.values[:, None], run.maximum.shape)
    there = run.maximum.values > 0
    return places[there], run.maximum.values[there]
