"""The drawing of velocity and phase portrait (Figures 4 and 5), and the numbers of its caption."""

import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from scripts.drawing import parameters
from scripts.drawing.trajectories import draw_portrait, draw_signal, end_in_words, title_columns
from scripts.tables.motion_rows import class_in_words, own_rows

COLUMNS = ("from the start", "at the end", "phase portrait")


def draw(trajectories: list[xr.Dataset], table: list[dict], settings: dict) -> Figure:
    """Rows a, b, ...: v(t) with its transient, v(t) on the attractor, and the plane (u, v)."""
    figure, grid = plt.subplots(
        len(trajectories),
        3,
        figsize=(6.7, 2.2 * len(trajectories)),
        width_ratios=[1.5, 1, 1],
        squeeze=False,
    )
    titles = titles_of(settings["rows"], table)
    for (label, row), trajectory, panels in zip(
        settings["rows"].items(), trajectories, grid, strict=True
    ):
        left, middle, right = panels
        last = float(trajectory.t[-1])
        envelope = draw_signal(left, trajectory, 0.0, min(row["time_shown"], last))
        draw_signal(middle, trajectory, max(0.0, last - settings["end_shown"]), last)
        draw_portrait(right, trajectory, settings["attractor_shown"])
        middle.sharey(left)
        middle.set(ylabel="")
        words = f"{parameters.in_words(trajectory.attrs)}: {titles[label]}"
        columns = (COLUMNS[0] + " (envelope)" * envelope, *COLUMNS[1:])
        title_columns(panels, columns, f"$\\bf{{{label}}}$  {words}")
    figure.legend(*right.get_legend_handles_labels(), loc="outside lower right", ncols=3)
    return figure


def titles_of(rows: dict[str, dict], table: list[dict]) -> dict[str, str]:
    """For each row the paper's words and the class of its motion, where attractors are known."""
    known = own_rows(table)
    titles = {label: f"the paper: “{row['paper']}”" for label, row in rows.items()}
    for label, row in rows.items():
        if row["scene"] in known:
            titles[label] += f"; here: {class_in_words(known[row['scene']])}"
    return titles


def numbers(trajectories: list[xr.Dataset], table: list[dict], settings: dict) -> dict:
    """What v does at the end, and the class of the motion."""
    known = own_rows(table)
    rows = {}
    for (label, row), trajectory in zip(settings["rows"].items(), trajectories, strict=True):
        start = float(trajectory.t[-1]) - settings["end_shown"]
        v = trajectory.v.sel(t=slice(max(0.0, start), None))
        motion = known.get(row["scene"], {"class": "unknown"})
        rows[label] = {"motion": class_in_words(motion), "end": end_in_words(v, motion)}
    return {"rows": rows}
