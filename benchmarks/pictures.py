"""The ratios of `run peers` as a picture (benchmarks/run pictures)."""

import math

from matplotlib import pyplot as plt
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from measuring import options_of

from scripts.files.tsv import read_table, rows_by

MOST = 4.0
"""The ratio from which on the colour is the darkest."""
GIVEN = ("f", "jacobian", "series")


def draw(rows: list[dict]) -> Figure:
    """A line for each cell and an error in each column; red where this solver is slower."""
    cells = rows_by(rows, "given", "solver", "case")
    labels = sorted(cells, key=lambda label: (GIVEN.index(label[0]), label[1]))
    numbers = [[row["ratio"] for row in cells[label]] for label in labels]
    figure, axes = plt.subplots(figsize=(7.2, 0.22 * len(labels) + 1.2), layout="constrained")
    axes.imshow(numbers, cmap="RdBu", norm=LogNorm(1 / MOST, MOST), aspect="auto")
    for y, line in enumerate(numbers):
        for x, ratio in enumerate(line):
            if not math.isnan(ratio):
                dark = max(ratio, 1 / ratio) > MOST / 1.5
                text = f"{ratio:.2f}" if ratio < 10 else f"{ratio:.0f}"
                axes.text(x, y, text, ha="center", va="center", color="white" if dark else "black")
    errors = [row["error"] for row in cells[labels[0]]]
    axes.set_xticks(range(len(errors)), [f"{error:.0e}" for error in errors])
    axes.set_yticks(range(len(labels)), [f"{g}: {case}, {solver}" for g, solver, case in labels])
    axes.set(xlabel="error", title="time of the other solver over ours; red: ours is slower")
    return figure


def main() -> None:
    """Measure and write."""
    table = options_of("pictures").parse_args().output / "peers.tsv"
    if not table.exists():
        raise SystemExit(f"benchmarks: {table} is missing; run peers writes it")
    plt.rcParams["font.size"] = 8
    draw(read_table(table)).savefig(table.with_suffix(".png"), dpi=150, metadata={"Software": None})
