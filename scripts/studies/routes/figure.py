"""The drawing of plans/routes.py, and the numbers of its caption."""

from string import ascii_lowercase

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing import parameters
from scripts.drawing.along_parameter import mark_scenes, maxima_of
from scripts.drawing.class_map import draw_strips, legend_of
from scripts.drawing.style import FAINT, PAGE, columns_of
from scripts.drawing.wording import joined, place_in_words, short
from scripts.files.tsv import rows_by
from scripts.models.records import is_of_block
from scripts.tables.attractor_tables import same_attractor
from scripts.tables.motion_rows import UNDECIDED, count_in_words, has_problem, parameter_of

HEIGHT, OF_RUN = 2.1, 0.12
"""Of a route without its strips, and of each strip, in inches."""
COLOURS = ("C6", "C2", "C3", "C7", "C5", "#d0609a", "0.5", "C4")
"""Of runs; no colour is that of a class."""
SWEEPS = {"up": "-", "down": "--"}
"""Lines through the largest maxima of sweeps: where they part there is hysteresis."""
DOTS = (3.2, 1.4)
"""Sizes of the dots of the first and the last run in points. Later runs lie on top and are smaller,
so that dots at the same place are all seen."""
ROOM = 0.35
"""Free part of the axis of maxima above the largest of them, where the names of scenes stand."""
LOGARITHMIC = 100
"""The axis of maxima is logarithmic where their ratio is larger."""


def draw(tables: list[list[dict]], runs: list[xr.Dataset], scenes: dict[str, dict]) -> Figure:
    """One route below the other; `runs` are in the order of the tables."""
    routes = [rows_by(rows, "run") for rows in tables]
    strips = list(map(len, routes))
    following = iter(runs)
    most = max(strips)
    columns = columns_of(len(tables), HEIGHT + OF_RUN * most)
    lines = -(-len(tables) // columns)
    height = min(PAGE[1], (HEIGHT + OF_RUN * most) * lines + 0.5)
    figure, grid = plt.subplots(
        3 * lines,
        columns,
        figsize=(PAGE[0], height),
        squeeze=False,
        height_ratios=[6, most, 3.4] * lines,
    )
    for axes in grid[3 * (len(tables) // columns) :, len(tables) % columns :].flat:
        axes.remove()
    colours: dict[str, str] = {}
    for i, (rows, by_run) in enumerate(zip(tables, routes, strict=True)):
        along = parameter_of(rows)
        line, column = divmod(i, columns)
        above, middle, below = grid[3 * line : 3 * line + 3, column]
        sizes = np.linspace(*DOTS, len(by_run))
        for (run, of_run), size in zip(by_run.items(), sizes, strict=True):
            colour = colours.setdefault(run, COLOURS[len(colours) % len(COLOURS)])
            style = {"color": colour, "ms": size, "mew": 0}
            data = next(following)
            draw_maxima(above, data, of_run, along, SWEEPS.get(run, ""), style)
            keys = (along, "exponent_1", "error_1")
            exponents = ([row[key] for row in of_run] for key in keys)
            below.errorbar(*exponents, fmt="o", lw=0.5, **style)
        draw_strips(middle, by_run, along)
        meaning = data[along].attrs.get("long_name", "") if along in data else ""
        label(above, middle, below, parameters.axis_of(along, meaning, rows[0]))
        above.set_ylabel(f"maxima of ${data.attrs['signal']}$")
        mark_scenes(above, scenes, rows[0], along)
        between = ": " if columns == 1 else "\n"
        words = f"{parameters.in_words(rows[0], along)}{between}{count_in_words(rows)}"
        letter = f"$\\bf{{{'abcdefgh'[i % 8]}}}$  " if len(tables) > 1 else ""
        above.set_title(f"{letter}{words}")
    dots = [
        Line2D([], [], ls=SWEEPS.get(run, ""), lw=0.6, marker="o", ms=3, color=colour, label=run)
        for run, colour in colours.items()
    ]
    all_rows = [row for rows in tables for row in rows]
    figure.legend(handles=dots + legend_of(all_rows), loc="outside lower center", ncols=5)
    return figure


def label(above: Axes, strips: Axes, below: Axes, abscissa: str) -> None:
    """The same abscissa for the three, named below."""
    first, last = strips.get_xlim()
    margin = 0.01 * (last - first)
    for axes in (above, strips, below):
        axes.set_xlim(first - margin, last + margin)
    for axes in (above, strips):
        axes.tick_params(labelbottom=False)
    strips.tick_params(left=False, bottom=False, pad=1, labelsize=7)
    for side in ("left", "bottom"):
        strips.spines[side].set_visible(False)
    lowest, highest = above.dataLim.y0, above.dataLim.y1
    if 0 < LOGARITHMIC * lowest < highest:
        above.set_yscale("log")
        above.set_ylim(lowest / 1.5, highest * (highest / lowest) ** ROOM)
    elif lowest >= 0 or not np.isfinite(highest):
        above.set_ylim(0, (1 + ROOM) * highest if np.isfinite(highest) else None)
    below.axhline(0, color=FAINT, lw=0.6, zorder=0)
    below.set(xlabel=abscissa, ylabel="exponent\n$\\lambda_1$")


def draw_maxima(
    axes: Axes, run: xr.Dataset, rows: list[dict], along: str, line: str, style: dict
) -> None:
    """A dot for each maximum kept, and at v = 1 for steady sliding, whose maxima are transient.

    A kind of line joins the largest.
    """
    there = np.array([row["class"] != "fixed point" for row in rows])
    places, maxima = maxima_of(run.isel(point=there), along)
    rests = [row for row in rows if row["class"] == "fixed point" and is_of_block(row)]
    rest = [row[along] for row in rests]
    x, y = np.append(places, rest), np.append(maxima, np.ones(len(rest)))
    axes.plot(x, y, "o", rasterized=True, **style)
    if line:
        each = np.unique(x)
        top = [y[x == place].max() for place in each]
        axes.plot(each, top, color=style["color"], ls=line, lw=0.6)


def numbers(tables: list[list[dict]], runs: list[xr.Dataset]) -> dict:
    """Where each class first appears along each route, run by run, and where runs differ."""
    routes = []
    for letter, rows in zip(ascii_lowercase, tables, strict=False):
        along = parameter_of(rows)
        alike: dict[str, list[str]] = {}
        for run, of_run in rows_by(rows, "run").items():
            alike.setdefault(first_appearances(of_run, along), []).append(run)
        places = sorted(rows_by(rows, along).items())
        routes.append(
            {
                "letter": letter,
                "symbol": parameters.symbol_of(along),
                "place": place_in_words(rows[0], along),
                "runs": [
                    {"names": f"run{'s' * (len(names) > 1)} {joined(names)}", "first": first}
                    for first, names in alike.items()
                ],
                "parted": [
                    short(place, 4)
                    for place, there in places
                    if len({row["class"] for row in there} - {UNDECIDED}) > 1
                ],
                "places": len(places),
                "several": [short(place) for place, there in places if coexist(there)],
            }
        )
    signals = dict.fromkeys(run.attrs["signal"] for run in runs)
    return {"routes": routes, "points": sum(map(len, tables)), "signals": list(signals)}


def first_appearances(rows: list[dict], along: str) -> str:
    """Classes of a run with the least value of the parameter at which each appears."""
    first: dict[str, float] = {}
    for row in sorted(rows, key=lambda row: row[along]):
        if row["class"] != UNDECIDED:
            first.setdefault(row["class"], row[along])
    return joined([f"{kind} {place:g}" for kind, place in first.items()]) or "none is decided"


def coexist(rows: list[dict]) -> bool:
    """Whether runs at the same parameters reached different motions."""
    decided = [row for row in rows if row["class"] != UNDECIDED and not has_problem(row)]
    return any(not same_attractor(decided[0], row) for row in decided[1:])
