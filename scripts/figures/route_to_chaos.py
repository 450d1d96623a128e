"""Figure of the route to chaos: maxima of v, classes and exponents along a line of epsilon."""

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing.class_map import draw_classes, legend_of
from scripts.drawing.style import FAINT, INK, logged, save
from scripts.files.inputs import read
from scripts.files.tsv import read_table
from scripts.tables.motion_rows import count_in_words, first_met

EXPONENTS = (1, 2, 3)
LEAST_SCALE = 1e-3
"""Exponents closer to zero than this are drawn on a linear scale."""


def draw(rows: list[dict], runs: list[xr.Dataset]) -> Figure:
    """Maxima above, classes as a strip, exponents below."""
    figure, (above, strip, below) = plt.subplots(
        3, 1, figsize=(6.7, 5.6), height_ratios=[10, 0.8, 8], sharex=True
    )
    for run in runs:
        draw_maxima(above, run)
    above.set_ylabel("maxima of $v$")
    above.set_ylim(bottom=0)
    above.set_title(words(rows))
    draw_classes(strip, [{**row, "line": 0.0} for row in rows], "line")
    strip.set(yticks=[], ylabel="class")
    strip.yaxis.label.set(rotation=0, ha="right", va="center")
    strip.tick_params(bottom=False)
    draw_exponents(below, rows)
    first, last = below.get_xlim()
    margin = 0.01 * (last - first)
    below.set(
        xlim=(first - margin, last + margin),
        xlabel=r"sensitivity of the velocity relaxation $\varepsilon$",
        ylabel=r"exponent $\lambda_i$",
    )
    numbers = [
        Line2D([], [], ls="", marker="o", color=f"C{i - 1}", label=rf"$\lambda_{i}$")
        for i in EXPONENTS
    ]
    figure.legend(handles=legend_of(rows) + numbers, loc="outside lower center", ncols=5)
    return figure


def words(rows: list[dict]) -> str:
    """Parameters, and the classes in the order in which they are first met."""
    one = rows[0]
    line = rf"$\tau$ = {one['tau']:g}, $\xi$ = {one['xi']:g}, $\gamma$ = {one['gamma']:g}"
    met = [rf"{name} from {epsilon:.3g}" for name, epsilon in first_met(rows).items()]
    route = ", ".join(met) if met else "none"
    return f"{line}: {count_in_words(rows)}\nwith growing $\\varepsilon$ first met: {route}"


def draw_maxima(axes: Axes, run: xr.Dataset) -> None:
    """A dot for each maximum kept, over its epsilon."""
    epsilon = np.broadcast_to(run.epsilon.values[:, None], run.maximum.shape)
    there = run.maximum.values > 0
    axes.plot(
        epsilon[there], run.maximum.values[there], ".", color=INK, ms=1.5, mew=0, rasterized=True
    )


def draw_exponents(axes: Axes, rows: list[dict]) -> None:
    """The leading exponents with their standard errors."""
    axes.axhline(0, color=FAINT, lw=0.6, zorder=0)
    epsilon = [row["epsilon"] for row in rows]
    for i in EXPONENTS:
        values, errors = ([row[f"{key}_{i}"] for row in rows] for key in ("exponent", "error"))
        style = {"fmt": "o", "ms": 2, "capsize": 1.5, "lw": 0.7, "color": f"C{i - 1}"}
        axes.errorbar(epsilon, values, errors, **style)
    axes.set_yscale("symlog", linthresh=LEAST_SCALE)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        runs = [read(path) for path in snakemake.input.runs]
        figure = draw(read_table(snakemake.input.table), runs)
        save(figure, snakemake.output)
