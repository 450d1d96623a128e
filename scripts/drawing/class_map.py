"""Classes of motion as figures show them: cells of a map, names for the legend."""

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from scripts.drawing.style import INK
from scripts.tables.motion_rows import COLOURS, UNDECIDED, has_problem, kind_of

KINDS = list(COLOURS)
"""Their numbers in a map are their places here."""
HATCH = "////"
HATCH_GREY = "0.6"
CELLS = {"antialiased": False, "rasterized": True, "zorder": 0}
"""Cells of a map touch each other without seams, and vector files stay small."""
NO_RESULT = {"ls": "", "marker": "x", "color": INK, "ms": 3, "mew": 0.7}
"""How a point whose run failed is marked."""


def edges_of(centres: list[float]) -> np.ndarray:
    """Edges of cells around their centres, which ascend; the first and the last are cut in half."""
    if len(centres) == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    middles = np.convolve(centres, [0.5, 0.5], mode="valid")
    return np.array([centres[0], *middles, centres[-1]])


def table_of(
    rows: list[dict], axes: tuple[str, str], value
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edges along abscissa and ordinate, and a value of each row on the grid."""
    x, y = axes
    columns, lines = (sorted({row[key] for row in rows}) for key in axes)
    values = np.full((len(lines), len(columns)), np.nan)
    for row in rows:
        values[lines.index(row[y]), columns.index(row[x])] = value(row)
    return edges_of(columns), edges_of(lines), values


def draw_classes(axes: Axes, rows: list[dict], along: tuple[str, str]) -> None:
    """A cell for each row, hatched where undecided, a cross on it where the run failed."""
    x, y, numbers = table_of(rows, along, lambda row: KINDS.index(kind_of(row)))
    draw_cells(axes, x, y, numbers)
    mark_failures(axes, rows, along)


def draw_strips(axes: Axes, runs: dict[str, list[dict]], along: str) -> None:
    """Classes along a parameter, a strip for each run, the first on top."""
    for line, rows in enumerate(runs.values()):
        ordered = sorted(rows, key=lambda row: row[along])
        x = edges_of([row[along] for row in ordered])
        numbers = np.array([[KINDS.index(kind_of(row)) for row in ordered]])
        draw_cells(axes, x, np.array([line - 0.45, line + 0.45]), numbers)
        for row in filter(has_problem, ordered):
            axes.plot(row[along], line, clip_on=False, **NO_RESULT)
    axes.set(ylim=(len(runs) - 0.5, -0.5), yticks=range(len(runs)), yticklabels=list(runs))


def draw_cells(axes: Axes, x: np.ndarray, y: np.ndarray, numbers: np.ndarray) -> None:
    """Cells between these edges, coloured by their kinds, hatched where undecided."""
    colours = ListedColormap(list(COLOURS.values()))
    axes.pcolormesh(x, y, numbers, cmap=colours, vmin=-0.5, vmax=len(KINDS) - 0.5, **CELLS)
    unsure = np.argwhere(numbers == KINDS.index(UNDECIDED))
    boxes = [Rectangle((x[i], y[k]), x[i + 1] - x[i], y[k + 1] - y[k]) for k, i in unsure]
    with mpl.rc_context({"hatch.linewidth": 0.3}):
        hatched = PatchCollection(
            boxes, facecolor="none", edgecolor=HATCH_GREY, lw=0, hatch=HATCH, zorder=0.5
        )
        axes.add_collection(hatched, autolim=False)
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))


def mark_failures(axes: Axes, rows: list[dict], along: tuple[str, str]) -> None:
    """A cross where the run failed."""
    for row in filter(has_problem, rows):
        axes.plot(*(row[key] for key in along), clip_on=False, **NO_RESULT)


def legend_of(rows: list[dict]) -> list[Artist]:
    """Names of the kinds that these rows hold."""
    met = {kind_of(row) for row in rows}
    handles: list[Artist] = [
        Patch(
            facecolor=colour,
            edgecolor=HATCH_GREY,
            lw=0.4,
            label=kind,
            hatch=HATCH if kind == UNDECIDED else None,
        )
        for kind, colour in COLOURS.items()
        if kind in met
    ]
    if any(map(has_problem, rows)):
        handles.append(Line2D([], [], label="run failed", **NO_RESULT))
    return handles
