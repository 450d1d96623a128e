"""Motions under several laws of friction, in planes and at scenes of the paper, as one table."""

from collections import Counter
from pathlib import Path

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.attractor_tables import rows_of
from scripts.tables.motion_rows import kind_of


def law_rows(path: Path, run, scenes: list[str]) -> list[dict]:
    """Rows of a file: those of a plane, or that of a scene."""
    name = path.stem
    rows = rows_of(run)
    return [
        {
            **{"law": row["law"], "of": "scene" if name in scenes else "plane", "place": name},
            **{key: value for key, value in row.items() if key != "law"},
        }
        for row in rows
    ]


def rows_of_planes(table: list[dict]) -> list[dict]:
    """Rows of points of planes."""
    return [row for row in table if row["of"] == "plane"]


def planes_of(rows: list[dict]) -> dict[tuple, list[dict]]:
    """Rows of planes by gamma, xi and law, in ascending order."""
    places = sorted({(row["gamma"], row["xi"], row["law"]) for row in rows})
    return {
        at: [row for row in rows if (row["gamma"], row["xi"], row["law"]) == at] for at in places
    }


def shares_of(table: list[dict]) -> list[dict]:
    """How many points of each plane and law have each class."""
    rows = rows_of_planes(table)
    return [
        {
            **{"gamma": gamma, "xi": xi, "law": law, "points": len(here)},
            "kinds": Counter(map(kind_of, here)),
        }
        for (gamma, xi, law), here in planes_of(rows).items()
    ]


def scenes_of(table: list[dict]) -> dict[str, list[dict]]:
    """Rows of each scene, a row a law."""
    rows = [row for row in table if row["of"] == "scene"]
    names = dict.fromkeys(row["place"] for row in rows)
    return {name: [row for row in rows if row["place"] == name] for name in names}


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        scenes = snakemake.params.scenes
        paths = [Path(path) for path in snakemake.input.runs]
        write_table(
            snakemake.output[0],
            [row for path in paths for row in law_rows(path, read(path), scenes)],
        )
