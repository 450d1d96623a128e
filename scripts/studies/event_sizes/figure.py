"""The drawing of event sizes, and the numbers of its caption."""

import math

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing.style import INK
from scripts.drawing.wording import place_in_words, short, with_error
from scripts.models.models import PARAMETERS
from scripts.studies.event_sizes.laws import (
    CONFIDENCE,
    EXPONENT_RANGE,
    EXPONENTS,
    FEWEST,
    LARGEST,
    WINDOW,
    times_after_main_shocks,
)
from scripts.studies.event_sizes.names_of_laws import (
    PLAUSIBLE,
    cut_off_in_words,
    decades_of,
    definition_of,
    exponent_in_words,
    is_usual,
)

MARKS = ["o", "s", "^", "D", "v", "P"]
LIGHTEST = 0.65
"""Grey of the last threshold."""
BINS = np.geomspace(0.3, WINDOW, 10)
"""Times after a main shock between which events are counted."""


def laws_of(laws: list[dict], names: list[str]) -> list[dict]:
    """Rows of the usual events of the chains of these names, in their order."""
    return [next(row for row in laws if row["chain"] == n and is_usual(row)) for n in names]


def draw(
    events: list[list[dict]], slips: list[xr.Dataset], laws: list[dict], names: list[str]
) -> Figure:
    """Distributions of sizes, also by other definitions; cut-offs; rates after events."""
    figure, ((sizes, others), (cutoffs, rates)) = plt.subplots(2, 2, figsize=(6.7, 6.0))
    usual = laws_of(laws, names)
    for number, (chain, row) in enumerate(zip(events, usual, strict=True)):
        colour, mark = f"C{number}", MARKS[number % len(MARKS)]
        of_row = [event for event in chain if event["threshold"] == row["threshold"]]
        found = [event["size"] for event in of_row]
        words = f"{row['chain'].replace('_', ' ')}: {row['blocks']:g} blocks"
        draw_sizes(sizes, found, color=colour, label=words)
        draw_law(sizes, found, row, colour)
        draw_rates(rates, of_row, row, color=colour, fmt=mark)
    longest = max(range(len(names)), key=lambda i: usual[i]["blocks"])
    shown = [row for row in laws if row["chain"] in names]
    styles = styles_of(shown)
    for row in shown:
        if row["chain"] == names[longest]:
            name, chain = definition_of(row), slips[longest]
            if row["joined"] == "yes":
                there = (e for e in events[longest] if e["threshold"] == row["threshold"])
                found = [event["size"] for event in there]
            else:
                kept = chain.onset >= chain.attrs["t_end"] - row["time"]
                found = chain.slip.values[(chain.threshold == row["threshold"]) & kept]
            draw_sizes(others, found, label=name.replace("slips ", ""), **styles[name])
    draw_cut_offs(cutoffs, shown, styles)
    for axes, letter in zip((sizes, others, cutoffs, rates), "abcd", strict=True):
        of = "  " + names[longest].replace("_", " ") if axes is others else ""
        axes.set_title(f"$\\bf{{{letter}}}${of}")
    for axes in (sizes, others):
        axes.set(xlabel="size (units of $L$)", ylabel="share of events at least as large")
    cutoffs.set(xlabel="blocks", ylabel="cut-off (units of $L$)")
    rates.axhline(1, color=INK, lw=0.5)
    rates.set(
        xlabel="time after a large event ($L/v_0$)",
        ylabel="rate of events over its mean",
        ylim=(0, None),
    )
    for axes, place, title in ((sizes, "lower", "a, d"), (others, "upper", "b, c: slips")):
        handles, labels = axes.get_legend_handles_labels()
        look = {"ncols": 3, "fontsize": 7, "title": title, "title_fontsize": 7}
        figure.legend(handles, labels, loc=f"outside {place} center", **look)
    return figure


def draw_sizes(axes: Axes, sizes, **style) -> None:
    """The share of events at least as large."""
    size = np.sort(sizes)
    share = 1 - np.arange(size.size) / size.size
    axes.loglog(size, share, lw=1, drawstyle="steps-pre", **style)


def draw_law(axes: Axes, sizes: list[float], row: dict, colour: str) -> None:
    """Above the lower cut-off the fitted power law."""
    if math.isnan(row["size_exponent"]):
        return
    ends = np.array([row["size_least"], row["largest"]])
    above = np.mean(np.array(sizes) >= row["size_least"])
    line = above * (ends / ends[0]) ** (1 - row["size_exponent"])
    axes.loglog(ends, line, color=colour, lw=0.8, ls="--")


def styles_of(laws: list[dict]) -> dict[str, dict]:
    """A grey for each threshold, as colours are chains, and a kind of line, by definition."""
    thresholds = list(dict.fromkeys(row["threshold"] for row in laws))
    greys = dict(zip(thresholds, np.linspace(0, LIGHTEST, len(thresholds)), strict=True))
    return {
        definition_of(row): {
            "color": f"{greys[row['threshold']]:.2f}",
            "ls": "-" if row["joined"] == "yes" else ":",
        }
        for row in laws
    }


def draw_cut_offs(axes: Axes, laws: list[dict], styles: dict[str, dict]) -> None:
    """Cut-offs up to the largest event, with intervals, over the blocks; a mark for each gamma."""
    marks = dict(zip(dict.fromkeys(row["gamma"] for row in laws), MARKS, strict=False))
    fitted = [row for row in laws if 0.0 < row["size_cutoff"] <= row["largest"]]
    for name, style in styles.items():
        for gamma, mark in marks.items():
            rows = [r for r in fitted if definition_of(r) == name and r["gamma"] == gamma]
            if not rows:
                continue
            blocks, middle, low, high = (
                np.array([row[key] for row in rows])
                for key in ("blocks", "size_cutoff", "size_cutoff_low", "size_cutoff_high")
            )
            bars = [middle - low, np.where(np.isinf(high), 0.0, high - middle)]
            axes.errorbar(blocks, middle, yerr=bars, marker=mark, ms=3, lw=0.7, **style)
    axes.set(xscale="log", yscale="log")
    blocks = sorted({row["blocks"] for row in laws})
    axes.set_xticks(blocks, [f"{number:g}" for number in blocks])
    axes.minorticks_off()


def draw_rates(axes: Axes, events: list[dict], row: dict, **style: str) -> None:
    """Rates of events after the largest ones over the mean rate, with three standard errors."""
    shocks, after = times_after_main_shocks(events)
    if shocks == 0:
        return
    counts, _ = np.histogram(after, BINS)
    expected = shocks * len(events) / row["time"] * np.diff(BINS)
    bars = 3 * np.sqrt(counts) / expected
    middles = np.sqrt(BINS[1:] * BINS[:-1])
    axes.errorbar(middles, counts / expected, yerr=bars, ms=3, lw=0.6, **style)
    axes.set_xscale("log")


def numbers(
    events: list[list[dict]], slips: list[xr.Dataset], laws: list[dict], names: list[str]
) -> dict:
    """What the events of each chain are, and the laws that they follow."""
    usual = laws_of(laws, names)
    shuffled = [row["shuffled_cutoff"] for row in usual]
    cut_offs = {(row["chain"], definition_of(row)): cut_off_in_words(row) for row in laws}
    definitions = dict.fromkeys(definition for _, definition in cut_offs)
    fitted = [row for row in laws if row["chain"] in names and not math.isnan(row["size_cutoff"])]
    exponents = [row["size_cutoff_exponent"] for row in fitted]
    others = [decades_of(row) for row in fitted if not is_usual(row)]
    spans = [decades_of(row) for row in fitted if is_usual(row)]
    return {
        "chains": [numbers_of(row) for row in usual],
        "cells": [
            ["cut-off", *(name.replace("_", " ") for name in names)],
            *([one, *(cut_offs[name, one] for name in names)] for one in definitions),
            [
                "slips shuffled",
                *("too few events" if math.isnan(one) else f"{one:.2g}" for one in shuffled),
            ],
        ],
        "confidence": short(100 * CONFIDENCE),
        "largest": short(100 * LARGEST),
        "fewest": FEWEST,
        "usual": definition_of(usual[0]),
        "spanned": short(max(spans, default=0.0), 2),
        "plausible": sum(row["size_cutoff_goodness"] >= PLAUSIBLE for row in usual),
        "widest": short(max(others, default=0.0), 1),
        "fitted": len(exponents),
        "steepest": short(EXPONENT_RANGE[1]),
        "ends": sum(map(math.isnan, exponents)),
        "decays": [short(end) for end in EXPONENTS],
        "at_end": sum(
            math.isnan(row["aftershock_exponent"]) and row["aftershock_main_shocks"] > 0
            for row in usual
        ),
    }


def numbers_of(row: dict) -> dict:
    """Numbers of one chain in words."""
    place = place_in_words({key: row[key] for key in (*PARAMETERS, "law")})
    cells = [
        *(row["chain"].replace("_", " "), f"{row['blocks']:g}", short(row["gamma"])),
        f"{row['events']:g}",
        *("", "too few", "", "", "", ""),
    ]
    if not math.isnan(row["size_exponent"]):
        cells[4:9] = [
            short(row["size_least"]),
            with_error(row["size_exponent"], row["size_error"]),
            short(row["size_goodness"], 2),
            exponent_in_words(row["size_cutoff_exponent"], 2),
            short(row["size_cutoff_goodness"], 2),
        ]
    if not math.isnan(row["aftershock_main_shocks"]):
        cells[9] = with_error(row["aftershock_first"], row["aftershock_first_error"])
    return {"cells": cells, "place": place}
