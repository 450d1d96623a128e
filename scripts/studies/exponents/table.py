"""The table of exponents: each scene, each of its runs, each exponent with its error bar."""

from scripts.files.inputs import Dataset, read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.models.records import law_of
from scripts.tables.exponent_signs import SIGNS


def rows_of(run: Dataset) -> list[dict]:
    """Rows of a scene, those by its own tolerance alone first."""
    return [
        {
            "scene": run.attrs["scene"],
            "law": law_of(run.attrs),
            "i": i + 1,
            "exponent": float(at.value[i]),
            "error": float(at.error[i]),
            "sign": SIGNS[int(at.sign[i])],
            "dimension": float(at.dimension),
            "dimension_error": float(at.dimension_error),
            "t": run.attrs["t_end"] - run.attrs["t_begin"],
            "tolerance": float(at.tolerance),
            "longest_step": float(at.longest_step),
            "mean_step": float(at.mean_step),
        }
        for at in (run.isel(run=k) for k in range(run.sizes["run"]))
        for i in range(run.sizes["exponent"])
    ]


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        table = [row for path in snakemake.input.runs for row in rows_of(read(path))]
        write_table(snakemake.output[0], table)
