# SPDX-License-Identifier: BSD-3-Clause
"""Duffing's oscillator with delayed feedback: Yanchuk and Perlikowski (2009), PRE 79, 046221.

Published: special points of the Hopf curves, by the demonstration "minimal_demo" of DDE-BIFTOOL.
"""

import delaykit as dk
from delaykit.gallery import show

PUBLISHED = {
    **{"double Hopf b": (0.354445, 5e-7), "double Hopf tau": (8.72874, 5e-6)},
    **{"theta": (-2.6394, 5e-5), "delta": (-1.5155, 5e-5), "l2 of the first": (-0.71239, 5e-6)},
    **{"generalised Hopf b": (0.036906, 5e-7), "generalised Hopf tau": (14.8348, 5e-5)},
    "l2": (-2.5567, 5e-5),
}
MODEL = dk.Model(
    {"x": "v", "v": "-d*v - a*x - x**3 - b*(x - x(t - tau))"},
    parameters={"tau": 8, "a": 0.5, "b": 0.6, "d": 0.05},
    steady_state={"x": 0, "v": 0},
)
CURVES = {"along": ("tau", "b"), "window": ((0, 20), (0, 0.6))}


def numbers() -> dict[str, float]:
    """Places and normal forms of special points."""
    special = MODEL.hopf(**CURVES).sortby("special_tau")
    double = special.isel(special=special.special_kind == "double_hopf").isel(special=0)
    first, second = (special.special_kind == "generalised_hopf").values.nonzero()[0]
    bautin = special.isel(special=second)
    found = [double.special_b, double.special_tau, double.special_theta, double.special_delta]
    found += [special.special_l2[first], bautin.special_b, bautin.special_tau, bautin.special_l2]
    return dict(zip(PUBLISHED, found, strict=True))


def plot():
    """The Hopf curves; cycles are stable at first where l1 < 0."""
    MODEL.hopf(**CURVES).plot.scatter(x="tau", y="b", hue="l1")


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
