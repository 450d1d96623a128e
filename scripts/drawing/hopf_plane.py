"""Hopf curves in a plane of epsilon and another parameter, for figures 2 and 3."""

import math

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing.free_labels import label_points
from scripts.drawing.parameters import SYMBOLS, axis_of, in_words
from scripts.drawing.style import INK

SUBCRITICAL = (0, (3, 1.5))
"""Dashes."""
DARKEST = 0.3
"""How much darker than white the most unstable pairs are."""
MARKERS = {
    "generalised_hopf": ("D", "generalised Hopf point"),
    "double_hopf": ("s", "double Hopf point"),
    "hopf_without_delay": ("^", "Hopf point without delay"),
}


def draw(curves: xr.Dataset, scenes: dict[str, dict[str, float]]) -> Figure:
    """Curves by branch, solid where supercritical, over the number of unstable pairs; scenes."""
    ordinate = curves.attrs["ordinate"]
    figure, axes = plt.subplots(figsize=(5.2, 4.4))
    axes.set(xlim=(0, float(curves.epsilon.max())), ylim=(0, float(curves[ordinate].max())))
    shades = shade(axes, curves)
    ends = []
    for piece in np.unique(curves.piece):
        line = curves.isel(point=curves.piece.values == piece)
        branch = int(line.branch[0])
        colour = f"C{branch % 8}"
        x, y = line.epsilon.values, line[ordinate].values
        draw_piece(axes, x, y, line.l1.values, colour)
        last = x.argmax() if x.max() > 0.99 * axes.get_xlim()[1] else y.argmax()
        ends.append((float(y[last]), float(x[last]), branch, colour))
    points = mark_special_points(axes, curves)
    label_branches(axes, ends)
    marked = mark_scenes(axes, scenes, curves)
    axes.set_title(in_words(curves.attrs, "epsilon", ordinate), pad=14)
    axes.set(xlabel=axis_of("epsilon"), ylabel=axis_of(ordinate))
    handles = [
        Line2D([], [], color=INK, label="supercritical"),
        Line2D([], [], color=INK, ls=SUBCRITICAL, label="subcritical"),
    ]
    bar = figure.colorbar(shades, ax=axes, label="unstable pairs", pad=0.03)
    bar.set_ticks(range(round(shades.norm.vmax - 0.5) + 1))
    figure.legend(handles=handles + points + marked, loc="outside lower center", ncols=2)
    places: dict[tuple[float, float], list[str]] = {}
    for name, scene in scenes.items():
        places.setdefault((scene["epsilon"], scene[ordinate]), []).append(name.replace("_", " "))
    label_points(axes, {place: ", ".join(names) for place, names in places.items()})
    return figure


def shade(axes: Axes, curves: xr.Dataset):
    """The number of unstable pairs, white where there is none."""
    pairs = curves.map_unstable_pairs.values
    most = max(int(pairs.max()), 1)
    greys = ListedColormap([str(1 - DARKEST * i / most) for i in range(most + 1)])
    return axes.pcolormesh(
        curves.map_epsilon,
        curves.map_ordinate,
        pairs,
        cmap=greys,
        norm=Normalize(-0.5, most + 0.5),
        rasterized=True,
        zorder=0,
    )


def mark_special_points(axes: Axes, curves: xr.Dataset) -> list[Line2D]:
    """Points where the kind of the bifurcation changes, and their names for the legend."""
    handles = []
    kinds = curves.special_kind.values.astype(str)
    ordinate = curves[f"special_{curves.attrs['ordinate']}"].values
    for kind, (marker, name) in MARKERS.items():
        these = kinds == kind
        if not these.any():
            continue
        style = {"ls": "", "marker": marker, "color": INK, "mfc": "white", "ms": 4}
        axes.plot(curves.special_epsilon.values[these], ordinate[these], clip_on=False, **style)
        handles.append(Line2D([], [], label=name, **style))
    return handles


def draw_piece(axes: Axes, x: np.ndarray, y: np.ndarray, l1: np.ndarray, colour: str) -> None:
    """One unbroken piece, dashed where the first Lyapunov coefficient is positive."""
    ends = np.flatnonzero(np.diff(l1 > 0)) + 1
    for part in np.split(np.arange(x.size), ends):
        part = np.append(part, part[-1] + 1) if part[-1] + 1 < x.size else part
        style = "-" if l1[part[0]] < 0 else SUBCRITICAL
        axes.plot(x[part], y[part], color=colour, ls=style)


def label_branches(axes: Axes, ends: list[tuple[float, float, int, str]]) -> None:
    """Name each piece where it leaves the window: to the right, or above."""
    (_, right), (_, top) = axes.get_xlim(), axes.get_ylim()
    lowest = 0.0
    for y, x, branch, colour in sorted(ends):
        at_right = x > 0.99 * right
        height = max(y, lowest) if at_right else top
        if at_right:
            lowest = height + 0.035 * top
        axes.annotate(
            f"$k$ = {branch}",
            (x, height),
            xytext=(3, 0) if at_right else (0, 3),
            textcoords="offset points",
            ha="left" if at_right else "center",
            va="center" if at_right else "bottom",
            color=colour,
            fontsize=7,
            annotation_clip=False,
        )


def mark_scenes(
    axes: Axes,
    scenes: dict[str, dict[str, float]],
    curves: xr.Dataset,
) -> list[Line2D]:
    """Mark scenes: filled where they lie in the plane, open where only their place is shown."""
    ordinate = curves.attrs["ordinate"]
    kinds: dict[str, Line2D] = {}
    for scene in scenes.values():
        others = [
            f"${SYMBOLS[key]}$"
            for key in SYMBOLS
            if key in curves.attrs and not math.isclose(scene[key], curves.attrs[key])
        ]
        label = f"scene at another {' and '.join(others)}" if others else "scene in this plane"
        style = {"ls": "", "marker": "o", "color": INK, "mfc": "white" if others else INK}
        axes.plot(scene["epsilon"], scene[ordinate], clip_on=False, zorder=5, **style)
        kinds.setdefault(label, Line2D([], [], label=label, **style))
    return [kinds[label] for label in sorted(kinds, reverse=True)]
