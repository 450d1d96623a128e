"""What the blocks of a chain do: alike or not, and which modes move."""

import numpy as np

from scripts.files.inputs import DataArray, Dataset

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
