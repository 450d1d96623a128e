"""Second axes with units, above and beside nondimensional ones."""

from matplotlib.axes import Axes
from matplotlib.ticker import EngFormatter, MaxNLocator

TIMES = {"years": 365.25 * 86400.0, "days": 86400.0, "hours": 3600.0, "s": 1.0}
"""Units of time in s, the longest first."""
LEAST_TIMES = 2
"""An axis of time is at least as many units long."""


def add_axis(axes: Axes, scale: float, words: str, unit: str = "") -> None:
    """The values of an axis in another unit: of velocity at the right, else above."""
    to_other = (lambda x: x * scale, lambda x: x / scale)
    if unit == "m/s":
        axis = axes.secondary_yaxis("right", functions=to_other).yaxis
    else:
        axis = axes.secondary_xaxis("top", functions=to_other).xaxis
        axis.set_major_locator(MaxNLocator(3 if unit else 6, steps=[1, 2, 5, 10]))
    axis.set_label_text(words, fontsize=7)
    axis.set_tick_params(labelsize=7)
    axis.labelpad = 2
    if unit:
        axis.set_major_formatter(EngFormatter(unit, sep=" "))


def add_time(axes: Axes, seconds: float) -> None:
    """The axis of time, whose unit has these seconds, in the unit that reads well."""
    start, end = axes.get_xlim()
    longest = max(1.0, seconds * (end - start) / LEAST_TIMES)
    name, unit = next((name, unit) for name, unit in TIMES.items() if unit <= longest)
    add_axis(axes, seconds / unit, f"time ({name})")
