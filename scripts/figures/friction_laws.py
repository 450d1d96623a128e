"""The drawing of plans/friction_laws.py, and the numbers of its caption."""

from collections import Counter
from string import ascii_lowercase

from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.config.si import in_si, units_of
from scripts.drawing import parameters
from scripts.drawing.class_map import draw_classes, legend_of
from scripts.drawing.si_axes import TIMES, add_axis
from scripts.drawing.style import INK
from scripts.namelists.laws import spoken
from scripts.tables.friction_laws_table import rows_of_planes, scenes_of, shares_of
from scripts.tables.motion_rows import COLOURS, kind_of, planes_of

MARKS = ["o", "s", "^", "D", "v", "P"]
DELAY = r"delay $\tau$ ($L/v_0$)"


def draw(table: list[dict], natural_fault: dict, laboratory: dict) -> Figure:
    """A law a row, a plane a column; below, motions over tau at the largest epsilon."""
    rows = rows_of_planes(table)
    laws = list(dict.fromkeys(row["law"] for row in rows))
    planes = list(dict.fromkeys((row["gamma"], row["xi"]) for row in rows))
    figure, panels = plt.subplots(
        len(laws) + 2,
        len(planes),
        figsize=(6.7, 1.5 + 1.55 * (len(laws) + 2)),
        squeeze=False,
        height_ratios=[1] * len(laws) + [1.2, 1.2],
    )
    letters = iter(ascii_lowercase)
    *maps, fastest, recurrence = panels
    shown = planes_of(rows)
    for law, line in zip(laws, maps, strict=True):
        for (gamma, xi), axes in zip(planes, line, strict=True):
            here = shown[gamma, xi, law]
            draw_classes(axes, here, "tau")
            draw_scenes(axes, table, law, (gamma, xi))
            chaotic = sum(row["class"] == "chaos" for row in here)
            words = f"{spoken(law)}\nchaos at {chaotic} of {len(here)}"
            axes.set_title(f"$\\bf{{{next(letters)}}}$  {words}", fontsize=7)
        line[0].set_ylabel(DELAY)
    for column, (gamma, xi) in enumerate(planes):
        words = parameters.in_words({"gamma": gamma, "xi": xi}, "tau", "epsilon")
        by_law = {law: shown[gamma, xi, law] for law in laws}
        head_column(maps[0][column], words)
        maps[-1][column].set_xlabel(r"sensitivity $\varepsilon$")
        draw_over_delay(fastest[column], by_law, "largest_maximum")
        fastest[column].semilogy()
        fastest[column].axhline(1, color=INK, lw=0.5)
        draw_over_delay(recurrence[column], by_law, "recurrence_variation")
        add_axis(fastest[column], unit_of_time(natural_fault) / TIMES["years"], "years on a fault")
        add_axis(recurrence[column], unit_of_time(laboratory), "seconds in a laboratory")
    fastest[0].set_ylabel("largest $v$ ($v_0$)")
    recurrence[0].set_ylabel("variation of\nrecurrence")
    for axes in (*fastest, *recurrence):
        axes.set_title(f"$\\bf{{{next(letters)}}}$", fontsize=7, pad=26)
    lines, _ = fastest[0].get_legend_handles_labels()
    handles = [*legend_of(rows), *lines]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=7)
    return figure


def draw_scenes(axes: Axes, table: list[dict], law: str, plane: tuple[float, float]) -> None:
    """A circle for each scene of this plane, coloured by its class under the law."""
    for rows in scenes_of(table).values():
        for row in rows:
            if row["law"] == law and (row["gamma"], row["xi"]) == plane:
                colour = COLOURS[kind_of(row)]
                axes.plot(
                    row["epsilon"], row["tau"], marker="o", ms=5, mfc=colour, mec=INK, mew=0.7
                )


def head_column(axes: Axes, words: str) -> None:
    """The plane of a column, above its first map."""
    axes.annotate(
        words,
        (0.5, 1.42),
        xycoords="axes fraction",
        ha="center",
        fontsize=8,
        annotation_clip=False,
    )


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
    axes.set_xlabel(DELAY)


def unit_of_time(si: dict) -> float:
    """The unit of time, L/v0, in s."""
    return units_of(in_si(si))["s"]


def numbers(table: list[dict], natural_fault: dict, laboratory: dict) -> dict:
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
        "years": unit_of_time(natural_fault) / TIMES["years"],
        "seconds": unit_of_time(laboratory),
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
