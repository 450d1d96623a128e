# SPDX-License-Identifier: BSD-3-Clause
"""The spring block whose delay falls with its velocity, tau (1 + b)/(v + b); constant as b grows.

Exact: small motions are those with the delay at rest, tau (Cooke and Huang 1996, Proc. Am. Math.
Soc. 124, 1417), so that (5) of docs/method.md is where they neither grow nor decay.
"""

import delaykit as dk
import numpy as np
from delaykit.gallery import show

PUBLISHED = {"growth": (0, 1e-7), "frequency": (0.5, 1e-7)}
LAWS = {"theta": "-v*(theta + (1 + epsilon)*w(t - tau*(1 + b)/(v + b)))", "u": "v - 1"}
MODEL = dk.Model(
    LAWS | {"w": "-gamma**2/v*(u + (theta + w)/xi)"},
    parameters={"tau": 7, "epsilon": 0.7, "xi": 0.5, "gamma": 0.8, "b": 1},
    **{"auxiliary": {"v": "exp(w)"}, "longest_delay": "tau*(1 + b)/b"},
)
START = {"theta": 0, "u": 0, "v": 1.5}


def numbers() -> dict[str, float]:
    """Of maxima of a small motion on the Hopf curve at omega = 1/2, xi = gamma = 0.8."""
    s, start = 0.5j, {"theta": 0, "u": 0, "w": 1e-6}
    ratio = (s**3 + 1.8 * s**2 + 1.44 * s + 0.64) / (0.8 * s)
    at = {"xi": 0.8, "epsilon": abs(ratio) - 1, "tau": -np.angle(ratio) / 0.5}
    events = ["w' = 0 falling"]
    run = MODEL.integrate(start, 300, events=events, t_eval=(), rtol=1e-11, parameters=at)
    time, size = np.diff(run.t_events[0][-2:]).item(), run.y_events[0][-2:, 2]
    return {"growth": np.log(size[1] / size[0]) / time, "frequency": 2 * np.pi / time}


def plot():
    """Maxima of v over b: the paper's chaos (Fig. 5b) becomes a cycle."""
    runs = {"state": "v", "history": START, "t_end": 600, "t_transient": 400, "rtol": 1e-7}
    found = MODEL.scan("maxima", b=np.geomspace(5, 500, 24), progress=False, **runs)
    dk.plot(found).set_xscale("log")


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
