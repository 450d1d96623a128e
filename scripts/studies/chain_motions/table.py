"""What chains of blocks do: whether they move alike, which modes move, exponents."""

import math

import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.namelists.laws import law_of
from scripts.namelists.parameters import PARAMETERS
from scripts.tables.chain_motions import moves_alike, rests, strongest_mode
from scripts.tables.exponent_signs import SIGNS


def motion_row(trajectory: xr.Dataset, exponents: xr.Dataset) -> dict:
    """The motion of a chain; all its exponents in one cell, the largest first."""
    run = exponents.isel(run=0)
    values, errors = run.value.values, run.error.values
    signs = [SIGNS[int(sign)] for sign in run.sign.values]
    alike = moves_alike(trajectory)
    mode, share = (math.nan, 0.0) if alike else strongest_mode(trajectory)
    return {
        "chain": trajectory.attrs["scene"],
        **{key: trajectory.attrs[key] for key in ("blocks", "kappa", "ends", *PARAMETERS)},
        "law": law_of(trajectory.attrs),
        "motion": motion_of(rests(trajectory), alike, signs),
        "mode": mode,
        "share": share,
        **{f"{word}_exponents": signs.count(word) for word in SIGNS.values()},
        "largest": float(values[0]),
        "largest_error": float(errors[0]),
        "exponents": " ".join(f"{value:.5f}" for value in values),
        "errors": " ".join(f"{error:.5f}" for error in errors),
        "time": exponents.attrs["t_end"] - exponents.attrs["t_begin"],
    }


def motion_of(rest: bool, alike: bool, signs: list[str]) -> str:
    """The motion in words: whether the blocks move alike, and whether an exponent is positive."""
    if rest:
        return "rest"
    kind = "synchronous" if alike else "pattern"
    return f"{kind}, chaotic" if "positive" in signs else kind


def exponents_of(row: dict) -> list[float]:
    """All exponents of a row."""
    return [float(value) for value in row["exponents"].split()]


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        runs = zip(snakemake.input.trajectories, snakemake.input.exponents, strict=True)
        write_table(snakemake.output[0], [motion_row(read(one), read(two)) for one, two in runs])
