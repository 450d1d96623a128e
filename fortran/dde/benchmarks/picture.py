# SPDX-License-Identifier: BSD-3-Clause
"""The ratios of `run peers` as a picture, for the README of the solver (run picture)."""

import csv
import math
from pathlib import Path

import matplotlib as mpl
from matplotlib import pyplot as plt
from matplotlib.colors import LogNorm
from measuring import options_of

MOST = 4.0
"""The ratio from which on the colour is the darkest."""


def read_table(path: Path) -> list[dict]:
    """Rows of a table with a header of comments."""
    with path.open(newline="") as file:
        lines = [line for line in file if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter="\t"))


def draw(rows: list[dict], path: Path) -> None:
    """A line for each cell and an error in each column; red where this solver is slower."""
    labels = list(dict.fromkeys((row["given"], row["solver"], row["case"]) for row in rows))
    labels.sort(key=lambda label: (("f", "jacobian", "series").index(label[0]), label[1]))
    errors = list(dict.fromkeys(row["error"] for row in rows))
    numbers = [[math.nan] * len(errors) for _ in labels]
    for row in rows:
        if row["ratio"]:
            at = labels.index((row["given"], row["solver"], row["case"]))
            numbers[at][errors.index(row["error"])] = float(row["ratio"])
    mpl.rcParams.update({"font.size": 8, "svg.hashsalt": "peers"})
    figure, axes = plt.subplots(figsize=(7.2, 0.22 * len(labels) + 1.2), layout="constrained")
    axes.imshow(numbers, cmap="RdBu", norm=LogNorm(1 / MOST, MOST), aspect="auto")
    for y, line in enumerate(numbers):
        for x, ratio in enumerate(line):
            if not math.isnan(ratio):
                dark = max(ratio, 1 / ratio) > MOST / 1.5
                text = f"{ratio:.2f}" if ratio < 10 else f"{ratio:.0f}"
                axes.text(x, y, text, ha="center", va="center", color="white" if dark else "black")
    axes.set_xticks(range(len(errors)), [f"{float(error):.0e}" for error in errors])
    axes.set_yticks(
        range(len(labels)), [f"{given}: {case}, {solver}" for given, solver, case in labels]
    )
    axes.set_xlabel("error")
    axes.set_title("time of the other solver over ours; red: ours is slower")
    figure.savefig(path, dpi=150, metadata={"Software": None})


def main() -> None:
    """Read the table and draw it beside it."""
    options = options_of("run picture").parse_args()
    table = options.output / "peers.tsv"
    if not table.exists():
        raise SystemExit(f"benchmarks: {table} is missing; run peers writes it")
    draw(read_table(table), options.output / "peers.png")


if __name__ == "__main__":
    main()
