# SPDX-License-Identifier: BSD-3-Clause
"""A laser with feedback: Lang and Kobayashi (1980), IEEE J. Quantum Electron. 16, 347.

Parameters: demonstration "rotsym" of DDE-BIFTOOL. Exact: E = R exp(i omega t), fed back at a phase
psi, has n = -eta cos psi, R**2 = (p - n)/(2 n + 1), omega = eta (sin psi - alpha cos psi); one root
is 0 by symmetry. At eta = 0 others solve s**2 + epsilon (1 + 2 p) s + 2 epsilon p = 0.
"""

import delaykit as dk
import numpy as np
from delaykit.gallery import show

PUBLISHED = {"n": (-0.005, 1e-8), "R**2": (0.105 / 0.99, 1e-8), "least root": (0, 1e-9)}
PUBLISHED |= {"turn": (0, 1e-8), "relaxation": ((0.001 - 0.003**2) ** 0.5, 1e-9)}
COUPLED = "eta*(cos(psi)*{0}(t - tau) {1} sin(psi)*{2}(t - tau))"
N, START = "-eta*cos(psi)", {"x": 0.3, "y": 0, "n": 0}
MODEL = dk.Model(
    {"x": "n*x - (alpha*n - omega)*y + " + COUPLED.format("x", "-", "y"),
     "y": "n*y + (alpha*n - omega)*x + " + COUPLED.format("y", "+", "x"),
     "n": "epsilon*(p - n - (2*n + 1)*(x**2 + y**2))"},
    parameters={"p": 0.1, "alpha": 4, "epsilon": 5e-3, "eta": 5e-3, "tau": 100, "psi": 0},
    definitions={"omega": "eta*(sin(psi) - alpha*cos(psi))"},
    steady_state={"n": N, "y": 0, "x": f"sqrt((p - ({N}))/(1 + 2*({N})))"},
)  # fmt: skip


def numbers() -> dict[str, float]:
    """The mode with psi = 0, reached by a run in a frame that turns with omega, and roots."""
    x, y, n = MODEL.integrate(START, 5000, t_eval=[4900, 5000]).y
    symmetry, free = MODEL.roots(-0.01), MODEL.roots(-0.01, parameters={"eta": 0})
    found = [n[1], x[1] ** 2 + y[1] ** 2, abs(symmetry).min(), np.diff(np.arctan2(y, x))[0]]
    return dict(zip(PUBLISHED, [*found, free.imag.max()], strict=True))


def plot():
    """The carriers over time."""
    MODEL.run(START, 5000).n.plot()


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
