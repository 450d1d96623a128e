"""The signal over time, of the block its velocity, and phase portraits."""

import math
from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from scripts.drawing.style import FAINT, INK
from scripts.drawing.wording import short
from scripts.models.models import BEFORE, HISTORY
from scripts.models.records import is_of_block

MOST_MISSED = 0.01
"""Maxima of v that exceed their samples by a larger share are mentioned."""
MOST_TURNS = 150
"""Oscillations that a panel shows one by one; of more it shows the envelope."""
MOST_LINEAR = 100.0
"""Largest v on a linear axis: beside a larger one steady sliding, v = 1, looks like rest."""
PARTS = {"transient": {"color": FAINT, "lw": 0.2}, "attractor": {"color": "C1", "lw": 0.35}}
"""How parts of a portrait are drawn."""
RESOLUTION = 1000
"""Oscillations smaller than this part of the panel's height are not counted."""


def title_columns(panels: Sequence[Axes], columns: Sequence[str], row: str) -> None:
    """A title over each panel of a row, and that of the row above them."""
    for axes, words in zip(panels, columns, strict=True):
        axes.set_title(words)
    panels[0].set_title(f"{row}\n{columns[0]}")


def signal_of(trajectory: xr.Dataset) -> xr.DataArray:
    """The signal of a model: v of the block."""
    return trajectory[trajectory.attrs["signal"]]


def axis_of(trajectory: xr.Dataset, name: str) -> str:
    """Meaning and name of a variable for an axis."""
    known = HISTORY if is_of_block(trajectory.attrs) else {}
    meaning = trajectory[name].attrs["long_name"]
    meaning = known.get(name, {"meaning": meaning})["meaning"].removesuffix(BEFORE)
    return f"{meaning.split(',')[0]} ${name}$"


def share_missed(trajectory: xr.Dataset) -> float:
    """The largest share by which a maximum of v > 1 exceeds the nearest sample.

    The maximum is the vertex of the parabola through the largest sample and its neighbours.
    """
    t, v = trajectory.t.values, signal_of(trajectory).values
    slopes = np.diff(v) / np.diff(t)
    before, after = np.diff(t)[:-1], np.diff(t)[1:]
    slope = (slopes[:-1] * after + slopes[1:] * before) / (before + after)
    bend = (slopes[:-1] - slopes[1:]) / (before + after)
    top = (slopes[:-1] > 0) & (slopes[1:] < 0) & (v[1:-1] > 1)
    return float(np.max(slope[top] ** 2 / (4 * bend[top]) / v[1:-1][top], initial=0.0))


def draw_signal(axes: Axes, trajectory: xr.Dataset, start: float, end: float) -> bool:
    """The signal from one time to another; whether it is drawn as its envelope."""
    shown = signal_of(trajectory).sel(t=slice(start, end))
    seen = scale_signal(axes, shown)
    oscillations = len(turns(seen.values)) // 2
    axes.set(xlabel="time $t$", ylabel=axis_of(trajectory, shown.name), xlim=(start, end))
    if oscillations <= MOST_TURNS:
        axes.plot(shown.t, shown, color="C0", lw=0.7)
        return False
    # two oscillations in each part, so that each part has their least and greatest value
    parts = np.linspace(0, shown.sizes["t"], min(MOST_TURNS, oscillations // 2) + 1).astype(int)
    least, most = (ends.reduceat(shown.values, parts[:-1]) for ends in (np.minimum, np.maximum))
    at = shown.t.values[(parts[:-1] + parts[1:]) // 2]
    axes.fill_between(at, least, most, facecolor="C0", alpha=0.3, lw=0)
    axes.plot(at, least, at, most, color="C0", lw=0.7)
    return True


def scale_signal(axes: Axes, v: xr.DataArray) -> xr.DataArray:
    """Make the axis logarithmic where peaks of v would hide all else; v, or ln v, as it is seen."""
    if float(v.max()) <= MOST_LINEAR or float(v.min()) <= 0:
        return v
    axes.set_yscale("log")
    return np.log(v.clip(min=1e-300))


def turns(values: np.ndarray) -> np.ndarray:
    """Indices where a curve changes between rising and falling by more than the resolution."""
    extent = np.ptp(values) or 1.0
    levels = np.round(RESOLUTION * (values - values.min()) / extent)
    moves = np.flatnonzero(np.diff(levels))
    rising = np.diff(levels)[moves] > 0
    return moves[1:][rising[1:] != rising[:-1]]


def draw_portrait(axes: Axes, trajectory: xr.Dataset, shown: float) -> None:
    """The transient faint, the last part dark; a dot where the attractor is a point."""
    transient = trajectory.sel(t=slice(0, trajectory.attrs["t_transient"]))
    end = float(trajectory.t[-1])
    start = max(end - shown, trajectory.attrs["t_transient"])
    attractor = trajectory.sel(t=slice(start, end))
    x, words = beside_signal(trajectory)
    y = signal_of(trajectory)
    for name, part in {"transient": transient, "attractor": attractor}.items():
        axes.plot(x.sel(t=part.t), y.sel(t=part.t), rasterized=True, label=name, **PARTS[name])
    scale_signal(axes, y)
    if is_of_block(trajectory.attrs):
        axes.plot(0, 1, "+", color=INK, ms=5, mew=0.7, ls="", label="steady sliding")
    extent = np.ptp(signal_of(transient).values)
    if np.ptp(signal_of(attractor).values) < 0.01 * extent:
        axes.plot(x[-1], y[-1], "o", color="C1")
    axes.set(xlabel=words, ylabel=axis_of(trajectory, y.name))


def beside_signal(trajectory: xr.Dataset) -> tuple[xr.DataArray, str]:
    """What the portrait shows the signal over: u, the first other state, or else its slope."""
    signal = trajectory.attrs["signal"]
    others = [name for name in ("u", *trajectory.data_vars) if name in trajectory]
    others = [name for name in others if name != signal and trajectory[name].dims == ("t",)]
    if others:
        return trajectory[others[0]], axis_of(trajectory, others[0])
    return trajectory[signal].differentiate("t"), f"slope $\\dot{{{signal}}}$"


def end_in_words(v: xr.DataArray, motion: dict) -> str:
    """Maxima of v and the period of a cycle by `motion`, a row of attractors, or else v(t)."""
    name = v.name
    if motion["class"] == "fixed point" and is_of_block(motion):
        far = short(abs(v - 1).max(), 2)
        return f"at the end v is {far} or less from steady sliding, :math:`v = 1`"
    least, most = (short(motion.get(f"{end}_maximum", math.nan)) for end in ("smallest", "largest"))
    # at rest the maxima are of the transient
    if most == "nan" or motion["class"] == "fixed point":
        least, most = short(v.min()), short(v.max())
        return f"at the end {name} is {most if least == most else f'between {least} and {most}'}"
    words = f"maxima of {name} are {most if least == most else f'between {least} and {most}'}"
    frequency = motion.get("f1", math.nan)
    if motion["class"] == "cycle" and not math.isnan(frequency):
        words += f" with a period of {short(1 / frequency)}"
    return words
