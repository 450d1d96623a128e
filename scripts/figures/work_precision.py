"""Figure of work against precision: one panel a scene, one line a solver."""

import re
from pathlib import Path

from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from scripts.drawing.style import logged, save
from scripts.files.tsv import read_table

MARKERS = "osD^vx+ph<>"
ENOUGH = 1e-15
"""Errors below this are rounding and not drawn lower."""
GREYS = ("0.0", "0.4", "0.65")
"""Colours of other solvers."""
NAMES = {"jitcdde": "JiTCDDE", "desolve": "deSolve", "desolve_interpol_2": "deSolve (interpol 2)"}
"""Of other solvers, as their authors write them."""
AUTO_AGAIN = "ours"
"""Name of method auto in the table of other solvers."""


def styles_of(solvers: list[str], others: list[str]) -> dict[str, dict]:
    """Line and marker of each solver: other solvers are grey, dashed and hollow."""
    styles = {name: {"color": f"C{i % 8}", "ls": "-"} for i, name in enumerate(solvers)}
    for i, name in enumerate(others):
        styles[name] = {"color": GREYS[i % len(GREYS)], "ls": "--", "mfc": "white"}
    for i, style in enumerate(styles.values()):
        style["marker"] = MARKERS[i % len(MARKERS)]
    return styles


def draw(rows: list[dict], others: list[dict], date: str) -> Figure:
    """Small multiples, three in a row; solvers look the same in all of them.

    Others were measured on a date, and count where their runs are as long.
    """
    until = {row["scene"]: row["t_end"] for row in rows}
    others = [
        {**row, "solver": f"{NAMES.get(row['solver'], row['solver'])} {row['version']}"}
        for row in others
        if row["solver"] != AUTO_AGAIN and until.get(row["scene"]) == row["t_end"]
    ]
    scenes = list(until)
    names = [list(dict.fromkeys(row["solver"] for row in table)) for table in (rows, others)]
    styles = styles_of(*names)
    lines = -(-len(scenes) // 3)
    figure, grid = plt.subplots(
        lines, 3, figsize=(6.7, 2.2 * lines + 0.3), squeeze=False, sharex=True, sharey=True
    )
    for axes in grid.flat[len(scenes) :]:
        axes.remove()
    for axes, scene in zip(grid.flat, scenes, strict=False):
        for solver, style in styles.items():
            shown = [
                row
                for row in [*rows, *others]
                if (row["scene"], row["solver"]) == (scene, solver)
                and row["error_max"] >= 0
                and row["seconds"] > 0
            ]
            axes.plot(
                [row["seconds"] for row in shown],
                [max(row["error_max"], ENOUGH) for row in shown],
                ms=2.8,
                **style,
                label=solver.replace("_", " "),
            )
        axes.set_title(f"{scene.replace('_', ' ')}, $t$ up to {until[scene]:g}")
        axes.set(xscale="log", yscale="log")
    for axes in grid[:, 0]:
        axes.set_ylabel("largest error")
    for axes in grid[-1]:
        axes.set_xlabel("CPU seconds")
    handles = {}
    for axes in grid.flat[: len(scenes)]:
        handles |= {line.get_label(): line for line in axes.get_lines()}
    columns = len(handles) if len(handles) <= 6 else -(-len(handles) // 2)
    figure.legend(
        handles.values(),
        handles,
        loc="outside lower center",
        ncols=columns,
        title=f"dashed: other solvers, measured on {date}" if others else None,
        title_fontsize=7,
    )
    return figure


def date_of(table: str | Path) -> str:
    """The date in the first lines of a table of measurements."""
    return re.search(r"^# date: (\S+)$", Path(table).read_text(), re.MULTILINE)[1]


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        measured = snakemake.input.others
        rows = read_table(snakemake.input.table)
        save(draw(rows, read_table(measured), date_of(measured)), snakemake.output)
