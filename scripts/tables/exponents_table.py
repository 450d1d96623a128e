"""The table of exponents: each scene, each of its runs, each exponent with its error bar."""

from scripts.files.inputs import Dataset, read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.namelists.laws import law_of

SIGNS = {1: "positive", 0: "zero", -1: "negative", 2: "unclear"}
"""Of exponents in files, with their words; unclear are those that may be zero."""


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


def count_in_words(counts: dict[str, float]) -> str:
    """How many exponents are positive and zero, and of how many the sign is unclear, if any."""
    said = [word for word in ("positive", "zero", "unclear") if counts[word] or word != "unclear"]
    return ", ".join(f"{counts[word]:g} {word}" for word in said)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        table = [row for path in snakemake.input.runs for row in rows_of(read(path))]
        write_table(snakemake.output[0], table)
