"""How events repeat, and how the block sticks and slips, for claims about them."""

import numpy as np

from scripts.files.inputs import Dataset

FEWEST = 100
"""Events that a statement about their distribution needs."""
LONGEST_REPEAT = 100
"""Largest number of events after which a repetition is looked for."""
PERIODIC = 1e-3
"""Recurrence times repeat if they return to within this share of their mean."""


def spread(times: np.ndarray) -> float:
    """By how much the longest time is longer than the shortest, over the mean."""
    return float(np.ptp(times) / times.mean())


def best_repeat(times: np.ndarray) -> tuple[int, float]:
    """After how many events times repeat best, and the rms of the differences over the mean."""
    after = range(1, min(LONGEST_REPEAT, times.size // 2) + 1)
    left = [np.sqrt(np.mean((times[m:] - times[:-m]) ** 2)) / times.mean() for m in after]
    # the first of those that are equal but for rounding and tolerance
    best = next(m for m, size in zip(after, left, strict=True) if size <= max(min(left), PERIODIC))
    return best, float(left[best - 1])


def stick_slip(events: Dataset, ratio: float) -> dict:
    """The factor that v spans in the median event, the share of events in which it spans the ratio,
    and the share of the time in which the block is slower than the plate."""
    spans = events.peak_velocity.values / events.least_velocity.values
    if not spans.size:
        return {"events": events, "median": 0.0, "large": 0.0, "slower": 0.0}
    slower = 1 - float(events.duration.sum() / events.recurrence_time.sum())
    large = float((spans >= ratio).mean())
    return {"events": events, "median": float(np.median(spans)), "large": large, "slower": slower}
