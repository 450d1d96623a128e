"""Table of basins: the share of random histories that comes to each motion, by place."""

import math
from pathlib import Path

import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.namelists.study_cases import PARAMETERS
from scripts.tables.attractor_tables import scene_rows
from scripts.tables.motion_rows import UNDECIDED

OF_MOTION = (
    *("class", "period", "exponent_1", "error_1", "exponent_2", "error_2", "f1", "f2"),
    *("smallest_maximum", "largest_maximum"),
)


def basin_rows(place: str, run: xr.Dataset) -> list[dict]:
    """A row for each motion at a place, the most frequent first; failed runs belong to none.

    Runs that are undecided share a row.
    """
    rows = scene_rows(place, run)
    unsure = [row for row in rows if row["class"] == UNDECIDED and not row["problem"]]
    for row in unsure:
        row["attractor"] = unsure[0]["attractor"]
    numbers = [row["attractor"] for row in rows if not math.isnan(row["attractor"])]
    motions = sorted(set(numbers), key=lambda number: (-numbers.count(number), number))
    found = []
    for motion, number in enumerate(motions, start=1):
        one = next(row for row in rows if row["attractor"] == number)
        share = numbers.count(number) / len(rows)
        found.append(
            {
                "place": place,
                **{key: one[key] for key in PARAMETERS},
                "motion": motion,
                **{key: one[key] for key in OF_MOTION},
                "histories": len(rows),
                "share": share,
                "share_error": math.sqrt(share * (1 - share) / len(rows)),
            }
        )
    return found


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        runs = [(Path(path).stem, read(path)) for path in snakemake.input.runs]
        write_table(snakemake.output[0], [row for run in runs for row in basin_rows(*run)])
