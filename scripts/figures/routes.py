"""Figure of the routes: maxima of v, classes, and the largest exponent along a parameter."""

from itertools import groupby

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing import parameters
from scripts.drawing.along_parameter import mark_scenes, maxima_of
from scripts.drawing.class_map import draw_strips, legend_of
from scripts.drawing.style import FAINT, logged, save
from scripts.files.inputs import read
from scripts.files.tsv import read_table
from scripts.tables.motion_rows import count_in_words, parameter_of

HEIGHT, OF_RUN = 1.9, 0.15
"""Of a route without its strips, and of each strip, in inches."""
COLOURS = ("C6", "C2", "C3", "C7")
"""Of runs; none is that of a class."""
SPREAD, MOST_SPREAD = 0.2, 0.006
"""Distance between the dots of two runs at the same place: a share of the distance of places, and
at most a share of the route."""
ROOM = 1.25
"""End of the axis of maxima over the largest of them."""
FEW, DOT, SMALL_DOT = 30, 3.5, 1.8
"""Up to this number of places of a run, dots are larger, in points."""
LEAST_SCALE = 1e-3
"""Exponents closer to zero than this are drawn on a linear scale."""


def draw(
    rows: list[dict], runs: dict[tuple[str, str], xr.Dataset], scenes: dict[str, dict]
) -> Figure:
    """One route below the other; `runs` are the files by route and run."""
    routes = {name: list(of_route) for name, of_route in groupby(rows, lambda row: row["route"])}
    strips = [len(names_of(of_route)) for of_route in routes.values()]
    figure, grid = plt.subplots(
        3 * len(routes),
        1,
        figsize=(6.7, HEIGHT * len(routes) + OF_RUN * sum(strips) + 0.5),
        height_ratios=[ratio for runs_there in strips for ratio in (6, runs_there, 3.4)],
    )
    colours: dict[str, str] = {}
    for i, (name, of_route) in enumerate(routes.items()):
        along = parameter_of(of_route)
        by_run = {run: [r for r in of_route if r["run"] == run] for run in names_of(of_route)}
        above, middle, below = grid[3 * i : 3 * i + 3]
        step = spread(of_route, along)
        for number, (run, of_run) in enumerate(by_run.items()):
            colour = colours.setdefault(run, COLOURS[len(colours) % len(COLOURS)])
            shift = (number - 0.5 * (len(by_run) - 1)) * step
            draw_maxima(above, runs[name, run], of_run, along, shift, colour)
            draw_exponent(below, of_run, along, shift, colour)
        draw_strips(middle, by_run, along)
        label(above, middle, below, along, 0.5 * (len(by_run) - 1) * step)
        mark_scenes(above, scenes, of_route[0], along)
        words = f"{parameters.in_words(of_route[0], along)}: {count_in_words(of_route)}"
        letter = f"$\\bf{{{'abcdefgh'[i % 8]}}}$  " if len(routes) > 1 else ""
        above.set_title(f"{letter}{words}")
    dots = [
        Line2D([], [], ls="", marker="o", ms=3, color=colour, label=run)
        for run, colour in colours.items()
    ]
    figure.legend(handles=dots + legend_of(rows), loc="outside lower center", ncols=5)
    return figure


def names_of(rows: list[dict]) -> list[str]:
    """Names of the runs, in order."""
    return list(dict.fromkeys(row["run"] for row in rows))


def spread(rows: list[dict], along: str) -> float:
    """Distance between the dots of two runs at the same place."""
    places = {row[along] for row in rows}
    return (max(places) - min(places)) * min(MOST_SPREAD, SPREAD / (len(places) - 1))


def label(above: Axes, strips: Axes, below: Axes, along: str, shift: float) -> None:
    """The same abscissa for the three, named below; dots are shifted by so much at most."""
    first, last = strips.get_xlim()
    margin = shift + 0.01 * (last - first)
    for axes in (above, strips, below):
        axes.set_xlim(first - margin, last + margin)
    for axes in (above, strips):
        axes.tick_params(labelbottom=False)
    strips.tick_params(left=False, bottom=False, pad=1, labelsize=7)
    for side in ("left", "bottom"):
        strips.spines[side].set_visible(False)
    # the names of scenes stand above the dots
    highest = above.dataLim.y1
    above.set_ylim(0, ROOM * highest if np.isfinite(highest) else None)
    above.set_ylabel("maxima of $v$")
    below.axhline(0, color=FAINT, lw=0.6, zorder=0)
    below.set_yscale("symlog", linthresh=LEAST_SCALE)
    below.set_yticks([-0.1, 0, 0.1], ["$-0.1$", "$0$", "$0.1$"])
    below.set_yticks([-0.01, -LEAST_SCALE, LEAST_SCALE, 0.01], minor=True)
    below.tick_params(axis="y", which="minor", labelleft=False)
    below.set(xlabel=parameters.axis_of(along), ylabel="exponent\n$\\lambda_1$")


def dot(rows: list[dict]) -> float:
    """Size of the dots of a run."""
    return SMALL_DOT if len(rows) > FEW else DOT


def draw_maxima(
    axes: Axes, run: xr.Dataset, rows: list[dict], along: str, shift: float, colour: str
) -> None:
    """A dot for each maximum kept, and at v = 1 for a fixed point, whose maxima are transient."""
    there = np.array([row["class"] != "fixed point" for row in rows])
    places, maxima = maxima_of(run.isel(point=there), along)
    rest = [row[along] for row in rows if row["class"] == "fixed point"]
    axes.plot(
        np.append(places, rest) + shift,
        np.append(maxima, np.ones(len(rest))),
        ".",
        color=colour,
        ms=dot(rows),
        mew=0,
        rasterized=True,
    )


def draw_exponent(axes: Axes, rows: list[dict], along: str, shift: float, colour: str) -> None:
    """The largest exponent with its standard error."""
    places, values, errors = (
        np.array([row[key] for row in rows]) for key in (along, "exponent_1", "error_1")
    )
    # a dot "o" is larger than "."
    style = {"fmt": "o", "ms": 0.8 * dot(rows), "mew": 0, "lw": 0.5, "color": colour}
    axes.errorbar(places + shift, values, errors, **style)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        tables = [row for path in snakemake.input.tables for row in read_table(path)]
        files = {tuple(path[:-3].split("/")[-2:]): read(path) for path in snakemake.input.runs}
        save(draw(tables, files, snakemake.params.scenes), snakemake.output)
