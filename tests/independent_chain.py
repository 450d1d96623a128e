"""Chains of blocks by the classical Runge-Kutta method: a code that shares nothing with ours."""

import numpy as np
import xarray as xr


def second_difference(u: np.ndarray, ends: str) -> np.ndarray:
    """u_(j+1) - 2 u_j + u_(j-1), with the neighbours that the ends have."""
    if ends == "ring":
        return np.roll(u, 1) + np.roll(u, -1) - 2 * u
    beyond = [u[0], u[-1]] if ends == "free" else [0.0, 0.0]
    padded = np.concatenate([beyond[:1], u, beyond[1:]])
    return padded[:-2] + padded[2:] - 2 * u


def solve_chain(chain: dict, t_end: float, h: float) -> np.ndarray:
    """theta, u and ln v at multiples of h, shape (times, 3, blocks); tau is a multiple of h, too.

    The delayed ln v in the middle of a step is from Hermite's cubic: its error is of order h^4, as
    that of the method.
    """
    epsilon, xi, gamma, kappa = (chain[key] for key in ("epsilon", "xi", "gamma", "kappa"))
    lag, steps = round(chain["tau"] / h), round(t_end / h)
    y = np.array([chain["theta"], chain["u"], np.log(chain["v"])])
    past = y[2].copy()
    states, slopes = np.empty((steps + 1, *y.shape)), np.empty((steps + 1, y.shape[1]))

    def rates(y: np.ndarray, delayed: np.ndarray) -> np.ndarray:
        theta, u, w = y
        v = np.exp(w)
        force = u - kappa * second_difference(u, chain["ends"]) + (theta + w) / xi
        return np.array([-v * (theta + (1 + epsilon) * delayed), v - 1, -(gamma**2) / v * force])

    def before(i: int) -> np.ndarray:
        return states[i - lag, 2] if i >= lag else past

    def between(i: int) -> np.ndarray:
        if i < lag:
            return past
        left, right = states[i - lag, 2], states[i - lag + 1, 2]
        return (left + right) / 2 + h / 8 * (slopes[i - lag] - slopes[i - lag + 1])

    states[0] = y
    for i in range(steps):
        k1 = rates(y, before(i))
        slopes[i] = k1[2]
        k2 = rates(y + h / 2 * k1, between(i))
        k3 = rates(y + h / 2 * k2, between(i))
        k4 = rates(y + h * k3, before(i + 1))
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        states[i + 1] = y
        slopes[i + 1] = rates(y, before(i + 1))[2]
    return states


def made_up_chain(values: np.ndarray, ends: str = "free") -> xr.Dataset:
    """A chain with these ln v, shape (t, block)."""
    return xr.Dataset(
        {"v": (("t", "block"), np.exp(values))},
        coords={"t": np.arange(len(values), dtype=float)},
        attrs={"t_transient": 0.0, "ends": ends, "blocks": values.shape[1]},
    )
