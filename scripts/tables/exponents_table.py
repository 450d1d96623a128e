"""The table of exponents: each scene, each of its runs, each exponent with its error bar."""

import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.namelists.laws import law_of


def rows_of(run: xr.Dataset) -> list[dict]:
    """Rows of a scene, those by its own tolerance alone first."""
    return [
        {
            "scene": run.attrs["scene"],
            "law": law_of(run.attrs),
            "i": i + 1,
            "exponent": float(at.value[i]),
            "error": float(at.error[i]),
            "sign": sign(float(at.value[i]), float(at.sign_bound[i])),
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


def sign(value: float, bound: float) -> str:
    """The sign of an exponent; zero if its modulus is at most `bound`."""
    if abs(value) <= bound:
        return "zero"
    return "positive" if value > 0 else "negative"


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        table = [row for path in snakemake.input.runs for row in rows_of(read(path))]
        write_table(snakemake.output[0], table)
