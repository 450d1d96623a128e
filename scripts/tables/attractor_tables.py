"""Tables of attractors, one row a point: scenes with their histories, the atlas, routes."""

from pathlib import Path

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.motion_rows import has_problem

SAME_MAXIMUM = 0.02
"""Maxima of v on one and the same cycle or torus differ by no more than this share: near a fold a
cycle is approached slowly."""
ERROR_BARS = 3.0
"""Exponents of one and the same chaotic attractor differ by no more error bars than this."""


def rows_of(run: xr.Dataset) -> list[dict]:
    """Rows of a file; fundamental frequencies, periods and maxima that are not there are NaN."""
    columns = {
        **{key: numbers(run[key]) for key in ("epsilon", "tau", "xi", "gamma")},
        **{key: numbers(run[f"history_{key}"]) for key in ("theta", "u", "v")},
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
        "f1": positive(run.base_1),
        "f2": positive(run.base_2),
        "f3": positive(run.base_3),
        **{key: numbers(run[key]) for key in ("smallest_maximum", "largest_maximum", "roughness")},
        "problem": run.problem.values.tolist(),
    }
    return [
        dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)
    ]


NOT_COMPUTED = ["epsilon", "tau", "xi", "gamma", "theta", "u", "v", "computed", "class", "period"]
"""Columns of points of the atlas that were not computed; the others are empty."""


def atlas_rows(run: xr.Dataset) -> list[dict]:
    """Rows of a part of the atlas, with the column `computed` before the class."""
    rows = []
    for computed, row in zip(words(run.computed), rows_of(run), strict=True):
        items = list(row.items())
        at = list(row).index("class")
        whole = dict([*items[:at], ("computed", computed), *items[at:]])
        if computed == "no":
            whole = {key: value if key in NOT_COMPUTED else np.nan for key, value in whole.items()}
        rows.append(whole)
    return rows


def numbers(values: xr.DataArray) -> list[float]:
    """A column of numbers."""
    return values.values.astype(float).tolist()


def positive(values: xr.DataArray) -> list[float]:
    """A column of numbers, NaN where 0 says that there is none."""
    return numbers(values.where(values > 0))


def words(flags: xr.DataArray) -> list[str]:
    """A column of flags by their meanings."""
    meanings = [word.replace("_", " ") for word in flags.attrs["flag_meanings"].split()]
    return [meanings[flag] for flag in flags.values]


def scene_rows(scene: str, run: xr.Dataset) -> list[dict]:
    """Rows of a scene, numbered by history and by attractor; a run that failed reached none.

    Histories are tame if v is at most as large in all of them as on the attractors: they cannot be
    expected to find motions of larger slip events.
    """
    found: list[dict] = []
    rows = []
    of_runs = rows_of(run)
    maxima = [row["largest_maximum"] for row in of_runs]
    largest = max((value for value in maxima if not np.isnan(value)), default=0.0)
    tame = "yes" if max(row["v"] for row in of_runs) <= largest else "no"
    for history, row in enumerate(of_runs, start=1):
        number = next(
            (i for i, other in enumerate(found, start=1) if same_attractor(row, other)), None
        )
        if number is None and not row["problem"]:
            found.append(row)
            number = len(found)
        number = np.nan if number is None else number
        rows.append(
            {"scene": scene, "history": history, "attractor": number, **row, "tame_histories": tame}
        )
    return rows


def route_rows(path: Path, run: xr.Dataset) -> list[dict]:
    """Rows of a run along a route, named by the file: its history or its sweep."""
    return [{"route": path.parent.name, "run": path.stem, **row} for row in rows_of(run)]


def same_attractor(one: dict, other: dict) -> bool:
    """Whether two runs reached the same attractor, as far as can be told."""
    if one["class"] != other["class"] or has_problem(one):
        return False
    if one["class"] == "fixed point":
        return True
    if one["class"] in ("cycle", "torus", "3-torus"):
        keys = ["smallest_maximum", "largest_maximum"]
        near = all(np.isclose(one[key], other[key], rtol=SAME_MAXIMUM, atol=0) for key in keys)
        return near and (one["class"] != "cycle" or one["period"] == other["period"])
    apart = abs(one["exponent_1"] - other["exponent_1"])
    return bool(apart <= ERROR_BARS * np.hypot(one["error_1"], other["error_1"]))


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        runs = [(Path(path), read(path)) for path in snakemake.input.runs]
        rows_by_kind = {
            "scenes": lambda path, run: scene_rows(path.stem, run),
            "route": route_rows,
            "atlas": lambda _, run: atlas_rows(run),
        }
        rows = rows_by_kind[snakemake.params.of]
        write_table(snakemake.output[0], [row for path, run in runs for row in rows(path, run)])
