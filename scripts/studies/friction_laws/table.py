"""Motions under several laws of friction, in planes and at scenes of the paper, as one table."""

from collections import Counter
from pathlib import Path

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import rows_by, write_table
from scripts.tables.attractor_tables import rows_of
from scripts.tables.motion_rows import kind_of

CHAOTIC, PERIODIC = "delayed_logarithm", "delayed_velocity"
"""Places of the delay, as the names of laws end: those with chaos, and those without."""


def law_rows(path: Path, run, scenes: list[str]) -> list[dict]:
    """Rows of a file: those of a plane, or that of a scene."""
    of = {"of": "scene" if path.stem in scenes else "plane", "place": path.stem}
    return [{"law": row["law"], **of, **row} for row in rows_of(run)]


def rows_of_planes(table: list[dict]) -> list[dict]:
    """Rows of points of planes."""
    return [row for row in table if row["of"] == "plane"]


def planes_of(table: list[dict]) -> dict[tuple, list[dict]]:
    """Rows of planes by gamma, xi and law, in ascending order."""
    return dict(sorted(rows_by(rows_of_planes(table), "gamma", "xi", "law").items()))


def shares_of(table: list[dict]) -> list[dict]:
    """How many points of each plane and law have each class."""
    return [
        {
            **{"gamma": gamma, "xi": xi, "law": law, "points": len(here)},
            "kinds": Counter(map(kind_of, here)),
        }
        for (gamma, xi, law), here in planes_of(table).items()
    ]


def chaotic_points(shares: list[dict], gamma: float) -> dict[str, list[int]]:
    """Numbers of chaotic points of planes at this gamma, by the place of the delay."""
    here = [share for share in shares if share["gamma"] == gamma]
    return {
        place: [share["kinds"]["chaos"] for share in here if share["law"].endswith(place)]
        for place in (CHAOTIC, PERIODIC)
    }


def scenes_of(table: list[dict]) -> dict[str, list[dict]]:
    """Rows of each scene, a row a law."""
    return rows_by((row for row in table if row["of"] == "scene"), "place")


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        scenes = snakemake.params.scenes
        runs = (law_rows(Path(path), read(path), scenes) for path in snakemake.input.runs)
        write_table(snakemake.output[0], [row for run in runs for row in run])
