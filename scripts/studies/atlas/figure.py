"""The drawing of plans/atlas.py, and the numbers of its caption."""

import math
from collections import Counter
from string import ascii_lowercase

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import SymLogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from scripts.drawing import parameters
from scripts.drawing.class_map import CELLS, KINDS, draw_classes, legend_of, mark_failures, table_of
from scripts.drawing.hopf_plane import SCENE, SUBCRITICAL, draw_piece, mark_scenes
from scripts.drawing.special_points import STYLES, in_words, words_of
from scripts.drawing.style import INK
from scripts.drawing.wording import as_formulas, place_in_words, short, with_error
from scripts.models.records import is_of_block, is_on
from scripts.tables.motion_rows import (
    axes_of,
    count_in_words,
    is_computed,
    kind_of,
    nearest_alike,
    plane_of,
    planes_of,
)

LINEAR, LARGEST = 1e-3, 0.1
"""Exponents closer to zero are coloured on a linear scale, larger ones all alike."""
CURVES = {kind: {"color": colour, "lw": 0.9} for kind, (_, colour) in STYLES.items()}
"""Of special points of cycles, by their kind."""
EDGE = [withStroke(linewidth=1.7, foreground="white")]
"""Around curves of cycles, so that they are seen over dark cells."""


def draw(
    table: list[dict], curves: list[xr.Dataset], cycles: list[xr.Dataset], scenes: dict[str, dict]
) -> Figure:
    """One plane a row: classes, and the largest exponent beside them; Hopf curves over both.

    Curves of folds, period doublings and torus bifurcations of cycles are over the classes.
    """
    planes = planes_of(table)
    figure, panels = plt.subplots(
        len(planes),
        2,
        figsize=(6.7, 1.1 + 2.4 * len(planes)),
        sharex=True,
        sharey="row",
        squeeze=False,
    )
    letters = iter(ascii_lowercase)
    drawn: set[str] = set()
    for (at, shown), (left, right) in zip(planes.items(), panels, strict=True):
        along = axes_of(shown[0])
        inside = {
            name: scene
            for name, scene in scenes.items()
            if {*along} <= scene.keys() and is_on(scene, shown[0], *along)
        }
        draw_classes(left, shown, along)
        mesh = draw_exponents(right, shown, along)
        for axes in (left, right):
            for plane in (one for one in curves if plane_of(one.attrs) == at):
                for piece in np.unique(plane.piece):
                    line = plane.isel(point=plane.piece.values == piece)
                    draw_piece(axes, *(line[key] for key in axes_of(plane.attrs)), line.l1, INK)
            mark_scenes(axes, inside, along, named=axes is left)
            axes.set_xlabel(parameters.axis_of(along[0], along[0], shown[0]))
        for line in cycles:
            if plane_of(line.attrs, along) == at:
                drawn |= draw_curves_of_cycles(left, line, along)
        symbols = parameters.in_words(shown[0], *along)
        left.set_title(f"$\\bf{{{next(letters)}}}$  {symbols}\n{count_in_words(shown)}")
        right.set_title(f"$\\bf{{{next(letters)}}}$  the same: largest Lyapunov exponent")
        left.set_ylabel(parameters.axis_of(along[1], along[1], shown[0]))
        left.label_outer()
        right.label_outer()
    unit = "units of $v_0/L$" if all(map(is_of_block, table)) else "per unit of time"
    ticks = [-LARGEST, -0.01, -LINEAR, 0, LINEAR, 0.01, LARGEST]
    figure.colorbar(
        mesh,
        ax=list(panels[:, 1]),
        label=rf"largest Lyapunov exponent $\lambda_1$ ({unit})",
        extend="both",
        pad=0.02,
        aspect=40,
        ticks=ticks,
        format=lambda value, _: parameters.true_minus(f"{value:g}"),
    )
    handles = [
        *legend_of(table),
        Line2D([], [], color=INK, label="Hopf curve, supercritical"),
        Line2D([], [], color=INK, ls=SUBCRITICAL, label="Hopf curve, subcritical"),
        *(
            Line2D([], [], label=f"{in_words(kind)} of a cycle", **CURVES[kind])
            for kind in CURVES
            if kind in drawn
        ),
        Line2D([], [], label="scene", **SCENE),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    return figure


def draw_exponents(axes: Axes, rows: list[dict], along: tuple[str, str]):
    """The largest exponent of each row, white at zero.

    A point that was not computed has that of the nearest computed one of its class.
    """
    x, y, values = table_of(rows, along, lambda row: row["exponent_1"])
    _, _, kinds = table_of(rows, along, lambda row: KINDS.index(kind_of(row)))
    _, _, computed = table_of(rows, along, is_computed)
    values = values[tuple(nearest_alike(kinds, computed == 1))]
    norm = SymLogNorm(LINEAR, vmin=-LARGEST, vmax=LARGEST)
    mesh = axes.pcolormesh(x, y, values, cmap="PuOr_r", norm=norm, **CELLS)
    mark_failures(axes, rows, along)
    return mesh


def draw_curves_of_cycles(axes: Axes, cycles: xr.Dataset, along: tuple[str, str]) -> set[str]:
    """Curves of special points of cycles, with a white edge; their kinds."""
    drawn = set()
    for number, kind in enumerate(words_of(cycles.curve_kind), start=1):
        line = cycles.isel(curve_point=cycles.curve.values == number)
        # a curve that could not be followed has one point
        if line.sizes["curve_point"] > 1:
            places = (line[f"curve_{key}"] for key in along)
            axes.plot(*places, path_effects=EDGE, zorder=3, **CURVES[kind])
            drawn.add(kind)
    return drawn


def numbers(table: list[dict]) -> dict:
    """Shares of the classes and the largest exponent in each plane."""
    planes = []
    for number, rows in enumerate(planes_of(table).values()):
        axes = axes_of(rows[0])
        counts = Counter(row["class"] for row in rows).most_common()
        shares = [(kind, 100 * count / len(rows)) for kind, count in counts]
        computed = [row for row in rows if not math.isnan(row["exponent_1"])]
        most = max(computed, key=lambda row: row["exponent_1"], default={})
        at = ", ".join(parameters.equation(key, most[key]) for key in axes if most)
        planes.append(
            {
                "panels": ", ".join(ascii_lowercase[2 * number : 2 * number + 2]),
                "place": place_in_words(rows[0], *axes),
                "shares": ", ".join(f"{kind} {short(share, 2)} %" for kind, share in shares),
                "largest": with_error(most["exponent_1"], most["error_1"]) if most else "",
                "at": as_formulas(at),
            }
        )
    taken = sum(not is_computed(row) for row in table)
    symbols = {
        name: [f":math:`{parameters.symbol_of(key)}`" for key in dict.fromkeys(keys)]
        for name, *keys in zip(("abscissas", "ordinates"), *map(axes_of, table), strict=True)
    }
    return {"planes": planes, "taken": taken, **symbols}
