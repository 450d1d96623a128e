"""The drawing of modes of chains, and the numbers of its caption."""

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from scripts.drawing import parameters
from scripts.drawing.wording import short
from scripts.studies.chain_modes.table import by_plane, mode_rows, stiffness_of

REGIONS = {
    "all modes stable": "#ffffff",
    "only spatial modes unstable": "#d55e00",
    "the uniform mode unstable": "#d9d9d9",
}


def draw(curves: list[xr.Dataset], planes: list[dict], chain: dict) -> Figure:
    """A panel for each plane: regions, and the curves of each mode."""
    stiffness = stiffness_of_modes(curves, planes)
    figure, panels = plt.subplots(1, len(planes), figsize=(6.7, 3.6), squeeze=False, sharey=True)
    colours = colormaps["viridis"](np.linspace(0, 0.9, len(stiffness)))
    for number, (axes, plane, modes) in enumerate(
        zip(panels[0], planes, by_plane(curves, planes), strict=True)
    ):
        draw_regions(axes, modes)
        for colour, mode in zip(colours, modes, strict=True):
            for piece in np.unique(mode.piece):
                line = mode.isel(point=mode.piece.values == piece)
                axes.plot(line.epsilon, line.tau, color=colour, lw=0.8)
        words = parameters.in_words({**plane}, "tau", "epsilon")
        axes.set_title(f"$\\bf{{{chr(ord('a') + number)}}}$  {words}")
        axes.set(xlabel=parameters.axis_of("epsilon"), xlim=plane["epsilon_window"])
        axes.set_ylim(plane["tau_window"])
    panels[0][0].set_ylabel(parameters.axis_of("tau"))
    lines = [
        Line2D([], [], color=colour, label=f"$s = {s:.3g}$")
        for colour, s in zip(colours, stiffness, strict=True)
    ]
    patches = [
        Patch(facecolor=colour, edgecolor="0.5", lw=0.5, label=name)
        for name, colour in REGIONS.items()
    ]
    figure.legend(handles=[*patches, *lines], loc="outside lower center", ncols=3)
    return figure


def regions_of(modes: list[xr.Dataset]) -> np.ndarray:
    """0: all modes stable, 1: only spatial ones unstable, 2: the uniform one unstable."""
    unstable = np.array([mode.map_unstable_roots.values > 0 for mode in modes])
    return np.where(unstable[0], 2, unstable[1:].any(axis=0))


def draw_regions(axes: Axes, modes: list[xr.Dataset]) -> None:
    axes.pcolormesh(
        modes[0].map_abscissa,
        modes[0].map_ordinate,
        regions_of(modes),
        cmap=ListedColormap(list(REGIONS.values())),
        norm=BoundaryNorm([-0.5, 0.5, 1.5, 2.5], 3),
        rasterized=True,
        zorder=0,
    )


def stiffness_of_modes(curves: list[xr.Dataset], planes: list[dict]) -> list[float]:
    """The stiffness of each mode, the same in all planes."""
    return [stiffness_of(mode) for mode in by_plane(curves, planes)[0]]


def numbers(curves: list[xr.Dataset], planes: list[dict], chain: dict) -> dict:
    """Share of each plane in which only spatial modes are unstable."""
    return {
        **chain,
        "most": max(stiffness_of_modes(curves, planes)),
        "planes": [
            {
                "xi": plane["xi"],
                "gamma": plane["gamma"],
                "share": short(100 * float((regions_of(modes) == 1).mean()), 2),
                "critical": critical_of(modes),
            }
            for plane, modes in zip(planes, by_plane(curves, planes), strict=True)
        ],
    }


def critical_of(modes: list[xr.Dataset]) -> str:
    """Where the first mode becomes unstable as epsilon grows, at any delay of the window."""
    first = [row for row in mode_rows("", modes) if row["critical"] == "yes"]
    if not first:
        return "no mode becomes unstable"
    (row, *_) = first
    return (
        f"the first unstable mode has :math:`s` = {short(row['s'])}, from :math:`\\varepsilon` ="
        f" {short(row['epsilon'])} at :math:`\\tau` = {short(row['tau'])}"
    )
