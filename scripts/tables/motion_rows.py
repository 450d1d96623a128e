"""What rows of attractors, of the atlas and of routes say."""

import math
from collections.abc import Mapping

import numpy as np

from scripts.models.records import law_of

UNDECIDED = "undecided"
AXES_FIRST = ("epsilon", "tau", "xi", "gamma")
"""PARAMETERS in the order of tables of planes: the axes of the atlas first."""
FIXED = AXES_FIRST[::-1]
"""Planes are in the order of these."""
COLOURS = {
    "fixed point": "#d9d9d9",
    "cycle": "#56b4e9",
    "multi-loop cycle": "#0072b2",
    "torus": "#f0e442",
    "3-torus": "#009e73",
    "chaos": "#d55e00",
    UNDECIDED: "#ffffff",
}
"""Colour of cells by kind of motion; colour-blind readers can distinguish them."""


def has_problem(row: dict) -> bool:
    """Whether the run of a row failed; an empty cell of a table is not a text."""
    return isinstance(row["problem"], str) and bool(row["problem"])


def is_computed(row: dict) -> bool:
    """Whether a point was computed; points of the atlas may have the class of their neighbours."""
    return row.get("computed") != "no"


def kind_of(row: dict) -> str:
    """The class, cycles parted by their period in the section."""
    several = row["class"] == "cycle" and row["period"] > 1
    return "multi-loop cycle" if several else row["class"]


def own_rows(table: list[dict]) -> dict[str, dict]:
    """Rows of attractors.tsv from the scenes' own histories, by scene."""
    return {row["scene"]: row for row in table if row["history"] == 1}


def class_in_words(row: dict) -> str:
    """The class of a motion in a sentence or a title."""
    return "limit cycle" if row["class"] == "cycle" else row["class"]


def nearest_alike(kinds: np.ndarray, computed: np.ndarray) -> np.ndarray:
    """For each point of a grid the nearest computed one of its kind: its line and column.

    The shape is (2, lines, columns). A computed point is its own nearest one.
    """
    nearest = np.indices(kinds.shape)
    places = np.argwhere(computed)
    for place in np.argwhere(~computed):
        alike = places[kinds[tuple(places.T)] == kinds[tuple(place)]]
        nearest[:, *place] = alike[np.argmin(((alike - place) ** 2).sum(axis=1))]
    return nearest


def axes_of(place: Mapping) -> tuple[str, str]:
    """Abscissa and ordinate of the plane of a row or of curves, by default epsilon and tau."""
    named = (place.get("abscissa"), place.get("ordinate"))
    # an empty cell of a table is not a text
    x, y = (name if isinstance(name, str) else "" for name in named)
    return x or "epsilon", y or "tau"


def plane_of(place: Mapping, axes: tuple[str, str] | None = None) -> tuple:
    """The plane of a row or of curves: what is fixed of the block, its law and axes."""
    axes = axes or axes_of(place)
    values = [math.nan if key in axes else place.get(key, math.nan) for key in FIXED]
    # NaN is not equal to itself
    known = (-2.0 if math.isnan(value) else value for value in values)
    return *known, law_of(place, *axes), *axes


def planes_of(rows: list[dict]) -> dict[tuple, list[dict]]:
    """Rows of the atlas by their plane, in ascending order."""
    planes = sorted({plane_of(row) for row in rows})
    return {at: [row for row in rows if plane_of(row) == at] for at in planes}


def parameter_of(rows: list[dict]) -> str:
    """The parameter that varies along a route, or the value of the history."""
    # runs differ in their histories
    of_run = [row for row in rows if row.get("run") == rows[0].get("run")]
    places = list(rows[0])[: list(rows[0]).index("class")]
    numbers = [key for key in places if isinstance(rows[0][key], float)]
    return next(key for key in numbers if len({row[key] for row in of_run}) > 1)


def count_in_words(rows: list[dict]) -> str:
    """How many points there are, how many were computed if not all, and how many have no class."""
    computed = sum(map(is_computed, rows))
    unsure = sum(row["class"] == UNDECIDED and not has_problem(row) for row in rows)
    failed = sum(map(has_problem, rows))
    counts = [f"{len(rows)} points"]
    counts += [f"{computed} computed"] * (computed < len(rows))
    counts += [f"{unsure} undecided"]
    counts += [f"{failed} failed"] * (failed > 0)
    return ", ".join(counts)
