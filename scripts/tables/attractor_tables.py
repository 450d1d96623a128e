"""Tables of attractors, one row a point: scenes with their histories, the atlas, routes."""

from pathlib import Path

import numpy as np

from scripts.files.inputs import DataArray, Dataset, read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.models.models import PARAMETERS
from scripts.models.records import law_of
from scripts.tables.exponent_signs import SIGNS
from scripts.tables.motion_rows import AXES_FIRST, has_problem

SAME_MAXIMUM = 0.02
"""Greatest share by which maxima of v differ on one cycle or torus: near a fold a cycle is
approached slowly."""
ERROR_BARS = 3.0
"""Greatest number of error bars by which exponents differ on one chaotic attractor."""
OF_MOTION = (
    *("smallest_maximum", "largest_maximum"),
    *("recurrence_time", "recurrence_variation", "roughness"),
)
"""Numbers of a motion as they stand in its file."""
NOT_COMPUTED = {*PARAMETERS, "law", "abscissa", "ordinate", "computed", "class", "period"}
"""Columns of points of the atlas that were not computed; the others but axes and histories are
empty."""


def rows_of(run: Dataset, **flags: list[str]) -> list[dict]:
    """Rows of a file, with columns of further flags before the class; values not found are NaN."""
    measured = run.sign.notnull().any("exponent")
    columns = {
        **{key: numbers(run[key]) for key in AXES_FIRST if key in run},
        "law": [law_of(run.attrs)] * run.sizes["point"],
        **{key: numbers(run[key]) for key in axes_of(run) if key not in PARAMETERS},
        **{key: numbers(run[f"history_{key}"]) for key in histories_of(run)},
        **flags,
        "class": words(run["class"]),
        "reason": ["" if word == "none" else word for word in words(run.reason)],
        "time": numbers(run.time),
        **{key: words(run[key]) for key in ("by_exponents", "by_section", "by_spectrum")},
        "period": positive(run.period),
        **{
            f"{key}_{i + 1}": numbers(run[variable].isel(exponent=i))
            for i in range(run.sizes["exponent"])
            for key, variable in (("exponent", "lyapunov_exponent"), ("error", "lyapunov_error"))
        },
        **{
            f"{word}_exponents": numbers((run.sign == sign).sum("exponent").where(measured))
            for sign, word in SIGNS.items()
        },
        "f1": positive(run.base_1),
        "f2": positive(run.base_2),
        "f3": positive(run.base_3),
        **{key: numbers(run[key]) for key in OF_MOTION},
        "problem": run.problem.values.tolist(),
    }
    return [
        dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)
    ]


def atlas_rows(run: Dataset) -> list[dict]:
    """Rows of a part of the atlas, with the column `computed` before the class."""
    axes = axes_of(run)
    # these are epsilon and tau where there are no such columns
    named = zip(("abscissa", "ordinate"), ("epsilon", "tau"), axes, strict=True)
    other = {key: [axis] * run.sizes["point"] for key, default, axis in named if axis != default}
    rows = rows_of(run, **other, computed=words(run.computed))
    kept = NOT_COMPUTED | {*axes, *histories_of(run)}
    for row in rows:
        if row["computed"] == "no":
            row |= dict.fromkeys(row.keys() - kept, np.nan)
    return rows


def histories_of(run: Dataset) -> list[str]:
    """Names of the values before the initial time."""
    names = [str(name) for name in run.data_vars if str(name).startswith("history_")]
    return [name.removeprefix("history_") for name in names]


def axes_of(run: Dataset) -> list[str]:
    """Keys of the parameters that vary."""
    return run.attrs.get("axes", "epsilon tau").split()


def numbers(values: DataArray) -> list[float]:
    """A column of numbers."""
    return values.values.astype(float).tolist()


def positive(values: DataArray) -> list[float]:
    """A column of numbers, NaN where 0 says that there is none."""
    return numbers(values.where(values > 0))


def words(flags: DataArray) -> list[str]:
    """A column of flags by their meanings."""
    meanings = [word.replace("_", " ") for word in flags.attrs["flag_meanings"].split()]
    return [meanings[flag] for flag in flags.values]


def scene_rows(scene: str, run: Dataset) -> list[dict]:
    """Rows of a scene, numbered by history and by attractor; a run that failed reached none.

    Histories are tame if v is at most as large in all of them as on the attractors: they cannot be
    expected to find motions of larger slip events.
    """
    rows = rows_of(run)
    maxima = [row["largest_maximum"] for row in rows]
    largest = max((value for value in maxima if not np.isnan(value)), default=0.0)
    signal = run.attrs["signal"]
    tame = "yes" if max(row.get(signal, np.nan) for row in rows) <= largest else "no"
    found: list[dict] = []
    numbered = []
    for history, row in enumerate(rows, start=1):
        alike = (i for i, other in enumerate(found, start=1) if same_attractor(row, other))
        number = next(alike, np.nan)
        if np.isnan(number) and not row["problem"]:
            found.append(row)
            number = len(found)
        place = {"scene": scene, "history": history, "attractor": number}
        numbered.append({**place, **row, "tame_histories": tame})
    return numbered


def route_rows(path: Path, run: Dataset) -> list[dict]:
    """Rows of a run along a route, named by the file: its history or its sweep."""
    return [{"route": path.parent.name, "run": path.stem, **row} for row in rows_of(run)]


def same_attractor(one: dict, other: dict) -> bool:
    """Whether two runs reached the same attractor, by their classes, maxima and exponents."""
    if one["class"] != other["class"] or has_problem(one):
        return False
    if one["class"] == "fixed point":
        return True
    if one["class"] in ("cycle", "torus", "3-torus"):
        keys = ["smallest_maximum", "largest_maximum"]
        near = all(np.isclose(one[key], other[key], rtol=SAME_MAXIMUM, atol=0) for key in keys)
        periods = np.array_equal(one["period"], other["period"], equal_nan=True)
        return near and (one["class"] != "cycle" or periods)
    apart = abs(one["exponent_1"] - other["exponent_1"])
    return bool(apart <= ERROR_BARS * np.hypot(one["error_1"], other["error_1"]))


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        rows_by_kind = {
            "scenes": lambda path, run: scene_rows(path.stem, run),
            "route": route_rows,
            "atlas": lambda _, run: atlas_rows(run),
        }
        make_rows = rows_by_kind[snakemake.params.of]
        rows = [row for path in snakemake.input.runs for row in make_rows(Path(path), read(path))]
        write_table(snakemake.output[0], rows)
