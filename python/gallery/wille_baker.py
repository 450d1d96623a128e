# SPDX-License-Identifier: BSD-3-Clause
"""Wille and Baker (1992), Appl. Numer. Math. 9, 223; example 1 of the tutorial of MATLAB's dde23.

Exact: polynomials on each interval between breaking points.
"""

import delaykit as dk
from delaykit.gallery import show

PUBLISHED = {
    **{"y1(1)": (2, 1e-9), "y2(1)": (696401 / 187500, 1e-9), "y3(1)": (17896711 / 5625000, 1e-9)},
    "y1(5)": (767 / 40, 1e-7),
    **{"y2(5)": (176.42257844738032, 1e-6), "y3(5)": (190.34420193607042, 1e-6)},
}
MODEL = dk.Model({"y1": "y1(t - 1)", "y2": "y1(t - 1) + y2(t - 0.2)", "y3": "y2"})
HISTORY = {"y1": 1, "y2": 1, "y3": 1}


def numbers() -> dict[str, float]:
    """All states at two times."""
    run = MODEL.run(HISTORY, 5, t_eval=[1, 5])
    return {f"{state}({t})": run[state].sel(t=t) for t in (1, 5) for state in HISTORY}


def plot():
    """All states over time."""
    MODEL.run(HISTORY, 5)[list(HISTORY)].to_array("state").plot(x="t", hue="state")


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
