"""Figure of slip events: their recurrence times in turn, the distribution of these, and slips."""

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing import parameters
from scripts.drawing.style import logged, save
from scripts.files.inputs import read

EVENTS_SHOWN = 120
"""Events whose successive recurrence times are shown."""
BINS = 30


def draw(rows: dict[str, xr.Dataset]) -> Figure:
    """Rows a, b, ...: recurrence times over the number of the event, their distribution, slips."""
    figure, grid = plt.subplots(
        len(rows), 3, figsize=(6.7, 0.4 + 1.9 * len(rows)), width_ratios=[1.5, 1, 1], squeeze=False
    )
    slips = np.concatenate([events.slip.values for events in rows.values()])
    ends = (0.5 * slips.min(initial=1.0), 2 * slips.max(initial=1.0))
    for (label, events), panels in zip(rows.items(), grid, strict=True):
        scene = events.attrs["scene"].replace("_", " ")
        title = (
            f"scene {scene} ({parameters.in_words(events.attrs)}): {events.sizes['event']} events"
        )
        panels[0].set_title(f"$\\bf{{{label}}}$  {title}")
        if events.sizes["event"] > 0:
            draw_turns(panels[0], events)
            draw_distribution(panels[1], events.recurrence_time.values)
            draw_sizes(panels[2], np.sort(events.slip.values), ends)
    for axes, words in zip(
        grid.T,
        (
            ("number of the event", "recurrence\ntime"),
            ("recurrence time", "share of events"),
            ("slip $s$", "share of events\nwith slip $\\geq s$"),
        ),
        strict=True,
    ):
        for panel in axes:
            panel.set_ylabel(words[1])
        axes[-1].set_xlabel(words[0])
    return figure


def draw_turns(axes: Axes, events: xr.Dataset) -> None:
    """The recurrence times of the first events."""
    shown = events.recurrence_time.values[:EVENTS_SHOWN]
    axes.plot(1 + np.arange(shown.size), shown, ls="", marker="o", ms=2, mew=0)
    axes.set_ylim(0, 1.15 * shown.max())


def draw_distribution(axes: Axes, times: np.ndarray) -> None:
    """Shares of the recurrence times in equal bins from zero on."""
    axes.hist(
        times, bins=np.linspace(0, 1.15 * times.max(), BINS), weights=1 / times.size + 0 * times
    )
    axes.set_ylim(0, None)


def draw_sizes(axes: Axes, slip: np.ndarray, ends: tuple[float, float]) -> None:
    """The share of events with at least a slip, both logarithmic, so that a power is a line."""
    share = 1 - np.arange(slip.size) / slip.size
    axes.loglog([ends[0], *slip], [1.0, *share], drawstyle="steps-pre")
    axes.set(xlim=ends, ylim=(3e-4, 2))


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        shown = snakemake.params.settings["rows"]
        files = [read(path) for path in snakemake.input.slip_events]
        save(draw(dict(zip(shown, files, strict=True))), snakemake.output)
