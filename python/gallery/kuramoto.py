# SPDX-License-Identifier: BSD-3-Clause
"""Phases on a ring, each pulled by its neighbours a time tau ago.

Earl and Strogatz 2003, Phys. Rev. E 67, 036204: phases that move alike have W = 1 - K sin(W tau),
and are stable if and only if K cos(W tau) > 0. In a wave sin(W tau) has the factor cos(2 pi m/N).
"""

import delaykit as dk
import numpy as np
from delaykit.gallery import show
from scipy.optimize import brentq

RING = (np.roll(np.eye(16), 1, 0) + np.roll(np.eye(16), -1, 0)) / 2
PHASES = {"x[i]": "1 - W + K*sum(j, a[i, j]*sin(x[j](t - tau) - x[i] - W*tau))"}
MODEL = dk.Model(PHASES, {"W": 0, "K": 0.5, "tau": 1, "a": RING}, size={"i": 16}, name="kuramoto")
WAVE = np.array([np.pi / 4 * i + 0.2 * np.sin(5 * i) for i in range(16)])
ALIKE = ((0.5, 1), (0.2, 2.5))


def frequency(k: float, tau: float, turns: int = 0) -> float:
    pull = k * np.cos(2 * np.pi * turns / 16)
    return brentq(lambda one: one - 1 + pull * np.sin(one * tau), 0, 2)


PUBLISHED = {"W of a wave": (frequency(0.5, 1, 2), 1e-8), "K cos > 0": (0, 0), "< 0": (1, 0)}


def numbers() -> dict[str, float]:
    """The frequency to which a run settles, and whether phases that move alike are unstable."""
    last = MODEL.run(WAVE, 2000, t_eval=[1999, 2000]).x.values[0]
    alike = [MODEL.with_parameters(K=k, tau=tau, W=frequency(k, tau)) for k, tau in ALIKE]
    unstable = [(one.roots(-0.05, near={"x": 0}).real > 1e-9).any() for one in alike]
    return dict(zip(PUBLISHED, [last[1] - last[0], *unstable], strict=True))


def plot():
    dk.plot(np.sin(MODEL.run(WAVE, 60)).rename(x="sin(x)"))


if __name__ == "__main__":
    show(numbers, PUBLISHED, plot)
