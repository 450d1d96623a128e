"""Hopf curves and scenes in a plane of two parameters."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from scripts.drawing.style import INK

SUBCRITICAL, UNKNOWN = (0, (3, 1.5)), ":"
"""Dashes; dots where the first Lyapunov coefficient is not known."""
SCENE = {"ls": "", "marker": "o", "color": INK, "mfc": "white"}
NEAR = 0.25
"""A scene this close at the right, as a share of the axis, sends a name above its dot."""


def draw_piece(axes: Axes, x: np.ndarray, y: np.ndarray, l1: np.ndarray, colour: str) -> None:
    """One unbroken piece, dashed where the first Lyapunov coefficient is positive."""
    kinds = np.where(np.isnan(l1), 2, l1 > 0)
    ends = np.flatnonzero(np.diff(kinds)) + 1
    for part in np.split(np.arange(x.size), ends):
        part = np.append(part, part[-1] + 1) if part[-1] + 1 < x.size else part
        style = ("-", SUBCRITICAL, UNKNOWN)[kinds[part[0]]]
        axes.plot(x[part], y[part], color=colour, ls=style)


def mark_scenes(
    axes: Axes, scenes: dict[str, dict], along: tuple[str, str], named: bool = True
) -> None:
    """A dot for each scene of a plane, its name beside it where no other scene is in the way."""
    near = NEAR * np.ptp(axes.get_xlim())
    close = 0.05 * np.ptp(axes.get_ylim())
    places: dict[tuple[float, float], list[str]] = {}
    for name, scene in scenes.items():
        x, y = (scene[key] for key in along)
        (left, right), (below, above) = axes.get_xlim(), axes.get_ylim()
        if not (left <= x <= right and below <= y <= above):
            continue
        places.setdefault((x, y), []).append(name.replace("_", " "))
    for place, names in places.items():
        axes.plot(*place, clip_on=False, zorder=5, **SCENE)
        if not named:
            continue
        above = any(0 < x - place[0] < near and abs(y - place[1]) < close for x, y in places)
        axes.annotate(
            ", ".join(names),
            place,
            xytext=(0, 4) if above else (4, 0),
            textcoords="offset points",
            ha="center" if above else "left",
            va="bottom" if above or place[1] <= axes.get_ylim()[0] else "center",
            fontsize=7,
            path_effects=[withStroke(linewidth=2, foreground="white")],
            zorder=6,
        )
