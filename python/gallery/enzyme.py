# SPDX-License-Identifier: BSD-3-Clause
"""Enzyme kinetics: Hairer, Norsett and Wanner (1993), II.17, and the test set of RADAR5.

Published: values at t = 160.
"""

import delaykit as dk
from delaykit.gallery import show

PUBLISHED = {
    **{"y1": (33.92579471114, 1e-6), "y2": (22.70653713103, 1e-6)},
    **{"y3": (18.83057673173, 1e-6), "y4": (22.26599078770, 1e-6)},
}
MODEL = dk.Model(
    {"y1": "10.5 - flow", "y2": "flow - y2", "y3": "y2 - y3", "y4": "y3 - y4/2"},
    definitions={"flow": "y1/(1 + 0.0005*y4(t - 4)**3)"},
)
HISTORY = {"y1": 60, "y2": 10, "y3": 10, "y4": 20}


def numbers() -> dict[str, float]:
    """All states at the end."""
    end = MODEL.run(HISTORY, 160, t_eval=[160]).isel(t=0)
    return {state: end[state] for state in HISTORY}


def plot():
    """All states over time."""
    MODEL.run(HISTORY, 160)[list(HISTORY)].to_array("state").plot(x="t", hue="state")


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
