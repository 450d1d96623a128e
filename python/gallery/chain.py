# SPDX-License-Identifier: BSD-3-Clause
"""Spring blocks in a row with free ends, joined by springs (docs/chains.md).

Exact: mode m of N blocks, cos(pi m (j - 1/2)/N), moves as one block with gamma**2 and xi times
s = 1 + 4 kappa sin(pi m/(2 N))**2. On a Hopf curve of this block a small mode is periodic.
"""

import delaykit as dk
import numpy as np
from delaykit.gallery import show

PUBLISHED = {"u after half a period": (-1, 1e-6), "after two periods": (1, 1e-6)}
XI, SQUARE, KAPPA, OMEGA, N, MODE = 0.8, 0.64, 0.7, 0.5, 6, 2
S = 1 + 4 * KAPPA * np.sin(np.pi * MODE / (2 * N)) ** 2
POINT = (1 + 1j * XI * (S - OMEGA**2 / SQUARE) / OMEGA) * (1 - 1j * OMEGA)
HOPF = {"tau": np.angle(POINT) / OMEGA, "epsilon": abs(POINT) - 1}
LAWS = {"theta": "-v*(theta + (1 + epsilon)*w(t - tau))", "u": "expm1(w)"}
MODEL = dk.Model(
    LAWS | {"w": "-square/v*(u - kappa*second_difference(u) + (theta + w)/xi)"},
    parameters=HOPF | {"xi": XI, "square": SQUARE, "kappa": KAPPA},
    **{"auxiliary": {"v": "exp(w)"}, "blocks": N},
)
FACTORS = {"u": 1, "w": 1j * OMEGA, "theta": -1j * OMEGA - XI * (S - OMEGA**2 / SQUARE)}
U = 1e-8 * np.cos(np.pi * MODE * (np.arange(N) + 0.5) / N)
HISTORY = {k: lambda t, c=c: (c * np.exp(1j * OMEGA * t)).real * U for k, c in FACTORS.items()}


def numbers() -> dict[str, float]:
    """The displacement of the first block over that at t = 0."""
    times = np.array([1, 4]) * np.pi / OMEGA
    run = MODEL.run(HISTORY, times[-1], t_eval=times, atol=1e-17)
    return dict(zip(PUBLISHED, run.u.values[0] / U[0], strict=True))


def plot():
    """The displacements over time."""
    MODEL.run(HISTORY, 50, atol=1e-17).u.plot(x="t", y="block")


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
