"""The drawing of plans/stability.py, and the numbers of its caption."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from scripts.drawing.parameters import number
from scripts.drawing.style import FAINT, INK
from scripts.drawing.wording import short
from scripts.files.tsv import rows_by
from scripts.studies.stability.table import WITHIN_EXPECTED, is_within_expected

GRID = "grid_"
"""How names of the grid's families begin."""
LEVELS = np.arange(-14, 1, 2)
"""Powers of ten between the colours of errors."""


def draw(table: list[dict]) -> Figure:
    """Two maps above, errors against what is expected below."""
    figure, axes = plt.subplot_mosaic(
        [["a", "b"], ["c", "c"]], figsize=(6.7, 5.2), height_ratios=[1, 1.15]
    )
    by_method = rows_by(table, "method")
    for label, (method, rows) in zip("ab", by_method.items(), strict=False):
        shown = [row for row in rows if row["family"].startswith(GRID)]
        mesh = draw_map(axes[label], shown)
        axes[label].set_title(f"$\\bf{{{label}}}$  {method}, {tolerances(shown)}")
    axes["b"].set_ylabel("")
    bar = figure.colorbar(mesh, ax=[axes["a"], axes["b"]], pad=0.02)
    bar.set_label("largest error")
    bar.set_ticks(10.0**LEVELS, labels=[f"$10^{{{level}}}$" for level in LEVELS])
    draw_errors(axes["c"], by_method)
    axes["c"].set_title(rf"$\bf{{c}}$  all cases with a reference, {tolerances(table)}")
    return figure


def draw_map(axes: Axes, rows: list[dict]):
    """Errors over delay and frequency; a cross where the run did not reach its end."""
    delays = sorted({row["tau"] for row in rows})
    frequencies = sorted({row["gamma"] for row in rows})
    errors = np.full((len(frequencies), len(delays)), np.nan)
    for row in rows:
        y, x = frequencies.index(row["gamma"]), delays.index(row["tau"])
        if row["status"] == "ok":
            errors[y, x] = max(row["error"], 10.0 ** LEVELS[0])
        else:
            axes.plot(x, y, "x", color=INK, ms=4, mew=0.8)
    colours = plt.get_cmap("viridis_r").copy()
    norm = BoundaryNorm(10.0**LEVELS, colours.N, extend="max")
    mesh = axes.pcolormesh(
        range(len(delays)),
        range(len(frequencies)),
        errors,
        shading="nearest",
        cmap=colours,
        norm=norm,
        edgecolors="white",
        lw=0.5,
    )
    axes.set_xticks(range(len(delays)), [f"${number(delay)}$" for delay in delays])
    axes.set_yticks(range(len(frequencies)), [f"${number(value)}$" for value in frequencies])
    axes.set(xlabel=r"delay $\tau$", ylabel=r"frequency $\gamma$")
    return mesh


def tolerances(rows: list[dict]) -> str:
    """The tolerance of these runs, or all that they have."""
    values = sorted({row["tolerance"] for row in rows})
    return f"tolerance {', '.join(f'${number(value)}$' for value in values)}"


def draw_errors(axes: Axes, by_method: dict[str, list[dict]]) -> None:
    """Error of each case over tolerance times amplification."""
    for index, (method, rows) in enumerate(by_method.items()):
        measured = [row for row in rows if row["error"] > 0 and row["amplification"] > 0]
        for ended in (True, False):
            shown = [row for row in measured if (row["status"] == "ok") is ended]
            if not shown:
                continue
            axes.plot(
                [max(row["error_expected"], row["tolerance"]) for row in shown],
                [row["error"] for row in shown],
                ls="",
                marker="o^"[index % 2],
                ms=3.5,
                color=f"C{index}",
                mfc=f"C{index}" if ended else "none",
                mew=0.7,
                label=f"{method}{'' if ended else ', ended early'}",
            )
    ends = np.array([1e-10, 1e6])
    for factor, style in ((1, "-"), (WITHIN_EXPECTED, ":")):
        words = rf"{factor} $\times$ " if factor > 1 else ""
        label = f"error = {words}expected error"
        axes.plot(ends, factor * ends, color=FAINT, lw=0.8, ls=style, zorder=0, label=label)
    axes.set(
        xscale="log",
        yscale="log",
        xlim=(4e-10, None),
        ylim=(1e-16, 1e3),
        xlabel=r"expected error = tolerance $\times$ amplification of a disturbance",
        ylabel="largest error",
    )
    axes.legend(loc="lower right", ncols=2)


def numbers(table: list[dict]) -> dict:
    """Runs that are completed by each method, and errors that are within what is expected."""
    methods = []
    for method, rows in rows_by(table, "method").items():
        ended = [row for row in rows if row["status"] == "ok"]
        measured = [row for row in ended if row["error"] >= 0 and row["error_expected"] > 0]
        methods.append(
            {
                "name": method,
                "runs": len(rows),
                "completed": len(ended),
                "measured": len(measured),
                "within": sum(map(is_within_expected, measured)),
            }
        )
    values = sorted({row["tolerance"] for row in table})
    return {"methods": methods, "tolerance": ", ".join(map(short, values))}
