"""Draws docs/dense-output.png from the committed table of `fortran/dde/benchmarks/run dense`.

After a new measurement: PYTHONPATH=. python docs/dense_picture.py
"""

from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from small_picture import shrink

from scripts.drawing.style import FAINT, INK, STYLE
from scripts.files.tsv import read_table

ROOT = Path(__file__).parents[1]
PANELS = {
    "this solver, without delay": ("dde", ("decay", "switch")),
    "SciPy, without delay": ("SciPy", ("decay", "switch")),
    "this solver, with delay": ("dde", ("pulse", "returning pulse")),
}
"""Solver and layers of each panel."""
TOLERANCES = {1e-3: "1e-3", 1e-6: "1e-6", 1e-9: "1e-9", 1e-12: "1e-12"}


def draw(rows: list[dict]) -> Figure:
    """The largest ratio of each method, layer and tolerance."""
    figure, grid = plt.subplots(1, 3, figsize=(6.7, 3.2), sharey=True, width_ratios=(7, 6, 7))
    look = {"ls": "", "mfc": "none", "ms": 3.5}
    for axes, (title, (solver, layers)) in zip(grid, PANELS.items(), strict=True):
        methods = list(dict.fromkeys(row["method"] for row in rows if row["solver"] == solver))
        axes.axhline(1.0, color=FAINT, zorder=0)
        for layer, marker in zip(layers, "os", strict=True):
            axes.plot([], [], marker, label=layer, color=INK, **look)
            for k, tolerance in enumerate(TOLERANCES):
                shown = {
                    methods.index(row["method"]) + 0.2 * k - 0.3: row["ratio"]
                    for row in rows
                    if (row["solver"], row["layer"]) == (solver, layer)
                    and row["tolerance"] == tolerance
                }
                axes.plot(shown.keys(), shown.values(), marker, color=f"C{k}", **look)
        axes.set(title=title, yscale="log")
        axes.set_xticks(range(len(methods)), methods, rotation=60)
        axes.legend(loc="upper left")
    grid[0].set_ylabel("error of dense output\nover error at steps, or tolerance")
    handles = [Line2D([], [], ls="", c=f"C{k}", marker="o") for k in range(len(TOLERANCES))]
    labels = TOLERANCES.values()
    figure.legend(handles, labels, title="tolerance", loc="outside lower center", ncols=4)
    return figure


if __name__ == "__main__":
    table = ROOT / "fortran" / "dde" / "benchmarks" / "measured-dense.tsv"
    large = ROOT / "build" / "dense-output.png"
    with plt.style.context(STYLE):
        draw(read_table(table)).savefig(large)
    shrink(large, ROOT / "docs" / "dense-output.png")
