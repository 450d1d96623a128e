"""Figure of work against precision: one panel a scene, one line a solver."""

from drawing import logged, save
from matplotlib import pyplot as plt
from matplotlib.figure import Figure
from tables import read_table

MARKERS = "osD^vx+*p<>"
ENOUGH = 1e-15
"""Errors below this are rounding and not drawn lower."""


def draw(rows: list[dict]) -> Figure:
    """Small multiples, three in a row; solvers keep their colour and marker in all of them."""
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    solvers = list(dict.fromkeys(row["solver"] for row in rows))
    lines = -(-len(scenes) // 3)
    figure, grid = plt.subplots(
        lines, 3, figsize=(6.7, 2.2 * lines + 0.3), squeeze=False, sharex=True, sharey=True
    )
    for axes in grid.flat[len(scenes) :]:
        axes.remove()
    for axes, scene in zip(grid.flat, scenes, strict=False):
        for index, solver in enumerate(solvers):
            shown = [
                row
                for row in rows
                if (row["scene"], row["solver"]) == (scene, solver)
                and row["error_max"] >= 0
                and row["seconds"] > 0
            ]
            axes.plot(
                [row["seconds"] for row in shown],
                [max(row["error_max"], ENOUGH) for row in shown],
                marker=MARKERS[index % len(MARKERS)],
                ms=2.8,
                color=f"C{index % 8}",
                label=solver.replace("_", " "),
            )
        until = next(row["t_end"] for row in rows if row["scene"] == scene)
        axes.set_title(f"{scene.replace('_', ' ')}, $t$ up to {until:g}")
        axes.set(xscale="log", yscale="log")
    for axes in grid[:, 0]:
        axes.set_ylabel("largest error")
    for axes in grid[-1]:
        axes.set_xlabel("CPU seconds")
    handles = {}
    for axes in grid.flat[: len(scenes)]:
        handles |= {line.get_label(): line for line in axes.get_lines()}
    figure.legend(handles.values(), handles, loc="outside lower center", ncols=7)
    return figure


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        tables = [snakemake.input.table, *snakemake.input.others]
        rows = [row for table in tables for row in read_table(table)]
        save(draw(rows), snakemake.output.pdf, snakemake.output.png)
