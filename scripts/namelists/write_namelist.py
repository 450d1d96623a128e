"""Write namelist groups for a Fortran program."""

from pathlib import Path

import f90nml

from scripts.files.outputs import logged, written


def write_namelist(path: Path, group: str, values: dict) -> None:
    """Write `values` as namelist group `group`; the file is whole or absent."""
    write_groups(path, {group: values})


def write_groups(path: Path, groups: dict[str, dict]) -> None:
    """Write several groups into one file, which is whole or absent."""
    with written(path) as unfinished:
        f90nml.Namelist(groups).write(unfinished, force=True)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        group, values = snakemake.params.group, dict(snakemake.params.values)
        write_namelist(Path(snakemake.output[0]), group, values)
