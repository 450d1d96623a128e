"""Write the namelists of a study, each output its groups."""

from pathlib import Path

from scripts.files.outputs import logged
from scripts.namelists.write_namelist import write_groups


def write_all(paths: dict[str, str], groups: dict[str, dict]) -> None:
    """Write each file with its groups."""
    for name, path in paths.items():
        write_groups(Path(path), groups[name])


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        write_all(dict(snakemake.output.items()), snakemake.params.groups)
