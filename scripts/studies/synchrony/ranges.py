"""At which stiffness of modes disturbances grow, and up to how many blocks a chain moves as one."""

import math

import xarray as xr


def has_multipliers(one: xr.Dataset) -> bool:
    """Whether the motion is a cycle of which Floquet multipliers were found."""
    return one.sizes["floquet_s"] > 0


def growing_ranges(one: xr.Dataset) -> list[tuple[float, float]]:
    """Ranges of s in which disturbances grow, by multipliers where there are any.

    Beyond the largest s that was tried all is as there.
    """
    kind = "floquet_" if has_multipliers(one) else ""
    zeros = one[f"{kind}zero_s"].values.tolist()
    rises = one[f"{kind}zero_rises"].values.astype(bool).tolist()
    grows = [not rises[0] if zeros else float(one[f"{kind}exponent"][-1]) > 0, *rises]
    ends = [1.0, *zeros, math.inf]
    return [(ends[i], ends[i + 1]) for i, up in enumerate(grows) if up]


def undecided_range(one: xr.Dataset) -> tuple[float, float] | None:
    """The s between which the sign is not known, of a motion without multipliers, if there are any.

    There the exponent is within three standard errors of 0.
    """
    unsure = one.s.values[abs(one.exponent.values) < 3 * one.error.values]
    if has_multipliers(one) or not unsure.size:
        return None
    return float(unsure.min()), float(unsure.max())


def undecided_blocks(one: xr.Dataset, kappa: float, most: int) -> list[int]:
    """Numbers of blocks with free ends, up to the most, of which no mode is known to grow, and the
    sign of one is not known."""
    between = undecided_range(one)
    if between is None:
        return []
    sure = [(low, between[0]) for low, _ in growing_ranges(one) if low < between[0]]
    found = []
    for blocks in range(2, most + 1):
        modes = stiffness_of_modes(blocks, kappa)
        grows = any(low < s < high for s in modes for low, high in sure)
        if not grows and any(between[0] <= s <= between[1] for s in modes):
            found.append(blocks)
    return found


def stiffness_of_modes(blocks: int, kappa: float) -> list[float]:
    """The s of the modes of a chain with free ends but that in which all blocks move alike."""
    angles = [math.pi * mode / blocks for mode in range(1, blocks)]
    return [1 + kappa * round(4 * math.sin(angle / 2) ** 2, 12) for angle in angles]


def largest_alike(ranges: list[tuple[float, float]], kappa: float) -> int | None:
    """The largest number of blocks with free ends of which no mode has s in a range; None: any.

    Mode m has s = 1 + 4 kappa sin^2(x/2) at x = pi m/N. If the distance pi/N is less than the
    width of a range in x, the range has a mode.
    """

    def place(s: float) -> float:
        return 2 * math.asin(math.sqrt(min((s - 1) / (4 * kappa), 1)))

    widest = max((place(high) - place(low) for low, high in ranges), default=0.0)
    if widest == 0:
        return None
    for blocks in range(math.floor(math.pi / widest) + 1, 1, -1):
        modes = stiffness_of_modes(blocks, kappa)
        if not any(low < s < high for s in modes for low, high in ranges):
            return blocks
    return 1
