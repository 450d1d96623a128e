"""Figure of the cycles followed: their greatest v along a parameter, stable or not."""

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing import parameters
from scripts.drawing.along_parameter import mark_scenes, maxima_of
from scripts.drawing.special_points import STYLES, in_words, words_of
from scripts.drawing.style import FAINT, INK, logged, save
from scripts.files.inputs import read
from scripts.tables.cycle_branches import branch_of

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
    "up": {"color": "#cc79a7", "ms": 4.2, "zorder": 2},
    "down": {"color": "#56b4e9", "ms": 2.6, "zorder": 2.5},
}
"""Dots of a sweep, lighter than the lines over them. Those of the second are smaller and
on top: both show where they agree."""
SMALL = 0.015
"""Share of the panel's width below which a branch is smaller than the marks of its points."""
SLIDING = {"color": FAINT, "lw": 0.8, "label": "steady sliding", "zorder": 0}
Sweeps = dict[str, list[tuple[str, xr.Dataset]]]


def draw(lines: dict[str, xr.Dataset], sweeps: Sweeps, scenes: dict[str, dict]) -> Figure:
    """One line below the other; `sweeps` are the files by line, with their directions."""
    figure, panels = plt.subplots(
        len(lines), 1, figsize=(6.7, HEIGHT * len(lines) + 0.6), squeeze=False
    )
    drawn: dict[str, Artist] = {}
    for i, (axes, (name, cycles)) in enumerate(zip(panels[:, 0], lines.items(), strict=True)):
        along = cycles.attrs["along"]
        axes.axhline(1, **SLIDING)
        for run, swept in sweeps[name]:
            draw_sweep(axes, run, swept, along)
        draw_branches(axes, cycles, along)
        draw_points(axes, cycles, along)
        drawn |= {str(line.get_label()): line for line in axes.lines}
        axes.set(
            xlabel=parameters.axis_of(along),
            ylabel="maxima of $v$ (units of $v_0$)",
        )
        # the names of scenes stand above the dots
        axes.margins(x=0.01, y=0.18)
        axes.set_ylim(bottom=0)
        mark_scenes(axes, scenes, cycles.attrs, along)
        words = f"{parameters.in_words(cycles.attrs, along)}: {count_in_words(cycles)}"
        axes.set_title(f"$\\bf{{{'abcdefgh'[i % 8]}}}$  {words}")
    figure.legend(handles=legend_of(drawn), loc="outside lower center", ncols=3)
    return figure


def count_in_words(cycles: xr.Dataset) -> str:
    """How many branches and special points there are."""
    counts = {"branch": cycles.sizes["branches"], "special point": cycles.sizes["special"]}
    plurals = {"branch": "branches", "special point": "special points"}
    return ", ".join(
        f"{count} {name if count == 1 else plurals[name]}" for name, count in counts.items()
    )


def draw_sweep(axes: Axes, run: str, swept: xr.Dataset, along: str) -> None:
    """A dot for each maximum kept."""
    style = {"ls": "", "marker": ".", "mew": 0, "rasterized": True, "label": f"sweep {run}"}
    axes.plot(*maxima_of(swept, along), **style, **SWEEPS[run])


def draw_branches(axes: Axes, cycles: xr.Dataset, along: str) -> None:
    """The branches, cut where the number of unstable multipliers changes.

    Dots of sweeps lie over the stable parts and below the others.
    """
    for number in range(cycles.sizes["branches"]):
        x, y, unstable = branch_of(cycles, number + 1, along)
        cuts = np.flatnonzero(np.diff(unstable)) + 1
        # a branch of one orbit has no part
        for part in filter(len, np.split(np.arange(unstable.size), cuts)):
            count = int(unstable[part[0]])
            ends = slice(part[0], part[-1] + 2)
            axes.plot(x[ends], y[ends], **LINES[min(count, 3)], zorder=3 if count else 1)


def draw_points(axes: Axes, cycles: xr.Dataset, along: str) -> None:
    """Special points by their kind, and Hopf points, where a cycle starts from steady sliding.

    Marks would hide a branch that is smaller, so that its points would stand alone.
    """
    kinds = np.array(words_of(cycles.special_kind))
    x, branch = cycles[along].values, cycles.branch.values
    sizes = [np.ptp(x[branch == number]) for number in cycles.special_branch.values]
    large = np.array(sizes) > SMALL * np.ptp(axes.get_xlim())
    for kind, style in STYLES.items():
        these = cycles.isel(special=(kinds == kind) & large)
        if these.sizes["special"]:
            axes.plot(
                these[f"special_{along}"],
                these.special_v_most,
                ls="",
                marker=style.marker,
                ms=3.6,
                mfc="white",
                mec=style.colour,
                mew=0.9,
                label=in_words(kind),
                zorder=5,
            )
    if cycles.sizes["hopf"]:
        places = cycles[f"hopf_{along}"]
        axes.plot(places, np.ones(places.size), clip_on=False, zorder=4, **HOPF)


def legend_of(drawn: dict[str, Artist]) -> list[Artist]:
    """What is drawn somewhere, in the order of the lists above."""
    names = [
        *(str(style["label"]) for style in LINES),
        *(f"sweep {run}" for run in SWEEPS),
        *("steady sliding", "Hopf point", *map(in_words, STYLES)),
    ]
    return [drawn[name] for name in names if name in drawn]


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        swept = {path: read(path) for path in snakemake.input.sweeps}
        save(
            draw(
                {Path(path).stem: read(path) for path in snakemake.input.cycles},
                {
                    line: [(Path(path).stem, swept[path]) for path in paths]
                    for line, paths in snakemake.params.sweeps.items()
                },
                snakemake.params.scenes,
            ),
            snakemake.output,
        )
