"""What chains of blocks do: whether they move alike, which modes move, exponents."""

import math

import numpy as np

from scripts.files.inputs import DataArray, Dataset, read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.models.models import PARAMETERS
from scripts.models.records import law_of
from scripts.tables.exponent_signs import SIGNS

ALIKE = 1e-6
"""Blocks that are nearer to each other than this in ln v move alike; nearer to 0, they rest."""


def late(chain: Dataset) -> DataArray:
    """ln v after the transient, shape (t, block)."""
    return np.log(chain.v.sel(t=slice(chain.attrs["t_transient"], None)))


def first_mode(chain: Dataset) -> int:
    """The number of the first mode: 0 is the mean of the blocks, which `plate` has not."""
    return int(chain.attrs["ends"] == "plate")


def powers_of(chain: Dataset) -> np.ndarray:
    """Mean squares over time of the modes of ln v, with modes of norm 1."""
    from scipy.fft import dct, dst, rfft  # not when claims are planned

    values = late(chain).values
    if chain.attrs["ends"] == "free":
        modes = dct(values, type=2, norm="ortho")
    elif chain.attrs["ends"] == "ring":
        modes = np.abs(rfft(values, norm="ortho"))
    else:
        modes = dst(values, type=1, norm="ortho")
    return (modes**2).mean(axis=0)


def rests(chain: Dataset) -> bool:
    """Whether all blocks come to rest."""
    return float(np.abs(late(chain)).max()) < ALIKE


def moves_alike(chain: Dataset) -> bool:
    """Whether all blocks move alike, or rest."""
    return float(late(chain).std("block").max()) < ALIKE


def strongest_mode(chain: Dataset) -> tuple[int, float]:
    """The number of the strongest mode beside the mean, and the share of all these modes."""
    powers, first = powers_of(chain), first_mode(chain)
    spatial = powers[1 - first :]
    return 1 + int(spatial.argmax()), float(spatial.sum() / powers.sum())


def motion_row(trajectory: Dataset, exponents: Dataset) -> dict:
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
