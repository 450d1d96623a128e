# SPDX-License-Identifier: BSD-3-Clause
"""An infection: Hairer, Norsett and Wanner (1993), Solving ODEs I, section II.17.

Published: values at t = 40. Exact: y1 + y2 + y3 stays 6.1.
"""

import delaykit as dk
from delaykit.gallery import show

PUBLISHED = {
    **{"y1": (0.0912491205664, 1e-8), "y2": (0.0202995003351, 1e-8), "y3": (5.9884513791, 1e-8)},
    "sum": (6.1, 1e-12),
}
MODEL = dk.Model(
    {
        "y1": "-y1*y2(t - 1) + y2(t - 10)",
        "y2": "y1*y2(t - 1) - y2",
        "y3": "y2 - y2(t - 10)",
    },
    states={"y1": "susceptible", "y2": "infected", "y3": "immune"},
)
HISTORY = {"y1": 5, "y2": 0.1, "y3": 1}


def numbers() -> dict[str, float]:
    """All states at the end."""
    end = MODEL.run(HISTORY, 40, t_eval=[40]).isel(t=0)
    return {**{state: end[state] for state in HISTORY}, "sum": sum(end[state] for state in HISTORY)}


def plot():
    """All states over time."""
    MODEL.run(HISTORY, 40)[list(HISTORY)].to_array("state").plot(x="t", hue="state")


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
