"""Write the namelist of a scene's measured runs, which end where trust does."""

from pathlib import Path

from scripts.files.outputs import logged
from scripts.files.tsv import read_table
from scripts.namelists.program_groups import work_precision_groups
from scripts.namelists.write_namelist import write_namelist


def horizon_of(rows: list[dict], scene: str) -> float:
    """Time up to which a scene can be trusted."""
    (horizon,) = [row["horizon"] for row in rows if row["scene"] == scene]
    return horizon


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        scene = snakemake.wildcards.work_scene
        t_end = horizon_of(read_table(snakemake.input.horizons), scene)
        groups = work_precision_groups(snakemake.params.config, scene, t_end)
        write_namelist(Path(snakemake.output[0]), groups)
