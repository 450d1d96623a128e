"""Table of basins: the share of random histories that reaches each motion, by place."""

import math
from pathlib import Path

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import read_table, write_table
from scripts.models.models import PARAMETERS
from scripts.models.records import law_of
from scripts.tables.attractor_tables import same_attractor, scene_rows
from scripts.tables.motion_rows import UNDECIDED

MOTION_KEYS = (
    *("class", "period", "exponent_1", "error_1", "exponent_2", "error_2", "f1", "f2"),
    *("smallest_maximum", "largest_maximum"),
)


def basin_rows(place: str, run: xr.Dataset, on_routes: list[dict]) -> list[dict]:
    """A row for each motion at a place, the most frequent first; failed runs belong to none.

    Runs that are undecided share a row. Motions that only routes show follow, with a share of 0.
    """
    rows = scene_rows(place, run)
    unsure = [row for row in rows if row["class"] == UNDECIDED and not row["problem"]]
    for row in unsure:
        row["attractor"] = unsure[0]["attractor"]
    numbers = [row["attractor"] for row in rows if not math.isnan(row["attractor"])]
    found = [
        (next(row for row in rows if row["attractor"] == number), numbers.count(number))
        for number in sorted(set(numbers), key=lambda number: (-numbers.count(number), number))
    ]
    found += [(row, 0) for row in motions_beside([row for row, _ in found], rows[0], on_routes)]
    return [
        {
            "place": place,
            **{key: rows[0][key] for key in PARAMETERS if key in rows[0]},
            "law": law_of(rows[0]),
            "motion": motion,
            **{key: one[key] for key in MOTION_KEYS},
            "shown_by": f"{one['route']} {one['run']}" if count == 0 else "histories",
            "histories": len(rows),
            "share": count / len(rows),
            "share_error": math.sqrt(count * (len(rows) - count) / len(rows) ** 3),
        }
        for motion, (one, count) in enumerate(found, start=1)
    ]


def motions_beside(known: list[dict], place: dict, on_routes: list[dict]) -> list[dict]:
    """Motions of routes at the parameters of a place that are not among the known ones."""
    others: list[dict] = []
    for row in on_routes:
        values = ([one.get(key, math.nan) for key in PARAMETERS] for one in (row, place))
        here = np.allclose(*values, rtol=1e-6, atol=0, equal_nan=True)
        alike = any(same_attractor(row, other) for other in [*known, *others])
        here = here and law_of(row) == law_of(place)
        if here and row["class"] != UNDECIDED and not alike:
            others.append(row)
    return others


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        routes = [row for path in snakemake.input.routes for row in read_table(path)]
        runs = [(Path(path).stem, read(path)) for path in snakemake.input.runs]
        write_table(snakemake.output[0], [row for run in runs for row in basin_rows(*run, routes)])
