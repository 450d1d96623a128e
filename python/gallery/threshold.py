# SPDX-License-Identifier: BSD-3-Clause
"""A delay of the state: Cooke and Huang (1996), Proc. Am. Math. Soc. 124, 1417.

Exact: small motions are those with the delay frozen at rest, s = -a exp(-s).
"""

import delaykit as dk
import numpy as np
from delaykit.gallery import show

# Lambert's function W(-a), its principal branch
PUBLISHED = {
    **{"growth, a = 1.6": (0.0131136694742, 1e-7), "frequency, a = 1.6": (1.5791006536879, 1e-7)},
    **{"growth, a = 1.4": (-0.0817036609941, 1e-6), "frequency, a = 1.4": (1.5169892232740, 1e-6)},
}
MODEL = dk.Model({"x": "-a*x(t - 1 - c*tanh(x))"}, {"a": 1.6, "c": 0.5})


def numbers() -> dict[str, float]:
    """Of maxima in motions of 1e-6."""
    found = {}
    for a in (1.6, 1.4):
        run = MODEL.integrate(
            1e-6, 60, events=["x' = 0 falling"], t_eval=(), rtol=1e-11, parameters={"a": a}
        )
        time, size = np.diff(run.t_events[0][9:11]).item(), run.y_events[0][9:11, 0]
        found[f"growth, a = {a}"] = np.log(size[1] / size[0]) / time
        found[f"frequency, a = {a}"] = 2 * np.pi / time
    return found


def plot():
    """A large motion."""
    MODEL.run(0.1, 400).x.plot()


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
