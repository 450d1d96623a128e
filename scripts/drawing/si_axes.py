"""Second axes with units, above and beside nondimensional ones."""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

TIMES = {"years": 365.25 * 86400.0, "days": 86400.0, "hours": 3600.0, "s": 1.0}
"""Units of time in s, the longest first."""
LEAST_TIMES = 2
"""An axis of time is at least as many units long."""
MOST_TICKS = 6
"""So many numbers of five digits fit above a panel of half a page."""
LARGEST_PLAIN = 2
"""Powers of ten up to this one, and down to its inverse, are in the numbers, not in the label."""


def add_axis(axes: Axes, scale: float, words: str, side: str = "top") -> None:
    """The values of an axis in another unit, on the other side of the panel."""
    to_other = (lambda x: x * scale, lambda x: x / scale)
    upright = side == "right"
    other = (axes.secondary_yaxis if upright else axes.secondary_xaxis)(side, functions=to_other)
    (other.set_ylabel if upright else other.set_xlabel)(words, fontsize=7, labelpad=2)
    other.tick_params(labelsize=7)
    if not upright:
        other.xaxis.set_major_locator(MaxNLocator(MOST_TICKS))


def add_time(axes: Axes, seconds: float) -> None:
    """The axis of time, whose unit has these seconds, in the unit that reads well."""
    start, end = axes.get_xlim()
    longest = max(1.0, seconds * (end - start) / LEAST_TIMES)
    name, unit = next((name, unit) for name, unit in TIMES.items() if unit <= longest)
    add_axis(axes, seconds / unit, f"time ({name})")


def add_scaled(axes: Axes, scale: float, name: str, unit: str, side: str = "top") -> None:
    """An axis in a unit of SI; if it is linear, a power of ten is in the label."""
    axis = axes.yaxis if side == "right" else axes.xaxis
    power = math.floor(math.log10(scale * np.abs(axis.get_view_interval()).max()))
    if abs(power) <= LARGEST_PLAIN or axis.get_scale() == "log":
        add_axis(axes, scale, f"{name} ({unit})", side)
    else:
        add_axis(axes, scale / 10.0**power, f"{name} ($10^{{{power}}}$ {unit})", side)
