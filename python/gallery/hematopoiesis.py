# SPDX-License-Identifier: BSD-3-Clause
"""Stem cells at rest: Mackey (1978), Blood 51, 941; rates per day, s in units of theta.

Exact: a pair of roots is imaginary where cos(omega tau) = (delta + slope)/(2 exp(-gamma tau) slope)
and sin(omega tau) = -omega/(2 exp(-gamma tau) slope), with the slope of s beta(s) at rest.
"""

import delaykit as dk
import numpy as np
from delaykit.gallery import show

PUBLISHED = {"error of cos": (0, 1e-9), "error of sin": (0, 1e-9)}
AGAIN = "beta0*s{0}/(1 + s{0}**n)"
MODEL = dk.Model(
    {"s": f"-delta*s - {AGAIN.format('')} + 2*exp(-gamma*tau)*{AGAIN.format('(t - tau)')}"},
    parameters={"beta0": 1.77, "n": 3, "delta": 0.05, "gamma": 0.2, "tau": 2.2},
    steady_state={"s": "(beta0*(2*exp(-gamma*tau) - 1)/delta - 1)**(1/n)"},
)
CURVES = {"along": ("gamma", "n"), "window": ((0.01, 0.3), (1.5, 6))}


def numbers() -> dict[str, float]:
    """The largest errors on the Hopf curves in the plane of gamma and n."""
    found = MODEL.hopf(**CURVES)
    twice = 2 * np.exp(-found.gamma * 2.2)
    power = 1.77 * (twice - 1) / 0.05 - 1
    slope = 1.77 * (1 + (1 - found.n) * power) / (1 + power) ** 2
    cos, sin = (0.05 + slope) / twice / slope, -found.omega / twice / slope
    return {
        "error of cos": abs(np.cos(2.2 * found.omega) - cos).max(),
        "error of sin": abs(np.sin(2.2 * found.omega) - sin).max(),
    }


def plot():
    """The Hopf curves; below 0 cycles are stable at first."""
    MODEL.hopf(**CURVES).plot.scatter(x="gamma", y="n", hue="l1")


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
