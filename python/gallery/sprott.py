# SPDX-License-Identifier: BSD-3-Clause
"""A simple chaotic delay equation: Sprott (2007), Phys. Lett. A 366, 397.

Exact: a Hopf point at tau = pi/2, omega = 1. A cycle with x(t - 2 tau) = -x(t) has the period 4 tau
(Kaplan and Yorke 1974, J. Math. Anal. Appl. 48, 317); it loses this symmetry at a branch point.
"""

import delaykit as dk
from delaykit.gallery import show

PUBLISHED = {
    **{"Hopf tau": (3.141592653589793 / 2, 1e-9), "omega": (1, 1e-9)},
    **{"period/tau": (4, 1e-9), "branch points": (1, 0)},
}
MODEL = dk.Model({"x": "-sin(x(t - tau))"}, {"tau": 5}, steady_state={"x": 0})


def numbers() -> dict[str, float]:
    """The cycles along tau; of period/tau the value farthest from 4."""
    line = MODEL.cycle(None, "tau", (0.5, 6))
    ratio = line.period / line.tau
    return {
        **{"Hopf tau": line.hopf_tau[0], "omega": line.hopf_omega[0]},
        "period/tau": ratio[abs(ratio - 4).values.argmax()],
        "branch points": sum(line.special_kind == "branching"),
    }


def plot():
    """Maxima over tau."""
    MODEL.scan(tau=[4 + k / 100 for k in range(120)], history=1, progress=False).maxima.plot.line(
        "k,", x="tau", add_legend=False
    )


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
