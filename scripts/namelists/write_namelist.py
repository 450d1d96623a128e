"""Write the namelist of a Fortran program."""

from pathlib import Path

import f90nml

from scripts.files.outputs import logged, written
from scripts.files.tsv import read_table

BLOCKS = "blocks"
"""The group with a list for each quantity of the blocks of a chain."""


def write_namelist(path: Path, groups: dict[str, dict]) -> None:
    """Write groups of values; the file is complete or absent.

    A program reads them from one namelist group, &settings: there a key is `group%key`. Lists of
    a chain's blocks are a namelist group of their own.
    """
    lists = {BLOCKS: groups[BLOCKS]} if BLOCKS in groups else {}
    settings = {key: value for key, value in groups.items() if key not in lists}
    with written(path) as unfinished:
        f90nml.Namelist({"settings": settings, **lists}).write(unfinished, force=True)


def end_at_horizons(groups: dict[str, dict], rows: list[dict]) -> dict[str, dict]:
    """Cases that end at the times up to which runs can be compared, given by rows of a table."""
    horizons = {row["scene"]: row["horizon"] for row in rows}
    cases = [{**case, "t_end": horizons[case["name"]]} for case in groups["cases"]]
    return {**groups, "cases": cases}


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        groups = snakemake.params.groups
        if snakemake.input.get("horizons"):
            groups = end_at_horizons(groups, read_table(snakemake.input.horizons))
        write_namelist(Path(snakemake.output[0]), groups)
