"""What figures along one parameter share: the scenes on a line, and the maxima of a run."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from scripts.drawing.style import FAINT
from scripts.namelists.laws import is_on


def mark_scenes(axes: Axes, scenes: dict[str, dict], place: dict, along: str) -> None:
    """A line with its name at each scene whose fixed parameters are those of a place."""
    first, last = axes.get_xlim()
    middle = 0.5 * (first + last)
    for name, scene in scenes.items():
        if along in scene and is_on(scene, place, along) and first <= scene[along] <= last:
            axes.axvline(scene[along], color=FAINT, lw=0.6, zorder=0)
            axes.annotate(
                name.replace("_", " "),
                (scene[along], 1),
                xycoords=("data", "axes fraction"),
                xytext=(2 if scene[along] < middle else -2, -1),
                textcoords="offset points",
                ha="left" if scene[along] < middle else "right",
                va="top",
                fontsize=7,
            )


def maxima_of(run: xr.Dataset, along: str) -> tuple[np.ndarray, np.ndarray]:
    """Places and values of all maxima of v that a run has kept."""
    varied = run[along if along in run else f"history_{along}"]
    places = np.broadcast_to(varied.values[:, None], run.maximum.shape)
    there = run.maximum.values > 0
    return places[there], run.maximum.values[there]
