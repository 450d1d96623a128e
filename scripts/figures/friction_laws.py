"""Figure of other laws of friction: classes of motion over epsilon and tau, and fastest slip."""

from collections import Counter
from string import ascii_lowercase

from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing import parameters
from scripts.drawing.class_map import draw_classes, legend_of
from scripts.drawing.style import INK
from scripts.namelists.laws import spoken
from scripts.tables.friction_laws_table import (
    SECONDS_OF_YEAR,
    rows_of_planes,
    scenes_of,
    shares_of,
)
from scripts.tables.motion_rows import kind_of, planes_of

SHOWS_CLASSES = True
MARKS = ["o", "s", "^", "D", "v", "P"]


def inputs(_config: dict) -> dict:
    """Motions of each law in each plane, and in scenes of the paper."""
    return {"table": "<results>/tables/friction-laws.tsv"}


def params(config: dict) -> dict:
    """The values for (2) by which nondimensional ones are times and velocities of a fault."""
    return {"fault": config["dimensions"]["fault"]}


def draw(table: list[dict], fault: dict) -> Figure:
    """A law a row, a plane a column; below, the fastest slip over tau at the largest epsilon."""
    rows = rows_of_planes(table)
    laws = list(dict.fromkeys(row["law"] for row in rows))
    planes = list(dict.fromkeys((row["gamma"], row["xi"]) for row in rows))
    figure, panels = plt.subplots(
        len(laws) + 1,
        len(planes),
        figsize=(6.7, 1.5 + 1.55 * (len(laws) + 1)),
        squeeze=False,
        height_ratios=[1] * len(laws) + [1.25],
    )
    letters = iter(ascii_lowercase)
    shown = planes_of(rows)
    for law, line in zip(laws, panels, strict=False):
        for (gamma, xi), axes in zip(planes, line, strict=True):
            here = shown[gamma, xi, law]
            draw_classes(axes, here, "tau")
            chaotic = sum(row["class"] == "chaos" for row in here)
            axes.set_title(
                f"$\\bf{{{next(letters)}}}$  {spoken(law)}\nchaos at {chaotic} of {len(here)}",
                fontsize=7,
            )
            if law == laws[-1]:
                axes.set_xlabel(r"sensitivity $\varepsilon$")
        line[0].set_ylabel(r"delay $\tau$ ($L/v_0$)")
    for (gamma, xi), axes in zip(planes, panels[-1], strict=True):
        place = {"gamma": gamma, "xi": xi}
        words = parameters.in_words(place, "tau", "epsilon")
        draw_fastest(axes, {law: shown[gamma, xi, law] for law in laws}, fault)
        axes.set_title(f"$\\bf{{{next(letters)}}}$  {words}", fontsize=7, pad=26)
    for axes, (gamma, xi) in zip(panels[0], planes, strict=True):
        words = parameters.in_words({"gamma": gamma, "xi": xi}, "tau", "epsilon")
        axes.annotate(
            words,
            (0.5, 1.42),
            xycoords="axes fraction",
            ha="center",
            fontsize=8,
            annotation_clip=False,
        )
    panels[-1][0].set_ylabel("largest $v$ ($v_0$)")
    marks, _ = panels[-1][0].get_legend_handles_labels()
    handles = [*legend_of(rows), *marks]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=7)
    return figure


def draw_fastest(axes: Axes, by_law: dict[str, list[dict]], fault: dict) -> None:
    """The largest maximum of v over tau at the largest epsilon, with years of a fault above."""
    for number, (law, rows) in enumerate(by_law.items()):
        most = max(row["epsilon"] for row in rows)
        line = sorted((row for row in rows if row["epsilon"] == most), key=lambda row: row["tau"])
        axes.semilogy(
            [row["tau"] for row in line],
            [row["largest_maximum"] for row in line],
            marker=MARKS[number % len(MARKS)],
            ms=2.5,
            lw=0.8,
            color=f"C{number}",
            label=spoken(law),
        )
    axes.axhline(1, color=INK, lw=0.5)
    axes.set_xlabel(r"delay $\tau$ ($L/v_0$)")
    years = fault["length"] / fault["v0"] / SECONDS_OF_YEAR
    above = axes.secondary_xaxis("top", functions=(lambda t: t * years, lambda t: t / years))
    above.set_xlabel("years on a fault", fontsize=7, labelpad=2)
    above.tick_params(labelsize=7)


def numbers(table: list[dict], fault: dict) -> dict:
    """Shares of the classes of each law in each plane, and the classes of scenes."""
    return {
        "shares": [
            {**share, "law": spoken(share["law"]), "kinds": in_words(share["kinds"])}
            for share in shares_of(table)
        ],
        "scenes": [
            {"scene": scene.replace("_", " "), "motions": motions}
            for scene, motions in motions_of(table).items()
        ],
        "years": fault["length"] / fault["v0"] / SECONDS_OF_YEAR,
    }


def in_words(kinds: Counter) -> str:
    """Numbers of points by class."""
    return ", ".join(f"{number} {kind}" for kind, number in kinds.most_common())


def motions_of(table: list[dict]) -> dict[str, str]:
    """What each scene is under each law, in words."""
    return {
        scene: ", ".join(f"{kind_of(row)} ({spoken(row['law'])})" for row in rows)
        for scene, rows in scenes_of(table).items()
    }
