# SPDX-License-Identifier: BSD-3-Clause
"""Two neurons: Shayer and Campbell (2000), SIAM J. Appl. Math. 61, 673.

Published: the demonstration "neuron" of DDE-BIFTOOL: cycles from Hopf point to a homoclinic orbit.
"""

import delaykit as dk
import numpy as np
from delaykit.gallery import show

PUBLISHED = {
    **{"Hopf a21": (0.8071232250, 1e-9), "omega": (0.7819651621, 1e-9), "l1": (-0.39615712, 1e-8)},
    **{"period at 0.8072": (8.0354, 3e-4), "folds": (1, 0), "homoclinic": (2.34595, 1e-4)},
    **{"double Hopf a21": (0.2072962626, 5e-9), "double Hopf tau_s": (8.6340742187, 1e-8)},
}
RATE = "-x{0}/2 - tanh(x{0}(t - tau_s)) + a{0}{1}*tanh(x{1}(t - 0.2))"
EQUATIONS = {"x1": RATE.format(1, 2), "x2": RATE.format(2, 1)}
MODEL = dk.Model(EQUATIONS, {"a12": 1, "a21": 1, "tau_s": 1.5}, steady_state={"x1": 0, "x2": 0})


def numbers() -> dict[str, float]:
    """The Hopf points, and the cycles along a21."""
    here = MODEL.hopf(("a21", "tau_s"), ((0.807, 0.8072), (1.5 - 1e-9, 1.5 + 1e-9)))
    double = MODEL.hopf(("a21", "tau_s"), ((0, 1), (8, 9)))
    line = MODEL.cycle(None, "a21", (0, 3), longest_period=125)
    late = line.isel(orbit=slice(int(line.a21.values.argmax()), None))
    a, b, c = np.interp([100, 110, 120], late.period, late.a21)
    found = [line.hopf_a21[0], line.hopf_omega[0], here.l1.mean()]
    early = [line.hopf_a21[0], line.a21[0]], [2 * np.pi / line.hopf_omega[0], line.period[0]]
    found += [np.interp(0.8072, *early), sum(line.special_kind == "fold")]
    found += [c - (c - b) ** 2 / (c - 2 * b + a), double.special_a21[0], double.special_tau_s[0]]
    return dict(zip(PUBLISHED, found, strict=True))


def plot():
    """Periods of the cycles."""
    MODEL.cycle(None, "a21", (0, 3)).plot.scatter(x="a21", y="period")


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
