"""Write namelist groups for a Fortran program."""

from pathlib import Path

import f90nml

from scripts.files.outputs import logged, written
from scripts.files.tsv import read_table


def write_groups(path: Path, groups: dict[str, dict]) -> None:
    """Write groups into one file, which is complete or absent."""
    with written(path) as unfinished:
        f90nml.Namelist(groups).write(unfinished, force=True)


def end_at_horizons(groups: dict[str, dict], rows: list[dict]) -> dict[str, dict]:
    """Cases that end at the times up to which runs can be compared, given by rows of a table."""
    horizons = {row["scene"]: row["horizon"] for row in rows}
    cases = groups["cases_list"]
    return {**groups, "cases_list": {**cases, "t_end": [horizons[name] for name in cases["name"]]}}


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        groups = snakemake.params.groups
        if snakemake.input.get("horizons"):
            groups = end_at_horizons(groups, read_table(snakemake.input.horizons))
        write_groups(Path(snakemake.output[0]), groups)
