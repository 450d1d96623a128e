"""The drawing of plans/work_precision.py, and the numbers of its caption."""

from collections import Counter
from textwrap import fill

from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from scripts.drawing.wording import count, short
from scripts.files.tsv import rows_by

MARKERS = "osD^vx+ph<>"
LINE = 30
"""Letters of a title above a panel."""
ENOUGH = 1e-15
"""Errors below this are rounding and not drawn lower."""
GREYS = ("0.0", "0.4", "0.65")
"""Colours of other solvers."""
NAMES = {"jitcdde": "JiTCDDE", "desolve": "deSolve", "desolve_interpol_2": "deSolve (interpol 2)"}
"""Of other solvers, as their authors write them."""
AUTO_AGAIN = "ours"
"""Name of method auto in the table of other solvers."""
LEVEL = 1e-6
"""Of the error at which run times are compared."""


def styles_of(solvers: list[str], others: list[str]) -> dict[str, dict]:
    """Line and marker of each solver: fixed steps dotted, other solvers grey, dashed, hollow."""
    styles = {
        name: {"color": f"C{i % 8}", "ls": ":" if name.startswith("rk4") else "-"}
        for i, name in enumerate(solvers)
    }
    for i, name in enumerate(others):
        styles[name] = {"color": GREYS[i % len(GREYS)], "ls": "--", "mfc": "white"}
    for i, style in enumerate(styles.values()):
        style["marker"] = MARKERS[i % len(MARKERS)]
    return styles


def draw(table: list[dict], others: list[dict], date: str) -> Figure:
    """Small multiples, three in a row; solvers look the same in all of them.

    Others were measured on a date, and count where their runs are as long.
    """
    until = {row["scene"]: row["t_end"] for row in table}
    others = [
        {**row, "solver": f"{NAMES.get(row['solver'], row['solver'])} {row['version']}"}
        for row in others
        if row["solver"] != AUTO_AGAIN and until.get(row["scene"]) == row["t_end"]
    ]
    scenes = list(until)
    names = [list(dict.fromkeys(row["solver"] for row in rows)) for rows in (table, others)]
    styles = styles_of(*names)
    lines = -(-len(scenes) // 3)
    figure, grid = plt.subplots(
        lines, 3, figsize=(6.7, 2.2 * lines + 0.3), squeeze=False, sharex=True, sharey=True
    )
    for axes in grid.flat[len(scenes) :]:
        axes.remove()
    drawn = [row for row in (*table, *others) if row["error_max"] >= 0 and row["seconds"] > 0]
    runs = rows_by(drawn, "scene", "solver")
    for i, (axes, scene) in enumerate(zip(grid.flat, scenes, strict=False)):
        for solver, style in styles.items():
            shown = runs.get((scene, solver), [])
            axes.plot(
                [row["seconds"] for row in shown],
                [max(row["error_max"], ENOUGH) for row in shown],
                ms=2.8,
                **style,
                label=solver.replace("_", " "),
            )
        words = fill(f"{scene.replace('_', ' ')}, $t$ up to {until[scene]:g}", LINE)
        axes.set_title(f"$\\bf{{{'abcdefgh'[i % 8]}}}$  {words}" if len(scenes) > 1 else words)
        axes.set(xscale="log", yscale="log")
    for axes in grid[:, 0]:
        axes.set_ylabel("largest error")
    for axes in grid[-1]:
        axes.set_xlabel("CPU seconds")
    handles = grid[0, 0].get_lines()
    columns = len(handles) if len(handles) <= 6 else -(-len(handles) // 2)
    figure.legend(
        handles=handles,
        loc="outside lower center",
        ncols=columns,
        title=f"dashed: other solvers, measured on {date}" if others else None,
        title_fontsize=7,
    )
    return figure


def numbers(table: list[dict], others: list[dict], date: str) -> dict:
    """The fastest solver of each scene at one level of the error, and how much others need."""
    others = [row for row in others if row["solver"] != AUTO_AGAIN]
    fastest, ratios = Counter(), []
    for scene, until in {row["scene"]: row["t_end"] for row in table}.items():
        ours, theirs = (
            [
                (row["seconds"], row["solver"])
                for row in rows
                if (row["scene"], row["t_end"]) == (scene, until)
                and row["error_max"] <= LEVEL
                and row["seconds"] > 0
            ]
            for rows in (table, others)
        )
        if ours:
            fastest[min(ours)[1]] += 1
        if ours and theirs:
            ratios.append(min(theirs)[0] / min(ours)[0])
    # methods with fixed steps have these in the place of a tolerance
    tolerances = [row["tolerance"] for row in table if not row["solver"].startswith("rk4")]
    return {
        "loosest": short(max(tolerances)),
        "tightest": short(min(tolerances)),
        "level": short(LEVEL),
        "fastest": [
            f"{solver} (in {count(number, 'scene')})" for solver, number in fastest.most_common()
        ],
        "ratios": [short(f(ratios), 2) for f in (min, max)] if ratios else [],
        "date": date,
    }
