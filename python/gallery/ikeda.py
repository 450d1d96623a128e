# SPDX-License-Identifier: BSD-3-Clause
"""Light in a ring cavity: Ikeda, Daido and Akimoto (1980), Phys. Rev. Lett. 45, 709; x0 = pi here.

Exact: a pair of roots is imaginary where omega = sqrt(mu**2 - 1), tan(omega tau) = -omega; there
l1 = Re[-(z/2)/(1 + tau z)]/omega with z = 1 + i omega. At long delays x is a square wave of height
a = mu sin a (Chow and Mallet-Paret 1983, Coupled nonlinear oscillators, 7); this is stiff.
"""

import delaykit as dk
import numpy as np
from delaykit.gallery import show

PUBLISHED = {"omega": (0, 1e-12), "tan": (0, 1e-9), "l1": (0, 1e-9), "a - mu sin a": (0, 1e-9)}
MODEL = dk.Model(
    {"x": "-x - mu*sin(x(t - tau))"}, parameters={"mu": 2, "tau": 10}, steady_state={"x": 0}
)


def numbers() -> dict[str, float]:
    """The largest errors on the Hopf curves, and of the height at tau = 10**5."""
    found = MODEL.hopf(("tau", "mu"), ((0.1, 6), (1.1, 6)))
    omega, z = found.omega, 1 + 1j * found.omega
    run = MODEL.integrate(1, 6.05e6, t_eval=[6.05e6], parameters={"tau": 1e5})
    return {
        "omega": abs(omega - np.sqrt(found.mu**2 - 1)).max(),
        "tan": abs(np.sin(found.tau * omega) + omega * np.cos(found.tau * omega)).max(),
        "l1": abs(found.l1 - (-z / 2 / (1 + found.tau * z)).real / omega).max(),
        "a - mu sin a": run.y[0, 0] - 2 * np.sin(run.y[0, 0]),
    }


def plot():
    """x over time."""
    MODEL.run(1, 200).x.plot()


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
