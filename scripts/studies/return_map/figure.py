"""Return maps of slip events, a row a scene, and the numbers of their caption."""

import math

import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from scripts.drawing.parameters import in_words as place_in_words
from scripts.drawing.parameters import true_minus
from scripts.studies.return_map.table import maps_of

TIME = "(units of $L/v_0$)"
SLIP = "slip (units of $L$)"
PANELS = {
    "slip_by_waiting": (f"waiting time before\n{TIME}", SLIP),
    "waiting_by_slip": (SLIP, f"waiting time after\n{TIME}"),
    "recurrence_by_recurrence": (f"recurrence time\n{TIME}", f"next recurrence\ntime {TIME}"),
}
"""The maps that are drawn, with the words of their axes."""


def draw(slip_events: list[xr.Dataset], table: list[dict], labels: list[str]) -> Figure:
    """Slip over the waiting time, the waiting time over slip, successive recurrence times."""
    rows = len(slip_events)
    figure, grid = plt.subplots(rows, len(PANELS), figsize=(6.7, 0.4 + 1.75 * rows), squeeze=False)
    found = {(row["scene"], row["map"]): row for row in table}
    for label, events, panels in zip(labels, slip_events, grid, strict=True):
        scene, maps = events.attrs["scene"], maps_of(events)
        place = place_in_words(events.attrs)
        title = f"scene {scene.replace('_', ' ')} ({place}): {events.sizes['event']} events"
        panels[1].set_title(f"$\\bf{{{label}}}$  {title}", loc="center")
        for (name, (x_words, y_words)), axes in zip(PANELS.items(), panels, strict=True):
            axes.plot(*maps[name], ls="", marker="o", ms=2, mew=0, alpha=0.6)
            above = 1.25 * maps[name][1].max(initial=1e-9)
            axes.set(ylabel=y_words, xlim=(0, None), ylim=(0, above))
            words = in_words(found[scene, name], "$r = {r:.2f}$, $D = {dependence:.2f}$")
            axes.text(0.98, 1, words, transform=axes.transAxes, ha="right", va="top")
            if events is slip_events[-1]:
                axes.set_xlabel(x_words)
        panels[2].axline((0, 0), slope=1, color="0.7", lw=0.6, zorder=0)
    return figure


def in_words(row: dict, form: str) -> str:
    """Measures of a row of the table, if it has them."""
    return "events equal or few" if math.isnan(row["r"]) else true_minus(form.format(**row))


def numbers(slip_events: list[xr.Dataset], table: list[dict]) -> dict:
    """Measures of each scene, and in how many the time determines the slip better."""
    cells, better = [], 0
    for events in slip_events:
        scene = events.attrs["scene"]
        maps = {row["map"]: row for row in table if row["scene"] == scene}
        form = "{r:.2f}; {rank_r:.2f}; {dependence:.2f}"
        measures = [in_words(row, form) for row in maps.values()]
        cells.append([scene.replace("_", " "), str(events.sizes["event"]), *measures])
        slip, time = (maps[name]["dependence"] for name in ("slip_by_waiting", "waiting_by_slip"))
        better += slip > time
    return {"cells": cells, "better": better}
