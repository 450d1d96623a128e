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

HEIGHT, OF_RUN = 2.1, 0.15
"""Of a route without its strips, and of each strip, in inches."""
COLOURS = ("C6", "C2", "C3", "C7")
"""Of runs; none is that of a class."""
DOTS = (2.8, 2.2, 1.6, 1.0)
"""Sizes of the dots of runs in points. Later runs lie on top and are smaller, so that dots at the
same place are all seen."""
ROOM = 0.25
"""Free part of the axis of maxima above the largest of them, where the names of scenes stand."""
LOGARITHMIC = 100
"""The axis of maxima is logarithmic where their ratio is larger."""


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
        for number, (run, of_run) in enumerate(by_run.items()):
            colour = colours.setdefault(run, COLOURS[len(colours) % len(COLOURS)])
            style = {"color": colour, "ms": DOTS[min(number, len(DOTS) - 1)], "mew": 0}
            draw_maxima(above, runs[name, run], of_run, along, style)
            draw_exponent(below, of_run, along, style)
        draw_strips(middle, by_run, along)
        label(above, middle, below, along)
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


def label(above: Axes, strips: Axes, below: Axes, along: str) -> None:
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
    if highest > LOGARITHMIC * lowest:
        above.set_yscale("log")
        above.set_ylim(lowest / 1.5, highest * (highest / lowest) ** ROOM)
    else:
        above.set_ylim(0, (1 + ROOM) * highest if np.isfinite(highest) else None)
    above.set_ylabel("maxima of $v$")
    below.axhline(0, color=FAINT, lw=0.6, zorder=0)
    below.set(xlabel=parameters.axis_of(along), ylabel="exponent\n$\\lambda_1$")


def draw_maxima(axes: Axes, run: xr.Dataset, rows: list[dict], along: str, style: dict) -> None:
    """A dot for each maximum kept, and at v = 1 for a fixed point, whose maxima are transient."""
    there = np.array([row["class"] != "fixed point" for row in rows])
    places, maxima = maxima_of(run.isel(point=there), along)
    rest = [row[along] for row in rows if row["class"] == "fixed point"]
    axes.plot(
        np.append(places, rest),
        np.append(maxima, np.ones(len(rest))),
        "o",
        rasterized=True,
        **style,
    )


def draw_exponent(axes: Axes, rows: list[dict], along: str, style: dict) -> None:
    """The largest exponent with its standard error."""
    keys = (along, "exponent_1", "error_1")
    axes.errorbar(*([row[key] for row in rows] for key in keys), fmt="o", lw=0.5, **style)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        tables = [row for path in snakemake.input.tables for row in read_table(path)]
        files = {tuple(path[:-3].split("/")[-2:]): read(path) for path in snakemake.input.runs}
        save(draw(tables, files, snakemake.params.scenes), snakemake.output)
