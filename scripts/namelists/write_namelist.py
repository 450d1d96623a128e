"""Write the namelist of a Fortran program."""

from pathlib import Path

import f90nml

from scripts.files.outputs import logged, written


def write_namelist(path: Path, groups: dict[str, dict]) -> None:
    """Write groups of values; the file is whole or absent.

    A program reads them from one namelist group, &settings: there a key is `group%key`.
    """
    with written(path) as unfinished:
        f90nml.Namelist({"settings": groups}).write(unfinished, force=True)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        write_namelist(Path(snakemake.output[0]), snakemake.params.groups)
