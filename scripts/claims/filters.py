"""Filters of the templates of tests: choices among results, and numbers and lists in sentences."""

import math
import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping

import numpy as np

from scripts.files.inputs import Dataset
from scripts.files.tsv import rows_by
from scripts.models.models import PARAMETERS

NOTHING = 1e-5
"""Shares below this are not given as numbers: they are errors of the solver."""


def short(value: float, digits: int = 4) -> str:
    """A number for a sentence."""
    return f"{value:.{digits}g}"


def percent(share: float) -> str:
    """A share in per cent."""
    if 0 < share < NOTHING:
        return f"less than {100 * NOTHING:g} %"
    return f"{100 * share:.3g} %"


def equations(values: Mapping, *names: str) -> str:
    """Values of variables in a sentence, of all if none is named; NaN is left out."""
    known = {name: values.get(name, math.nan) for name in names or values}
    return ", ".join(f"${key} = {short(one)}$" for key, one in known.items() if not math.isnan(one))


def fixed(place: Mapping, along: str = "") -> dict:
    """The block's parameters at a place, without that along a line."""
    return {key: place[key] for key in PARAMETERS if key != along and key in place}


def along(places: Iterable[float], name: str, digits: int = 4, between: str = " and ") -> str:
    """Values of a parameter: its name stands before the first."""
    first, *others = (short(place, digits) for place in places)
    return between.join([f"${name} = {first}$", *others])


def span(values: np.ndarray, between: str = " to ") -> str:
    """The least and the largest value."""
    found = np.asarray(values)
    return f"{short(found.min())}{between}{short(found.max())}"


def listed(words: list[str]) -> str:
    """Words with commas between them, or that there are none."""
    return ", ".join(words) or "none"


def counted(words: Iterable[str]) -> str:
    """How often there is which word."""
    return listed([f"{count} {word}" for word, count in sorted(Counter(words).items())])


def motion(row: Mapping) -> str:
    """The class of a row, of a cycle with its period in the section."""
    several = row["class"] == "cycle" and row["period"] > 1
    return f"cycle with {row['period']:.0f} loops" if several else row["class"]


def by(data: list[dict] | dict[str, Dataset], **names: str | list[str]) -> list:
    """Rows of each scene or route, or its data set; to have none is an error."""
    ((kind, wanted),) = names.items()
    known = rows_by(data, kind) if isinstance(data, list) else data
    if missing := [name for name in wanted if name not in known]:
        raise ValueError(f"no results of {kind} '{missing[0]}'; there are: {', '.join(known)}")
    return [known[name] for name in wanted]


def of(data: list[dict] | dict[str, Dataset], **name: str):
    """The same of one scene or route."""
    ((kind, wanted),) = name.items()
    return by(data, **{kind: [wanted]})[0]


def where(rows: Iterable[dict], **values) -> list[dict]:
    """Rows that have these values."""
    return [row for row in rows if all(row[key] == value for key, value in values.items())]


def between(rows: Iterable[dict], key: str, least: float, most: float) -> list[dict]:
    """Rows with a value in a range."""
    return [row for row in rows if least <= row[key] <= most]


def most(rows: Iterable[dict], key: str) -> float:
    """The largest value of rows, 0 if there are none."""
    return max((row[key] for row in rows), default=0.0)


def values(data: list[Dataset], name: str) -> np.ndarray:
    """All values of a variable of several data sets."""
    return np.concatenate([one[name] for one in data])


def each(values: Iterable, function: Callable, *given) -> list:
    """What a function returns for each value."""
    return [function(value, *given) for value in values]


def with_changes(row: dict) -> dict:
    """A row of linear stability with its changes along the delay: where, and the unstable roots
    before and after; where steady sliding becomes unstable, and where it is stable again."""
    found = re.findall(r"(\S+) \((\d+) -> (\d+)\)", str(row["tau_of_changes"]))
    changes = [(float(place), int(before), int(after)) for place, before, after in found]
    lost = [place for place, before, _ in changes if before == 0]
    regained = [place for place, _, after in changes if after == 0]
    return row | {"changes": changes, "lost": lost, "regained": regained}


def boundary(curves: Dataset) -> Dataset:
    """The points of Hopf curves where stability changes."""
    return curves.isel(point=curves.unstable_roots.values == 0)


def torus_points(place: Mapping, along: str, cycle_points: list[dict]) -> dict[float, str]:
    """Torus bifurcations of stable cycles on a line through a place: where, and of which kind."""
    found = {
        point[along]: point["criticality"]
        for point in cycle_points
        if point["kind"] == "torus"
        and min(point["unstable_before"], point["unstable_behind"]) == 0
        and fixed(point, along) == fixed(place, along)
    }
    return dict(sorted(found.items()))


FILTERS = {
    one.__name__: one
    for one in (
        *(short, percent, equations, fixed, along, span, listed, counted, motion),
        *(by, of, where, between, most, values, each, with_changes, boundary),
    )
}
"""By their names in templates."""
