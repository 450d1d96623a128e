"""Velocity over time and phase portrait, one scene a row, for figures 4 and 5."""

import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing.style import FAINT, INK


def draw(rows: dict[str, xr.Dataset], titles: dict[str, str], settings: dict) -> Figure:
    """Rows a, b, ...: v(t) with its transient, v(t) on the attractor, and the plane (u, v)."""
    figure, grid = plt.subplots(
        len(rows),
        3,
        figsize=(6.7, 2.1 * len(rows)),
        width_ratios=[1.5, 1, 1],
        squeeze=False,
    )
    for (label, trajectory), (left, middle, right) in zip(rows.items(), grid, strict=True):
        last = float(trajectory.time[-1])
        draw_velocity(left, trajectory, 0.0, min(settings["rows"][label]["time_shown"], last))
        draw_velocity(middle, trajectory, max(0.0, last - settings["end_shown"]), last)
        draw_portrait(right, trajectory, settings["attractor_shown"])
        middle.sharey(left)
        middle.set(ylabel="")
        left.set_title(f"$\\bf{{{label}}}$  {parameters(trajectory)}\n{titles[label]}")
    figure.legend(*right.get_legend_handles_labels(), loc="outside lower right", ncols=3)
    return figure


def draw_velocity(axes: Axes, trajectory: xr.Dataset, start: float, end: float) -> None:
    """v from one time to another."""
    shown = trajectory.sel(time=slice(start, end))
    axes.plot(shown.time, shown.v, color="C0", lw=0.7)
    axes.set(xlabel="time $t$", ylabel="velocity $v$", xlim=(start, end))


def draw_portrait(axes: Axes, trajectory: xr.Dataset, shown: float) -> None:
    """The transient faint, the last part dark; a dot where the attractor is a point."""
    transient = trajectory.sel(time=slice(0, trajectory.attrs["t_transient"]))
    end = float(trajectory.time[-1])
    start = max(end - shown, trajectory.attrs["t_transient"])
    attractor = trajectory.sel(time=slice(start, end))
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


def parameters(trajectory: xr.Dataset) -> str:
    """The parameters of a trajectory as a line of mathematics."""
    symbols = {
        "tau": r"\tau",
        "epsilon": r"\varepsilon",
        "xi": r"\xi",
        "gamma": r"\gamma",
    }
    return ", ".join(f"${symbols[key]} = {trajectory.attrs[key]:g}$" for key in symbols)
