"""The drawing of plans/cycles.py, and the numbers of its caption."""

from string import ascii_lowercase

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing import parameters
from scripts.drawing.along_parameter import mark_scenes, maxima_of
from scripts.drawing.special_points import STYLES, in_words, words_of
from scripts.drawing.style import FAINT, INK, PAGE, columns_of
from scripts.drawing.wording import count, counted_at, place_in_words, short, words_of_state
from scripts.models.records import is_of_block
from scripts.studies.cycles.branches import most_of, parts_of

HEIGHT = 1.7
"""Of a line, in inches."""
LINES = (
    {"color": INK, "lw": 2.4, "label": "stable cycle"},
    {"color": "C1", "lw": 0.8, "label": "1 unstable multiplier"},
    {"color": "C0", "lw": 0.8, "label": "2 unstable multipliers"},
    {"color": "C2", "lw": 0.8, "label": "3 or more unstable multipliers"},
)
"""How cycles are drawn, by the number of their unstable multipliers."""
HOPF = {"ls": "", "marker": "o", "ms": 3, "mfc": "white", "color": INK, "label": "Hopf point"}
SWEEPS = {
    "up": {"color": "#cc79a7", "ms": 4.2, "zorder": 2, "label": "sweep up"},
    "down": {"color": "#56b4e9", "ms": 2.6, "zorder": 2.5, "label": "sweep down"},
}
"""Dots of a sweep, lighter than the lines over them. Those of the second are smaller and
on top: both show where they agree."""
SMALL = 0.015
"""Share of the panel's width below which a branch is smaller than the marks of its points."""
CUT = 1.5
"""Dots above this many times the greatest v of all branches are cut."""
SLIDING = {"color": FAINT, "lw": 0.8, "label": "steady sliding", "zorder": 0}


def draw(
    cycles: list[xr.Dataset],
    sweeps: list[xr.Dataset],
    directions: list[list[str]],
    scenes: dict[str, dict],
) -> Figure:
    """One line below the other; `directions` of the sweeps by line, in the order of `sweeps`."""
    columns = columns_of(len(cycles), HEIGHT)
    lines = -(-len(cycles) // columns)
    height = min(PAGE[1], HEIGHT * lines + 0.7)
    figure, panels = plt.subplots(lines, columns, figsize=(PAGE[0], height), squeeze=False)
    for axes in panels.flat[len(cycles) :]:
        axes.remove()
    drawn: dict[str, Artist] = {}
    following = iter(sweeps)
    for i, (axes, line, on_line) in enumerate(zip(panels.flat, cycles, directions, strict=False)):
        along = line.attrs["along"]
        if is_of_block(line.attrs):
            axes.axhline(1, **SLIDING)
        for direction in on_line:
            style = {"ls": "", "marker": ".", "mew": 0, "rasterized": True, **SWEEPS[direction]}
            axes.plot(*maxima_of(next(following), along), **style)
        # dots of sweeps lie over the stable parts and below the others
        for unstable, x, y in parts_of(line, steps=8):
            axes.plot(x, y, **LINES[min(unstable, 3)], zorder=3 if unstable else 1)
        draw_points(axes, line, along)
        drawn |= {str(artist.get_label()): artist for artist in axes.lines}
        abscissa = parameters.axis_of(along, line[along].attrs.get("long_name", ""), line.attrs)
        unit = "\n(units of $v_0$)" * is_of_block(line.attrs)
        axes.set(xlabel=abscissa, ylabel=f"maxima of ${line.attrs['signal']}${unit}")
        # the names of scenes stand above the dots
        axes.margins(x=0.01, y=0.18)
        axes.set_ylim(top=min(axes.get_ylim()[1], CUT * max(line[most_of(line)], default=np.inf)))
        if is_of_block(line.attrs):
            axes.set_ylim(bottom=0)
        mark_scenes(axes, scenes, line.attrs, along)
        between = ": " if columns == 1 else "\n"
        words = f"{parameters.in_words(line.attrs, along)}{between}{count_in_words(line)}"
        axes.set_title(f"$\\bf{{{'abcdefgh'[i % 8]}}}$  {words}")
    names = [style["label"] for style in (*LINES, *SWEEPS.values(), SLIDING, HOPF)]
    handles = [drawn[name] for name in (*names, *map(in_words, STYLES)) if name in drawn]
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    return figure


def count_in_words(cycles: xr.Dataset) -> str:
    """How many branches and special points there are."""
    branches, points = cycles.sizes["branches"], cycles.sizes["special"]
    return (
        f"{branches} {'branch' if branches == 1 else 'branches'},"
        f" {points} special point{'s' * (points != 1)}"
    )


def draw_points(axes: Axes, cycles: xr.Dataset, along: str) -> None:
    """Special points by their kind, and Hopf points, where a cycle starts from steady sliding.

    Marks would hide a branch that is smaller, so that its points would stand alone.
    """
    kinds = np.array(words_of(cycles.special_kind))
    x, branch = cycles[along].values, cycles.branch.values
    sizes = [np.ptp(x[branch == number]) for number in cycles.special_branch.values]
    large = np.array(sizes) > SMALL * np.ptp(axes.get_xlim())
    for kind, (marker, colour) in STYLES.items():
        these = cycles.isel(special=(kinds == kind) & large)
        if these.sizes["special"]:
            axes.plot(
                these[f"special_{along}"],
                these[f"special_{most_of(cycles)}"],
                ls="",
                marker=marker,
                ms=3.6,
                mfc="white",
                mec=colour,
                mew=0.9,
                label=in_words(kind),
                zorder=5,
            )
    # of the block they lie at v = 1
    if cycles.sizes["hopf"] and is_of_block(cycles.attrs):
        places = cycles[f"hopf_{along}"]
        axes.plot(places, np.ones(places.size), clip_on=False, zorder=4, **HOPF)


def numbers(cycles: list[xr.Dataset]) -> dict:
    """Branches, special points and Hopf points of each line, and where stable cycles are."""
    lines = []
    for letter, line in zip(ascii_lowercase, cycles, strict=False):
        along = line.attrs["along"]
        kinds = words_of(line.special_kind)
        points = sorted(zip(line[f"special_{along}"].values.tolist(), kinds, strict=True))
        at = {
            in_words(kind): [short(x, 4) for x, its_kind in points if its_kind == kind]
            for kind in dict.fromkeys(kinds)
        }
        lines.append(
            {
                "letter": letter,
                "symbol": parameters.symbol_of(along),
                "place": place_in_words(line.attrs, along),
                "branches": line.sizes["branches"],
                "points": [count(len(places), name) for name, places in at.items()],
                "points_at": [counted_at(name, places) for name, places in at.items()],
                "signal": line.attrs["signal"],
                "state": words_of_state(line.attrs),
                "hopf": [short(x, 4) for x in np.sort(line[f"hopf_{along}"].values)],
                "stable": stable_stretches(line),
            }
        )
    return {"lines": lines, "signal": cycles[0].attrs["signal"]}


def stable_stretches(cycles: xr.Dataset) -> list[str]:
    """Intervals of the parameter with stable cycles, branch by branch."""
    parts = parts_of(cycles)
    found = {(float(x.min()), float(x.max())) for unstable, x, _ in parts if unstable == 0}
    words = [(short(first), short(last)) for first, last in sorted(found)]
    return [first if first == last else f"{first} to {last}" for first, last in words]
