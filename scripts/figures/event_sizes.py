"""The drawing of plans/event_sizes.py, and the numbers of its caption."""

import math

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing.style import FAINT, INK
from scripts.figures.wording import place_in_words, short, with_error
from scripts.namelists.study_cases import PARAMETERS
from scripts.tables.event_laws import LARGEST, WINDOW, times_after_main_shocks

MARKS = ["o", "s", "^", "D", "v", "P"]
BINS = np.geomspace(0.3, WINDOW, 10)
"""Times after a main shock between which events are counted."""


def laws_of(laws: list[dict], names: list[str]) -> list[dict]:
    """Rows of the chains of these names, in their order."""
    return [next(row for row in laws if row["chain"] == name) for name in names]


def draw(events: list[list[dict]], laws: list[dict], names: list[str]) -> Figure:
    """Distributions of sizes with the power laws, cut-offs over the blocks, rates after events."""
    figure, (sizes, cutoffs, rates) = plt.subplots(
        1, 3, figsize=(6.7, 3.1), width_ratios=[1.4, 0.8, 1.2]
    )
    rows = laws_of(laws, names)
    for number, (chain, row) in enumerate(zip(events, rows, strict=True)):
        colour, mark = f"C{number}", MARKS[number % len(MARKS)]
        draw_sizes(sizes, chain, row, colour)
        draw_rates(rates, chain, row, colour, mark)
        cutoffs.plot(row["blocks"], row["size_cutoff"], mark, color=colour, ms=4)
    for axes, letter in zip((sizes, cutoffs, rates), "abc", strict=True):
        axes.set_title(f"$\\bf{{{letter}}}$")
    sizes.set(xlabel="size (units of $L$)", ylabel="share of events at least as large")
    cutoffs.set(xlabel="blocks", ylabel="cut-off (units of $L$)")
    cutoffs.set(xlim=(0, 1.15 * max(row["blocks"] for row in rows)), ylim=(0, None))
    rates.axhline(1, color=INK, lw=0.5)
    rates.set(
        xlabel="time after a large event ($L/v_0$)",
        ylabel="rate of events over its mean",
        ylim=(0, None),
    )
    figure.legend(loc="outside lower center", ncols=3, fontsize=7)
    return figure


def draw_sizes(axes: Axes, events: list[dict], row: dict, colour: str) -> None:
    """The share of events at least as large, and above the lower cut-off the fitted power law."""
    size = np.sort([event["size"] for event in events])
    share = 1 - np.arange(size.size) / size.size
    words = f"{row['chain'].replace('_', ' ')}: {row['blocks']:g} blocks"
    axes.loglog(size, share, color=colour, lw=1, label=words, drawstyle="steps-pre")
    if math.isnan(row["size_exponent"]):
        return
    ends = np.array([row["size_least"], row["largest"]])
    above = (size >= row["size_least"]).mean()
    line = above * (ends / ends[0]) ** (1 - row["size_exponent"])
    axes.loglog(ends, line, color=colour, lw=0.8, ls="--")


def draw_rates(axes: Axes, events: list[dict], row: dict, colour: str, mark: str) -> None:
    """Rates of events after the largest ones over the mean rate, with three standard errors."""
    onset, duration, size = (
        np.array([event[key] for event in events]) for key in ("onset", "duration", "size")
    )
    shocks, after = times_after_main_shocks(onset, duration, size)
    if shocks == 0:
        return
    counts, _ = np.histogram(after, BINS)
    expected = shocks * len(events) / row["time"] * np.diff(BINS)
    axes.errorbar(
        np.sqrt(BINS[1:] * BINS[:-1]),
        counts / expected,
        yerr=3 * np.sqrt(counts) / expected,
        fmt=mark,
        color=colour,
        ms=3,
        lw=0.6,
        ecolor=FAINT,
    )
    axes.set_xscale("log")


def numbers(events: list[list[dict]], laws: list[dict], names: list[str]) -> dict:
    """What the events of each chain are, and the laws that they follow."""
    return {
        "chains": [numbers_of(row) for row in laws_of(laws, names)],
        "largest": short(100 * LARGEST),
    }


def numbers_of(row: dict) -> dict:
    """Numbers of one chain in words."""
    place = {key: row[key] for key in (*PARAMETERS, "law")}
    fitted = not math.isnan(row["size_exponent"])
    return {
        "name": row["chain"].replace("_", " "),
        "blocks": int(row["blocks"]),
        "kappa": short(row["kappa"]),
        "place": place_in_words(place),
        "events": int(row["events"]),
        "fitted": fitted,
        "exponent": with_error(row["size_exponent"], row["size_error"]),
        "least": short(row["size_least"]),
        "largest": short(row["largest"]),
        "goodness": short(row["size_goodness"], 2),
        "cutoff": short(row["size_cutoff"]),
        "cutoff_exponent": short(row["size_cutoff_exponent"]),
        "shocks": 0
        if math.isnan(row["aftershock_main_shocks"])
        else int(row["aftershock_main_shocks"]),
        "first": with_error(row["aftershock_first"], row["aftershock_first_error"]),
    }
