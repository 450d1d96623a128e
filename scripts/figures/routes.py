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

HEIGHT = 2.3
"""Of a route, in inches."""
COLOURS = ("C6", "C2", "C3", "C7")
"""Of runs; none is that of a class."""
SPREAD = 0.2
"""Distance between the dots of two runs at the same place, as a share of the distance of places."""
LEAST_SCALE = 1e-3
"""Exponents closer to zero than this are drawn on a linear scale."""


def draw(
    rows: list[dict], runs: dict[tuple[str, str], xr.Dataset], scenes: dict[str, dict]
) -> Figure:
    """One route below the other; `runs` are the files by route and run."""
    routes = {name: list(of_route) for name, of_route in groupby(rows, lambda row: row["route"])}
    figure, grid = plt.subplots(
        3 * len(routes),
        1,
        figsize=(6.7, HEIGHT * len(routes) + 0.5),
        height_ratios=[6, 2.6, 3.4] * len(routes),
    )
    colours: dict[str, str] = {}
    for i, (name, of_route) in enumerate(routes.items()):
        along = parameter_of(of_route)
        by_run = {run: [r for r in of_route if r["run"] == run] for run in names_of(of_route)}
        above, strips, below = grid[3 * i : 3 * i + 3]
        for number, (run, of_run) in enumerate(by_run.items()):
            colour = colours.setdefault(run, COLOURS[len(colours) % len(COLOURS)])
            shift = (number - 0.5 * (len(by_run) - 1)) * SPREAD * distance(of_run, along)
            draw_maxima(above, runs[name, run], along, shift, colour)
            draw_exponent(below, of_run, along, shift, colour)
        draw_strips(strips, by_run, along)
        label(above, strips, below, along)
        mark_scenes(above, scenes, of_route[0], along)
        words = f"{parameters.in_words(of_route[0], along)}: {count_in_words(of_route)}"
        above.set_title(f"$\\bf{{{'abcdefgh'[i % 8]}}}$  {words}")
    dots = [
        Line2D([], [], ls="", marker="o", ms=3, color=colour, label=run)
        for run, colour in colours.items()
    ]
    figure.legend(handles=dots + legend_of(rows), loc="outside lower center", ncols=5)
    return figure


def names_of(rows: list[dict]) -> list[str]:
    """Names of the runs, in order."""
    return list(dict.fromkeys(row["run"] for row in rows))


def distance(rows: list[dict], along: str) -> float:
    """Between neighbouring places of a run; 0 where there is one."""
    places = [row[along] for row in rows]
    return (max(places) - min(places)) / max(1, len(places) - 1)


def label(above: Axes, strips: Axes, below: Axes, along: str) -> None:
    """The same abscissa for the three, named below."""
    first, last = strips.get_xlim()
    margin = 0.01 * (last - first)
    for axes in (above, strips, below):
        axes.set_xlim(first - margin, last + margin)
    for axes in (above, strips):
        axes.tick_params(labelbottom=False)
    strips.tick_params(left=False, bottom=False, pad=1, labelsize=6)
    for side in ("left", "bottom"):
        strips.spines[side].set_visible(False)
    # the names of scenes stand above the dots
    above.margins(y=0.15)
    above.set_ylim(bottom=0)
    above.set_ylabel("maxima of $v$")
    below.axhline(0, color=FAINT, lw=0.6, zorder=0)
    below.set_yscale("symlog", linthresh=LEAST_SCALE)
    below.set_yticks([-0.1, 0, 0.1], ["$-0.1$", "$0$", "$0.1$"])
    below.set_yticks([-0.01, -LEAST_SCALE, LEAST_SCALE, 0.01], minor=True)
    below.tick_params(axis="y", which="minor", labelleft=False)
    below.set(xlabel=parameters.axis_of(along), ylabel=r"exponent $\lambda_1$")


def draw_maxima(axes: Axes, run: xr.Dataset, along: str, shift: float, colour: str) -> None:
    """A dot for each maximum kept."""
    places, maxima = maxima_of(run, along)
    axes.plot(places + shift, maxima, ".", color=colour, ms=1.8, mew=0, rasterized=True)


def draw_exponent(axes: Axes, rows: list[dict], along: str, shift: float, colour: str) -> None:
    """The largest exponent with its standard error."""
    places, values, errors = (
        np.array([row[key] for row in rows]) for key in (along, "exponent_1", "error_1")
    )
    axes.errorbar(places + shift, values, errors, fmt="o", ms=1.5, mew=0, lw=0.5, color=colour)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        tables = [row for path in snakemake.input.tables for row in read_table(path)]
        files = {tuple(path[:-3].split("/")[-2:]): read(path) for path in snakemake.input.runs}
        save(draw(tables, files, snakemake.params.scenes), snakemake.output)
