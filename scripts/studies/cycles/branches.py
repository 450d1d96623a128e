"""Branches of cycles in a file of cycles followed along a line."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from scripts.files.inputs import Dataset

NEAREST = 1e-6
"""Share of a branch's length below which two of its points are one to a curve through them."""


@dataclass
class CycleThere:
    """A cycle of a branch at a value of the parameter along the line."""

    branch: int
    unstable: int
    """Multipliers outside of the unit circle"""
    most: float
    """Greatest v"""
    modulus: float
    """The largest of a multiplier but 1, that of the nearest orbit"""


def most_of(cycles: Dataset) -> str:
    """Name of the greatest value of the signal: v_most of the block."""
    return f"{cycles.attrs['signal']}_most"


def cycles_there(cycles: Dataset, place: float) -> list[CycleThere]:
    """All cycles at a value of the parameter, each between two points of its branch."""
    found = []
    for number in range(1, cycles.sizes["branches"] + 1):
        x, most, unstable = branch_of(cycles, number)
        away = x - place
        orbits = cycles.isel(orbit=cycles.branch.values == number)
        for i in np.flatnonzero((away[:-1] * away[1:] <= 0) & (away[:-1] != away[1:])):
            share = away[i] / (away[i] - away[i + 1])
            here = float((1 - share) * most[i] + share * most[i + 1])
            found.append(
                CycleThere(number, int(unstable[i]), here, modulus_at(orbits, place, here))
            )
    return found


def modulus_at(orbits: Dataset, place: float, most: float) -> float:
    """Modulus of the largest multiplier but 1, between the nearest orbit and the next."""
    away = orbits[orbits.attrs["along"]].values - place
    nearest = int(np.hypot(away, orbits[most_of(orbits)].values - most).argmin())
    moduli = np.hypot(orbits.multiplier_real[:, 0], orbits.multiplier_imaginary[:, 0]).values
    for other in (nearest - 1, nearest + 1):
        if 0 <= other < away.size and away[nearest] * away[other] < 0:
            share = away[nearest] / (away[nearest] - away[other])
            return float((1 - share) * moduli[nearest] + share * moduli[other])
    return float(moduli[nearest])


def branch_of(cycles: Dataset, number: int) -> tuple[np.ndarray, ...]:
    """Parameter, greatest v, and between each two points the number of unstable multipliers.

    Special points stand between the orbits where this number changes, so that each part of the
    branch ends at its special point. A closed branch ends at its first orbit.
    """
    along = cycles.attrs["along"]
    orbits = cycles.isel(orbit=cycles.branch.values == number)
    points = cycles.isel(special=cycles.special_branch.values == number)
    x, y = orbits[along].values, orbits[most_of(orbits)].values
    unstable = orbits.unstable.values
    if cycles.branch_ending.values[number - 1] == "closed":
        x, y, unstable = (np.append(values, values[0]) for values in (x, y, unstable))
    between = unstable[:-1].copy()
    inserted = []
    for point in range(points.sizes["special"]):
        here = points.isel(special=point)
        changes = np.flatnonzero(
            (unstable[:-1] == int(here.special_unstable_before))
            & (unstable[1:] == int(here.special_unstable_behind))
        )
        if changes.size:
            place = float(here[f"special_{along}"]), float(here[f"special_{most_of(cycles)}"])
            away = np.hypot(
                (x[changes] - place[0]) / np.ptp(x), (y[changes] - place[1]) / np.ptp(y)
            )
            inserted.append((changes[away.argmin()] + 1, *place, unstable[changes[0] + 1]))
    for before, point_x, point_y, behind in sorted(inserted, reverse=True):
        x, y = np.insert(x, before, point_x), np.insert(y, before, point_y)
        between = np.insert(between, before, behind)
    return x, y, between


def parts_of(cycles: Dataset, steps: int = 1) -> Iterator[tuple[int, np.ndarray, np.ndarray]]:
    """Parts of all branches with the same number of unstable multipliers: this, parameter, v.

    With more steps than one from point to point they are on a smooth curve.
    """
    for number in range(1, cycles.sizes["branches"] + 1):
        x, y, unstable = branch_of(cycles, number)
        if steps > 1 and unstable.size > 1:
            x, y = smooth_curve(x, y, steps)
            unstable = np.repeat(unstable, steps)
        cuts = np.flatnonzero(np.diff(unstable)) + 1
        # a branch of one orbit has no part
        for part in filter(len, np.split(np.arange(unstable.size), cuts)):
            ends = slice(part[0], part[-1] + 2)
            yield int(unstable[part[0]]), x[ends], y[ends]


def smooth_curve(x: np.ndarray, y: np.ndarray, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Points on a curve through all points, so many steps from one to the next.

    It is Akima's modified one along the chords, since cubic splines swing beside a corner: there
    another maximum becomes the greatest.
    """
    # not needed by claims, with which planning loads this module
    from scipy.interpolate import Akima1DInterpolator

    extent = np.array([np.ptp(x) or 1.0, np.ptp(y) or 1.0])
    along = np.cumsum(np.hypot(*(np.diff([x, y], prepend=[x[:1], y[:1]]).T / extent).T))
    apart = np.diff(along, prepend=-np.inf) > NEAREST * along[-1]
    shares = np.arange(steps * (along.size - 1) + 1) / steps
    fine = np.interp(shares, np.arange(along.size), along)
    curve = Akima1DInterpolator(along[apart], np.array([x, y]).T[apart], method="makima")
    return tuple(curve(np.minimum(fine, along[apart][-1])).T)
