"""The drawing of plans/plane.py, and the numbers of its caption."""

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing.hopf_plane import SCENE, SUBCRITICAL, UNKNOWN, draw_piece, mark_scenes
from scripts.drawing.parameters import axis_of, in_words, symbol_of
from scripts.drawing.special_points import words_of
from scripts.drawing.style import INK
from scripts.drawing.wording import counted_at, place_in_words, short
from scripts.models.records import is_of_block
from scripts.tables.motion_rows import axes_of

DARKEST = 0.3
"""How much darker than white the most unstable roots are."""
CLOSE = 0.14
"""Names above the window are joined if they are closer, as a share of its width."""
MARKERS = {
    "generalised_hopf": ("D", "generalised Hopf point"),
    "double_hopf": ("s", "double Hopf point"),
    "hopf_without_delay": ("^", "Hopf point without delay"),
}


def draw(curves: xr.Dataset, scenes: dict[str, dict[str, float]]) -> Figure:
    """Curves by branch, solid where supercritical, over unstable roots; scenes of this plane."""
    along = axes_of(curves.attrs)
    figure, axes = plt.subplots(figsize=(3.6, 4.6))
    axes.set(xlim=window_of(curves.map_abscissa.values), ylim=window_of(curves.map_ordinate.values))
    shades = shade(axes, curves)
    ends = []
    for piece in np.unique(curves.piece):
        line = curves.isel(point=curves.piece.values == piece)
        branch = int(line.branch[0])
        colour = f"C{branch % 8}"
        x, y = (line[key].values for key in along)
        draw_piece(axes, x, y, line.l1.values, colour)
        last = x.argmax() if x.max() > 0.99 * axes.get_xlim()[1] else y.argmax()
        ends.append((float(y[last]), float(x[last]), branch, colour))
    points = mark_special_points(axes, curves)
    label_branches(axes, ends)
    mark_scenes(axes, scenes, along)
    axes.set_title(in_words(curves.attrs, *along), pad=14)
    meanings = [curves[key].attrs.get("long_name", "") for key in along]
    x, y = (axis_of(*each, curves.attrs) for each in zip(along, meanings, strict=True))
    axes.set(xlabel=x, ylabel=y)
    unknown = np.isnan(curves.l1.values)
    kinds = {"supercritical": "-", "subcritical": SUBCRITICAL} if (~unknown).any() else {}
    kinds |= {"l1 unknown": UNKNOWN} if unknown.any() else {}
    handles = [Line2D([], [], color=INK, ls=ls, label=kind) for kind, ls in kinds.items()]
    marked = [Line2D([], [], label="scene", **SCENE)] if scenes else []
    bar = figure.colorbar(shades, ax=axes, label="unstable roots", location="bottom")
    bar.set_ticks(np.unique(curves.map_unstable_roots))
    figure.legend(handles=handles + points + marked, loc="outside lower center", ncols=2)
    return figure


def window_of(centres: np.ndarray) -> tuple[float, float]:
    """The ends of the window of which these are the centres of the cells."""
    half = (centres[-1] - centres[0]) / (2 * (centres.size - 1)) if centres.size > 1 else centres[0]
    return float(centres[0] - half), float(centres[-1] + half)


def shade(axes: Axes, curves: xr.Dataset):
    """The number of unstable roots, white where there is none."""
    roots = curves.map_unstable_roots.values
    most = max(int(roots.max()), 1)
    greys = ListedColormap([str(1 - DARKEST * i / most) for i in range(most + 1)])
    return axes.pcolormesh(
        curves.map_abscissa,
        curves.map_ordinate,
        roots,
        cmap=greys,
        norm=Normalize(-0.5, most + 0.5),
        rasterized=True,
        zorder=0,
    )


def mark_special_points(axes: Axes, curves: xr.Dataset) -> list[Line2D]:
    """Points where the kind of the bifurcation changes, and their names for the legend."""
    handles = []
    kinds = curves.special_kind.values.astype(str)
    x, y = (curves[f"special_{key}"].values for key in axes_of(curves.attrs))
    for kind, (marker, name) in MARKERS.items():
        these = kinds == kind
        if these.any():
            style = {"ls": "", "marker": marker, "color": INK, "mfc": "white", "ms": 4}
            handles += axes.plot(x[these], y[these], clip_on=False, label=name, **style)
    return handles


def label_branches(axes: Axes, ends: list[tuple[float, float, int, str]]) -> None:
    """Name each piece where it leaves the window: to the right, or above, there close ones once."""
    (left, right), (_, top) = axes.get_xlim(), axes.get_ylim()
    style = {"textcoords": "offset points", "fontsize": 7, "annotation_clip": False}
    lowest = 0.0
    for y, x, branch, colour in sorted(end for end in ends if end[1] > 0.99 * right):
        place = (x, max(y, lowest))
        lowest = place[1] + 0.035 * top
        words = f"$k$ = {branch}"
        axes.annotate(words, place, xytext=(3, 0), va="center", color=colour, **style)
    above = sorted((x, branch, colour) for _, x, branch, colour in ends if x <= 0.99 * right)
    far = np.diff([x for x, *_ in above]) > CLOSE * (right - left)
    for group in np.split(np.arange(len(above)), np.flatnonzero(far) + 1) if above else []:
        xs, branches, colours = zip(*(above[i] for i in group), strict=True)
        words = f"$k$ = {', '.join(map(str, dict.fromkeys(branches)))}"
        colour = colours[0] if len(set(branches)) == 1 else INK
        place = (float(np.mean(xs)), top)
        axes.annotate(words, place, xytext=(0, 3), ha="center", color=colour, **style)


def numbers(curves: xr.Dataset, scenes: dict[str, dict]) -> dict:
    """Counts along the curves, the boundary of stability, special points, scenes in the plane."""
    along = axes_of(curves.attrs)
    boundary = curves.isel(point=curves.unstable_roots.values == 0)
    kinds = words_of(curves.special_kind)
    places = (curves[f"special_{key}"].values.tolist() for key in along)
    points = sorted(zip(kinds, *places, strict=True))
    places = {
        kind: [f"({short(x)}, {short(y)})" for its_kind, x, y in points if its_kind == kind]
        for kind in MARKERS
    }
    return {
        "place": place_in_words(curves.attrs, *along),
        "stable_in": "Steady sliding is stable"
        if is_of_block(curves.attrs)
        else "No root is unstable",
        "abscissa": f":math:`{symbol_of(along[0])}`",
        "ordinate": f":math:`{symbol_of(along[1])}`",
        "branches": np.unique(curves.branch).size,
        "points": curves.sizes["point"],
        "subcritical": int((curves.l1 > 0).sum()),
        "unknown": int(np.isnan(curves.l1).sum()),
        "stabilising": int((curves.crossing < 0).sum()),
        "stable": short(100 * float((curves.map_unstable_roots == 0).mean()), 3),
        "boundary": ends_of(boundary[along[0]]),
        "ordinates": ends_of(boundary[along[1]]),
        "without_delay": [x for kind, x, _ in points if kind == "hopf_without_delay"],
        "generalised": len(places["generalised_hopf"]),
        "double": len(places["double_hopf"]),
        "special": [counted_at(MARKERS[kind][1], at) for kind, at in places.items() if at],
        "inside": [name.replace("_", " ") for name in scenes],
    }


def ends_of(values: xr.DataArray) -> tuple[str, str]:
    """The least and the largest of values that may be none."""
    return (short(values.min()), short(values.max())) if values.size else ("none", "none")
