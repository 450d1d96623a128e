# SPDX-License-Identifier: BSD-3-Clause
"""A block on a belt of speed V, with dry friction F at rest and f < F in motion.

Exact: it sticks until k x = F. With w = sqrt(k/m), u = x - f/k it slips, u = (F - f)/k cos(w t)
+ V/w sin(w t), until v = V again, at u = -(F - f)/k.
"""

import math

import delaykit as dk
from delaykit.gallery import show

K, M, V, F, SLIDE = 4.0, 1.0, 0.5, 1.0, 0.6
MODEL = dk.Model(
    {"x": "v", "v": "slips*(f - k*x)/m", "slips": "0"},
    {"k": K, "m": M, "V": V, "F": F, "f": SLIDE},
    events=[
        {"when": "k*x = F rising", "set": {"slips": 1}},
        {"when": "v = V rising", "set": {"slips": 0, "v": "V"}},
    ],
)
OVER, RATE = (F - SLIDE) / K, math.sqrt(K / M)
PUBLISHED = {
    "slip": (2 / RATE * (math.pi - math.atan(RATE * OVER / V)), 1e-8),
    "stick": (2 * OVER / V, 1e-8),
}
START = {"x": 0, "v": V, "slips": 0}


def numbers() -> dict[str, float]:
    """Times of the fifth slip, and before it."""
    begins, ends = MODEL.integrate(START, 20).t_events
    return {"slip": ends[4] - begins[4], "stick": begins[4] - ends[3]}


def plot():
    MODEL.run(START, 10, samples_per_step=20).v.plot()


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
