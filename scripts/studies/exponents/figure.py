"""The drawing of exponents, and the numbers of its caption."""

from collections import Counter

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from scripts.drawing.style import FAINT
from scripts.drawing.wording import with_error
from scripts.tables.exponent_signs import count_in_words

COLOURS = 8
"""Exponents with a colour of their own."""
LEAST_SCALE = 1e-3
"""Exponents closer to zero than this are drawn on a linear scale."""


def draw(runs: list[xr.Dataset], table: list[dict]) -> Figure:
    """One scene a row: convergence in time, in tolerance, and in the resolution of the history."""
    figure, grid = plt.subplots(
        len(runs),
        3,
        figsize=(6.7, 0.4 + 2.0 * len(runs)),
        width_ratios=[2, 1, 0.7],
        sharey="row",
        squeeze=False,
    )
    for letter, run, (left, middle, right) in zip("abcdefgh", runs, grid, strict=False):
        draw_times(left, run)
        draw_tolerances(middle, run.isel(run=np.isnan(run.longest_step)))
        draw_resolutions(right, run.isel(run=run.tolerance == run.tolerance[0]))
        scene = run.attrs["scene"]
        words = spectrum_in_words(rows_at_own_step(table, scene))
        left.set_title(f"$\\bf{{{letter}}}$  scene {scene.replace('_', ' ')}: {words}")
    handles = legend_of(max(run.sizes["exponent"] for run in runs))
    figure.legend(handles=handles, loc="outside lower center", ncols=min(len(handles), COLOURS))
    grid[-1, 0].set_xlabel("time averaged over")
    grid[-1, 1].set_xlabel("tolerance of one step")
    grid[-1, 2].set_xlabel("mean step")
    return figure


def legend_of(exponents: int) -> list[Line2D]:
    """The exponents by their colours, the largest first."""
    look = {"marker": "o", "ms": 2.5, "lw": 0.8}
    return [
        Line2D([], [], color=f"C{i % COLOURS}", label=rf"$\lambda_{{{i + 1}}}$", **look)
        for i in range(exponents)
    ]


def rows_at_own_step(table: list[dict], scene: str) -> list[dict]:
    """Exponents of a scene at its own tolerance and steps, the largest first."""
    rows = [row for row in table if row["scene"] == scene]
    return [row for row in rows if row["mean_step"] == rows[0]["mean_step"]]


def spectrum_in_words(rows: list[dict]) -> str:
    """How many exponents are positive and zero, and the dimension."""
    signs = Counter(row["sign"] for row in rows)
    value, error = rows[0]["dimension"], rows[0]["dimension_error"]
    dimension = f"{value:.2f} ± {error:.2f}" if error != 0 else f"{value:g}"
    if np.isnan(value):
        dimension = "not reached by these exponents"
    return f"{count_in_words(signs)}; Kaplan-Yorke dimension {dimension}"


def draw_times(axes: Axes, run: xr.Dataset) -> None:
    """Plain averages up to each time; at the end the values and their error bars."""
    elapsed = run.t - run.attrs["t_begin"]
    for i in range(run.sizes["exponent"]):
        axes.plot(elapsed, run.running_average[:, i], color=f"C{i % COLOURS}", lw=0.8)
    end = run.attrs["t_end"] - run.attrs["t_begin"]
    draw_bars(axes, run.isel(run=[0]), np.full((1, run.sizes["exponent"]), 1.03 * end))
    axes.set(xlim=(0, 1.06 * end), ylabel=r"exponent $\lambda_i$")


def draw_tolerances(axes: Axes, run: xr.Dataset) -> None:
    """Values and error bars at each tolerance, side by side."""
    spread = 10 ** np.linspace(-0.3, 0.3, run.sizes["exponent"])
    draw_bars(axes, run, np.outer(run.tolerance, spread))
    axes.set_xscale("log")


def draw_resolutions(axes: Axes, run: xr.Dataset) -> None:
    """Values and error bars at each mean step, side by side."""
    steps = run.mean_step.values
    spread = 0.05 * steps.max() * np.linspace(-1, 1, run.sizes["exponent"])
    draw_bars(axes, run, np.add.outer(steps, spread))
    axes.set_xlim(0, 1.15 * steps.max())
    axes.xaxis.set_major_locator(MaxNLocator(3))


def draw_bars(axes: Axes, runs: xr.Dataset, places: np.ndarray) -> None:
    """Exponents of runs at their places, shape (runs, exponents).

    Logarithmic away from zero, so that small exponents and large ones can be read.
    """
    bars = {"fmt": "o", "ms": 2.5, "capsize": 2, "lw": 0.8}
    for i in range(runs.sizes["exponent"]):
        columns = (places[:, i], runs.value[:, i], runs.error[:, i])
        axes.errorbar(*columns, color=f"C{i % COLOURS}", **bars)
    axes.axhline(0, color=FAINT, lw=0.6, zorder=0)
    axes.set_yscale("symlog", linthresh=LEAST_SCALE)


def numbers(runs: list[xr.Dataset], table: list[dict], driven: list[str]) -> dict:
    """How many exponents of each scene are positive and zero, their values, the dimension."""
    scenes = []
    for scene in (run.attrs["scene"] for run in runs):
        rows = rows_at_own_step(table, scene)
        signs = [row["sign"] for row in rows]
        values = [with_error(row["exponent"], row["error"]) for row in rows]
        scenes.append(
            {
                "name": scene.replace("_", " "),
                "driven": scene in driven,
                "positive": signs.count("positive"),
                "zero": signs.count("zero"),
                "unclear": signs.count("unclear"),
                "largest": values[0],
                "all": values,
                "dimension": with_error(rows[0]["dimension"], rows[0]["dimension_error"]),
            }
        )
    return {"scenes": scenes}
