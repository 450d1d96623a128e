"""The drawing of plans/events.py, and the numbers of its caption."""

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from scripts.drawing import parameters
from scripts.drawing.wording import short

EVENTS_SHOWN = 120
"""Events at the start whose recurrence times are shown in turn; the other panels show all."""
BINS = 30
TIME = "time (units of $L/v_0$)"


def draw(slip_events: list[xr.Dataset], labels: list[str]) -> Figure:
    """Rows a, b, ...: recurrence times over the number of the event, their distribution, slips."""
    figure, grid = plt.subplots(
        len(labels),
        3,
        figsize=(6.7, 0.4 + 1.9 * len(labels)),
        width_ratios=[1.5, 1, 1],
        squeeze=False,
    )
    slips = np.concatenate([events.slip.values for events in slip_events])
    ends = (0.5 * slips.min(initial=1.0), 2 * slips.max(initial=1.0))
    for label, events, panels in zip(labels, slip_events, grid, strict=True):
        scene = events.attrs["scene"].replace("_", " ")
        title = (
            f"scene {scene} ({parameters.in_words(events.attrs)}): {events.sizes['event']} events"
        )
        panels[0].set_title(f"$\\bf{{{label}}}$  {title}")
        if events.sizes["event"] > 0:
            draw_recurrence(*panels[:2], events.recurrence_time.values)
            draw_sizes(panels[2], np.sort(events.slip.values), ends)
    words = (
        (f"number of the event, up to {EVENTS_SHOWN}", f"recurrence\n{TIME}"),
        (f"recurrence {TIME}", "share of events"),
        ("slip $s$ (units of $L$)", "share of events\nwith slip $\\geq s$"),
    )
    for column, (abscissa, ordinate) in zip(grid.T, words, strict=True):
        plt.setp(column, ylabel=ordinate)
        column[-1].set_xlabel(abscissa)
    return figure


def draw_recurrence(first: Axes, shares: Axes, times: np.ndarray) -> None:
    """The recurrence times of the first events, and shares of all in equal bins from zero on."""
    shown = times[:EVENTS_SHOWN]
    first.plot(1 + np.arange(shown.size), shown, ls="", marker="o", ms=2, mew=0)
    first.set_ylim(0, 1.15 * shown.max())
    first.xaxis.set_major_locator(MaxNLocator(5, integer=True))
    bins = np.linspace(0, 1.15 * times.max(), BINS)
    shares.hist(times, bins=bins, weights=1 / times.size + 0 * times)
    shares.set_ylim(0, None)


def draw_sizes(axes: Axes, slip: np.ndarray, ends: tuple[float, float]) -> None:
    """The share of events with at least a slip, both logarithmic, so that a power is a line."""
    share = 1 - np.arange(slip.size) / slip.size
    axes.loglog([ends[0], *slip], [1.0, *share], drawstyle="steps-pre")
    axes.set(xlim=ends, ylim=(3e-4, 2))


def numbers(slip_events: list[xr.Dataset], labels: list[str]) -> dict:
    """Counts of events, their recurrence times and how much these differ."""
    rows = {}
    for label, events in zip(labels, slip_events, strict=True):
        times = events.recurrence_time
        rows[label] = {
            "scene": events.attrs["scene"].replace("_", " "),
            "number": events.sizes["event"],
            "mean": short(times.mean()) if times.size else "none",
            "spread": spread_in_words(times) if times.size else "none",
        }
    return {"rows": rows, "shown": EVENTS_SHOWN}


def spread_in_words(times: xr.DataArray) -> str:
    """The coefficient of variation in percent, if it differs from zero."""
    percent = 100 * float(times.std() / times.mean())
    return f"{short(percent, 2)} %" if percent >= 0.01 else "less than 0.01 %"
