# SPDX-License-Identifier: BSD-3-Clause
"""The paper's spring block with delayed friction; w = ln v, nondimensional (docs/method.md).

Exact: (5) on Hopf curves; without delay epsilon = omega**2 = gamma**2 xi/(xi + gamma**2) (Rice and
Ruina 1983, J. Appl. Mech. 50, 343); at large gamma, which is stiff, with epsilon = xi and no delay
a conserved quantity. Fig. 5a is a cycle, so one exponent is zero (docs/findings.md).
"""

import delaykit as dk
import numpy as np
from delaykit.gallery import show

PUBLISHED = {"(5)": (0, 1e-9), "omega": (4 / 45**0.5, 1e-9), "drift": (0, 1e-8), "zeros": (1, 0)}
LAWS = {"theta": "-v*(theta + (1 + epsilon)*w(t - tau))", "u": "expm1(w)"}
MODEL = dk.Model(
    LAWS | {"w": "-gamma**2/v*(u + (theta + w)/xi)"},
    parameters={"tau": 10, "epsilon": 0.5, "xi": 0.8, "gamma": 0.8},
    **{"auxiliary": {"v": "exp(w)"}, "steady_state": {"theta": 0, "u": 0, "w": 0}, "fast": "w"},
)


def numbers() -> dict[str, float]:
    """The curves, the point without delay, a motion at gamma = 1e5, and the exponents."""
    hopf = MODEL.hopf(("tau", "epsilon"), ((0, 12), (0.05, 1.5)))
    s, delayed = 1j * hopf.omega, (1 + hopf.epsilon) * np.exp(-1j * hopf.omega * hopf.tau)
    errors = abs(s**3 + 1.8 * s**2 + 1.44 * s + 0.64 - 0.8 * s * delayed)
    onset = MODEL.roots(-0.1, parameters={"tau": 0, "epsilon": 16 / 45}).imag.max()
    stiff = {"tau": 0, "epsilon": 0.8, "gamma": 1e5}
    run = MODEL.run({"theta": -0.5, "u": 0, "w": 0.5}, 20, parameters=stiff)
    kept = np.exp(-0.8 * run.u) * (2.25 + run.u - run.w - 1 / run.v)
    zeros = sum(MODEL.attractor({"theta": 0, "u": 0, "v": 1.5}).sign == 0)
    return dict(zip(PUBLISHED, [errors.max(), onset, kept.max() - kept.min(), zeros], strict=True))


def plot():
    """The velocity over time."""
    MODEL.run({"theta": 0, "u": 0, "v": 1.5}, 200).v.plot()


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
