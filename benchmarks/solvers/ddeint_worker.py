# SPDX-License-Identifier: BSD-3-Clause
"""ddeint: the equation of Mackey and Glass (package.py). Its error follows the square of the
distance of samples, between which it reads lines."""

from importlib.metadata import version

import numpy as np
from ddeint import ddeint
from serving import PAST, mackey_glass, serve, slope


def samples(tau: float, times: np.ndarray, tolerance: float) -> np.ndarray:
    """Solution at times, for one delay."""
    grid = np.linspace(0, times[-1], 1 + int(np.ceil(times[-1] / (4 * np.sqrt(tolerance)))))
    values = ddeint(lambda past, t: slope(past(t), past(t - tau)), lambda t: PAST, grid)
    return np.interp(times, grid, np.ravel(values))


if __name__ == "__main__":
    serve(version("ddeint"), mackey_glass(samples))
