# SPDX-License-Identifier: BSD-3-Clause
"""SciPy: the equation of Mackey and Glass by one call of solve_ivp for each delay, with the one
before as its past (package.py), and its dense output on layers (dense.py)."""

import itertools

import numpy as np
import scipy
from scipy.integrate import solve_ivp
from serving import PAST, mackey_glass, serve, slope

PARTS = 16
"""Parts of a step between two samples."""
MOST_EVALUATIONS = 500_000
"""A run with more has stalled."""


def samples(tau: float, times: np.ndarray, tolerance: float) -> np.ndarray:
    """Solution at ascending times, for one delay."""
    found = np.empty(len(times))
    past, state, start = (lambda t: [PAST]), [PAST], 0.0
    while start < times[-1]:
        end = min(start + tau, times[-1])
        run = solve_ivp(
            lambda t, y, past=past: [slope(y[0], past(t - tau)[0])],
            *((start, end), state, "DOP853"),
            **{"rtol": tolerance, "atol": tolerance, "dense_output": True},
        )
        here = (times > start) & (times <= end)
        if here.any():
            found[here] = run.sol(times[here])[0]
        past, state, start = run.sol, run.y[:, -1], end
    return found


def dense(words: list[str], rates: list[float], t_end: float, _):
    """Largest errors at the ends of steps and between them, a row for each rate; not a number where
    a run failed."""
    return lambda tolerance, _: [errors_of(*words, tolerance, rate, t_end) for rate in rates]


def errors_of(
    method: str, layer: str, tolerance: float, rate: float, t_end: float
) -> tuple[float, float]:
    """Both errors of one run."""
    first, switch = (1.0, np.inf) if layer == "decay" else (0.0, 1.0)
    calls = itertools.count()

    def relax(t: float, y: np.ndarray) -> np.ndarray:
        if next(calls) == MOST_EVALUATIONS:
            raise TimeoutError
        return rate * ((t >= switch) - y)

    def largest_error(t: np.ndarray, y: np.ndarray) -> float:
        since = np.where(t >= switch, t - switch, t)
        exact = (t >= switch) + (first - (t >= switch)) * np.exp(-rate * since)
        return float(abs(y - exact).max())

    limits = {"rtol": tolerance, "atol": tolerance}
    try:
        run = solve_ivp(relax, (0.0, t_end), [first], method, dense_output=True, **limits)
    except TimeoutError:
        return np.nan, np.nan
    inside = (run.t[:-1, None] + np.diff(run.t)[:, None] * np.arange(1, PARTS) / PARTS).ravel()
    errors = largest_error(run.t, run.y[0]), largest_error(inside, run.sol(inside)[0])
    return errors if run.success else (np.nan, np.nan)


if __name__ == "__main__":
    serve(scipy.__version__, {"dense": dense, **mackey_glass(samples)})
