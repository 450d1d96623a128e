"""The drawing of plans/friction_laws.py, and the numbers of its caption."""

from string import ascii_lowercase

from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.config.si import in_si, units_of
from scripts.drawing import parameters
from scripts.drawing.class_map import draw_classes, legend_of
from scripts.drawing.si_axes import TIMES, add_axis
from scripts.drawing.style import INK, PAGE
from scripts.drawing.wording import place_in_words
from scripts.models.records import spoken
from scripts.studies.friction_laws.table import planes_of, rows_of_planes, scenes_of, shares_of
from scripts.tables.motion_rows import COLOURS, UNDECIDED, kind_of

MARKS = ["o", "s", "^", "D", "v", "P"]
LEAST_OF_FAULTS = 1e4
"""The least gamma of a real fault, by the paper: at others years and seconds mean nothing."""
DELAY = r"delay $\tau$ ($L/v_0$)"


def draw(table: list[dict], natural_fault: dict, laboratory: dict) -> Figure:
    """A law a row, a plane a column; below, motions over tau at the largest epsilon."""
    rows = rows_of_planes(table)
    laws = list(dict.fromkeys(row["law"] for row in rows))
    planes = list(dict.fromkeys((row["gamma"], row["xi"]) for row in rows))
    figure, panels = plt.subplots(
        len(laws) + 2,
        len(planes),
        figsize=(PAGE[0], min(PAGE[1], 1.5 + 1.3 * (len(laws) + 2))),
        squeeze=False,
        height_ratios=[1] * len(laws) + [1.2, 1.2],
    )
    letters = iter(ascii_lowercase)
    *maps, fastest, recurrence = panels
    shown = planes_of(table)
    for law, line in zip(laws, maps, strict=True):
        for (gamma, xi), axes in zip(planes, line, strict=True):
            here = shown[gamma, xi, law]
            draw_classes(axes, here, ("epsilon", "tau"))
            draw_scenes(axes, table, law, (gamma, xi))
            chaotic = sum(row["class"] == "chaos" for row in here)
            words = f"{spoken(law)}\nchaos at {chaotic} of {len(here)}"
            axes.set_title(f"$\\bf{{{next(letters)}}}$  {words}", fontsize=7)
            axes.tick_params(labelbottom=law == laws[-1])
        line[0].set_ylabel(DELAY)
    for column, (gamma, xi) in enumerate(planes):
        words = parameters.in_words({"gamma": gamma, "xi": xi}, "tau", "epsilon")
        by_law = {law: shown[gamma, xi, law] for law in laws}
        # above the two lines of the title
        place = {"xytext": (0, 28), "textcoords": "offset points", "annotation_clip": False}
        maps[0][column].annotate(words, (0.5, 1), xycoords="axes fraction", ha="center", **place)
        maps[-1][column].set_xlabel(r"sensitivity $\varepsilon$")
        draw_over_delay(fastest[column], by_law, "largest_maximum")
        fastest[column].semilogy()
        fastest[column].axhline(1, color=INK, lw=0.5)
        fastest[column].tick_params(labelbottom=False)
        draw_over_delay(recurrence[column], by_law, "recurrence_variation")
        recurrence[column].set_xlabel(DELAY)
        if gamma >= LEAST_OF_FAULTS:
            years = unit_of_time(natural_fault) / TIMES["years"]
            add_axis(fastest[column], years, "years on a fault")
            add_axis(recurrence[column], unit_of_time(laboratory), "seconds in a laboratory")
    fastest[0].set_ylabel("largest $v$ ($v_0$)")
    recurrence[0].set_ylabel("variation of\nrecurrence")
    for axes in (*fastest, *recurrence):
        axes.set_title(f"$\\bf{{{next(letters)}}}$", fontsize=7, pad=26 if axes.child_axes else 6)
    lines, _ = fastest[0].get_legend_handles_labels()
    handles = [*legend_of(rows), *lines]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=7)
    return figure


def draw_scenes(axes: Axes, table: list[dict], law: str, plane: tuple[float, float]) -> None:
    """A circle for each scene of this plane, coloured by its class under the law."""
    for row in table:
        if (row["of"], row["law"], row["gamma"], row["xi"]) == ("scene", law, *plane):
            style = {"mfc": COLOURS[kind_of(row)], "mec": INK, "mew": 0.7}
            axes.plot(row["epsilon"], row["tau"], marker="o", ms=5, **style)


def draw_over_delay(axes: Axes, by_law: dict[str, list[dict]], column: str) -> None:
    """A number of the motions over tau, at the largest epsilon."""
    for number, (law, rows) in enumerate(by_law.items()):
        most = max(row["epsilon"] for row in rows)
        line = sorted((row for row in rows if row["epsilon"] == most), key=lambda row: row["tau"])
        axes.plot(
            [row["tau"] for row in line],
            [row[column] for row in line],
            marker=MARKS[number % len(MARKS)],
            ms=2.5,
            lw=0.8,
            color=f"C{number}",
            label=spoken(law),
        )


def unit_of_time(si: dict) -> float:
    """The unit of time, L/v0, in s."""
    return units_of(in_si(si))["s"]


def numbers(table: list[dict], natural_fault: dict, laboratory: dict) -> dict:
    """Chaotic points by plane and law, and the classes of scenes."""
    shares = shares_of(table)
    laws = list(dict.fromkeys(row["law"] for row in rows_of_planes(table)))
    by_plane: dict[str, list[str]] = {}
    for share in shares:
        place = f"chaos at {place_in_words({key: share[key] for key in ('gamma', 'xi')})}"
        unsure = f", {number} undecided" if (number := share["kinds"][UNDECIDED]) else ""
        cells = by_plane.setdefault(place, [place, *("" for _ in laws)])
        cells[1 + laws.index(share["law"])] = f"{share['kinds']['chaos']}{unsure}"
    scenes = [
        [f"scene {scene.replace('_', ' ')}", *map(kind_of, motions)]
        for scene, motions in scenes_of(table).items()
    ]
    return {
        "cells": [["", *map(spoken, laws)], *by_plane.values(), *scenes],
        "points": max(share["points"] for share in shares),
        "years": unit_of_time(natural_fault) / TIMES["years"],
        "seconds": unit_of_time(laboratory),
    }
