"""Write namelist groups for a Fortran program."""

import os
from pathlib import Path

import f90nml


def write_namelist(path: Path, group: str, values: dict) -> None:
    """Write `values` as namelist group `group`; the file is whole or absent."""
    write_groups(path, {group: values})


def write_groups(path: Path, groups: dict[str, dict]) -> None:
    """Write several groups into one file, which is whole or absent."""
    unfinished = Path(f"{path}.part")
    f90nml.Namelist(groups).write(unfinished, force=True)
    os.replace(unfinished, path)


if __name__ == "__main__":
    write_namelist(Path(snakemake.output[0]), snakemake.params.group, dict(snakemake.params.values))
