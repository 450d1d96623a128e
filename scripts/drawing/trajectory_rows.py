"""Velocity over time and phase portrait, one scene a row, for figures 4 and 5."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing import parameters
from scripts.drawing.style import FAINT, INK

COLUMNS = ("from the start", "at the end", "phase portrait")
MOST_MISSED = 0.01
"""Maxima of v that exceed their samples by a larger share are mentioned."""
WORDS = {"cycle": "limit cycle"}
"""Of classes of motion, where those of the tables are shorter."""
MOST_TURNS = 150
"""Oscillations that a panel shows one by one; of more it shows the envelope."""
MOST_LOOPS = 60
"""Loops of the transient in a phase portrait."""
RESOLUTION = 1000
"""Oscillations smaller than this part of the panel's height are not counted."""


def draw(rows: dict[str, xr.Dataset], titles: dict[str, str], settings: dict) -> Figure:
    """Rows a, b, ...: v(t) with its transient, v(t) on the attractor, and the plane (u, v)."""
    figure, grid = plt.subplots(
        len(rows),
        3,
        figsize=(6.7, 2.2 * len(rows)),
        width_ratios=[1.5, 1, 1],
        squeeze=False,
    )
    for (label, trajectory), (left, middle, right) in zip(rows.items(), grid, strict=True):
        last = float(trajectory.t[-1])
        shown = min(settings["rows"][label]["time_shown"], last)
        envelope = draw_velocity(left, trajectory, 0.0, shown)
        draw_velocity(middle, trajectory, max(0.0, last - settings["end_shown"]), last)
        draw_portrait(right, trajectory, settings["attractor_shown"])
        middle.sharey(left)
        middle.set(ylabel="")
        row = f"$\\bf{{{label}}}$  {parameters.in_words(trajectory.attrs)}: {titles[label]}"
        columns = (COLUMNS[0] + " (envelope)" * envelope, *COLUMNS[1:])
        title_columns((left, middle, right), columns, row)
    figure.legend(*right.get_legend_handles_labels(), loc="outside lower right", ncols=3)
    return figure


def title_columns(panels: Sequence[Axes], columns: Sequence[str], row: str) -> None:
    """A title over each panel of a row, and that of the row above them."""
    for axes, words in zip(panels, columns, strict=True):
        axes.set_title(words)
    panels[0].set_title(f"{row}\n{columns[0]}")


def titles_of(settings: dict, table: list[dict]) -> dict[str, str]:
    """For each row the paper's words and the class of its motion, where attractors are known.

    `table` is attractors.tsv; the class is that of the motion from the scene's own history.
    """
    seen = {row["scene"]: row["class"] for row in table if row["history"] == 1}
    titles = {}
    for label, row in settings["rows"].items():
        titles[label] = f"the paper: “{row['paper']}”"
        if row["scene"] in seen:
            met = seen[row["scene"]]
            titles[label] += f"; here: {WORDS.get(met, met)}"
    return titles


def share_missed(trajectory: xr.Dataset) -> float:
    """The largest share by which a maximum of v > 1 exceeds the nearest sample.

    The maximum is the vertex of the parabola through the largest sample and its neighbours.
    """
    t, v = trajectory.t.values, trajectory.v.values
    slopes = np.diff(v) / np.diff(t)
    before, after = np.diff(t)[:-1], np.diff(t)[1:]
    slope = (slopes[:-1] * after + slopes[1:] * before) / (before + after)
    bend = (slopes[:-1] - slopes[1:]) / (before + after)
    top = (slopes[:-1] > 0) & (slopes[1:] < 0) & (v[1:-1] > 1)
    return float(np.max(slope[top] ** 2 / (4 * bend[top]) / v[1:-1][top], initial=0.0))


def draw_velocity(axes: Axes, trajectory: xr.Dataset, start: float, end: float) -> bool:
    """v from one time to another; whether it is drawn as its envelope."""
    shown = trajectory.sel(t=slice(start, end))
    oscillations = len(turns(shown.v.values)) // 2
    axes.set(xlabel="time $t$", ylabel="velocity $v$", xlim=(start, end))
    if oscillations <= MOST_TURNS:
        axes.plot(shown.t, shown.v, color="C0", lw=0.7)
        return False
    # two oscillations in each part, so that each part has their least and greatest v
    parts = np.linspace(0, shown.sizes["t"], min(MOST_TURNS, oscillations // 2) + 1).astype(int)
    least, most = (ends.reduceat(shown.v.values, parts[:-1]) for ends in (np.minimum, np.maximum))
    at = shown.t.values[(parts[:-1] + parts[1:]) // 2]
    axes.fill_between(at, least, most, facecolor="C0", alpha=0.3, lw=0)
    axes.plot(at, least, at, most, color="C0", lw=0.7)
    return True


def turns(values: np.ndarray) -> np.ndarray:
    """Indices where a curve changes between rising and falling by more than the resolution."""
    extent = np.ptp(values) or 1.0
    levels = np.round(RESOLUTION * (values - values.min()) / extent)
    moves = np.flatnonzero(np.diff(levels))
    rising = np.diff(levels)[moves] > 0
    return moves[1:][rising[1:] != rising[:-1]]


def some_loops(transient: xr.Dataset) -> xr.Dataset:
    """A transient of many loops with gaps, so that the loops that stay can be told apart."""
    begins = turns(transient.v.values)[::2]
    every = -(-len(begins) // MOST_LOOPS)
    if every <= 1:
        return transient
    loops = np.searchsorted(begins, np.arange(transient.sizes["t"]), side="right")
    return transient.where(xr.DataArray(loops % every == 0, dims="t"))


def draw_portrait(axes: Axes, trajectory: xr.Dataset, shown: float) -> None:
    """Loops of the transient faint, the last part dark; a dot where the attractor is a point."""
    transient = some_loops(trajectory.sel(t=slice(0, trajectory.attrs["t_transient"])))
    end = float(trajectory.t[-1])
    start = max(end - shown, trajectory.attrs["t_transient"])
    attractor = trajectory.sel(t=slice(start, end))
    axes.plot(
        transient.u,
        transient.v,
        color=FAINT,
        lw=0.2,
        label="transient",
        rasterized=True,
    )
    axes.plot(
        attractor.u,
        attractor.v,
        color="C1",
        lw=0.35,
        label="attractor",
        rasterized=True,
    )
    axes.plot(0, 1, "+", color=INK, ms=5, mew=0.7, ls="", label="steady sliding")
    extent = transient.v.max() - transient.v.min()
    if attractor.v.max() - attractor.v.min() < 0.01 * extent:
        axes.plot(attractor.u[-1], attractor.v[-1], "o", color="C1")
    axes.set(xlabel="displacement $u$", ylabel="velocity $v$")
