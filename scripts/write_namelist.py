"""Write one namelist group for a Fortran program."""

import os
from pathlib import Path

import f90nml


def write_namelist(path: Path, group: str, values: dict) -> None:
    """Write `values` as namelist group `group`; the file is whole or absent."""
    unfinished = Path(f"{path}.part")
    f90nml.Namelist({group: values}).write(unfinished, force=True)
    os.replace(unfinished, path)


if __name__ == "__main__":
    write_namelist(Path(snakemake.output[0]), snakemake.params.group, dict(snakemake.params.values))
