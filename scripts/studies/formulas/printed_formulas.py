"""The paper's equations as it prints them, put into its characteristic equation (5).

Residuals are over the largest term of (5), so that 1e-15 is rounding and 1 is no agreement.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from scripts.files.inputs import Dataset

FREQUENCIES = 2000
"""Frequencies at which (9) is tried."""
NUDGE = 1e-30
"""Step of a complex-step derivative: small enough to leave no error of its own."""


@dataclass(kw_only=True)
class Points:
    """Points of Hopf curves: parameters and the frequency omega of the pair on the axis."""

    epsilon: np.ndarray
    tau: np.ndarray
    xi: np.ndarray
    omega: np.ndarray
    gamma: float

    @property
    def stiffness(self) -> np.ndarray:
        """gamma^2/xi."""
        return self.gamma**2 / self.xi


def points_of(curves: Dataset) -> Points:
    """Points of a file of Hopf curves; to have none is an error."""
    if curves.sizes["point"] == 0:
        raise ValueError(f"no Hopf curve in the window of the plane {dict(curves.attrs)}")
    named = {key: curves[key].values for key in ("epsilon", "tau", "xi", "omega")}
    return Points(**named, gamma=float(curves.attrs["gamma"]))


def terms_of_5(points: Points, epsilon: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Terms of (5) at s = i omega, in its order with the sign of s^3 positive."""
    s = 1j * points.omega
    ratio, square = points.stiffness, points.gamma**2
    delayed = -s * (1 + epsilon) * ratio * np.exp(-s * tau)
    return np.array(
        [s**3, s**2 * (1 + ratio), s * (ratio + square), square + 0 * s, delayed], dtype=complex
    )


def residual_of_5(points: Points, epsilon: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """How far (5) is from holding with these epsilon and tau."""
    terms = terms_of_5(points, epsilon, tau)
    return np.abs(terms.sum(axis=0)) / np.abs(terms).max(axis=0)


def least_residual_of_5(points: Points, epsilon: np.ndarray) -> np.ndarray:
    """The same with the delay that fits best: the delay only turns the last term's phase."""
    terms = terms_of_5(points, epsilon, points.tau)
    left = np.abs(np.abs(terms[:-1].sum(axis=0)) - np.abs(terms[-1]))
    return left / np.abs(terms).max(axis=0)


def residual_of_6(points: Points) -> np.ndarray:
    """How far (6) as printed is from holding; its right side is 1 in size."""
    w, square = points.omega, points.gamma**2
    above = 1j * w**3 + w**2 * (points.stiffness + 1)
    above -= 1j * w * square * (1 + points.xi) / points.xi + square
    below = 1j * w * (1 + points.epsilon) * points.stiffness
    turning = np.cos(w * points.tau) - 1j * np.sin(w * points.tau)
    return np.abs(above / below + turning)


def epsilon_of_8(points: Points, power: int) -> np.ndarray:
    """(7) and (8) with this power of the last gamma: 1 as printed, 2 as corrected."""
    w, square = points.omega, points.gamma**2
    real = w**3 - w * square * (1 + points.xi) / points.xi
    imaginary = w**2 * (points.stiffness + 1) - points.gamma**power
    return -1 + np.hypot(real, imaginary) / (w * points.stiffness)


def xi_of_9(*, omega: np.ndarray, tau: np.ndarray | float, gamma: float) -> np.ndarray:
    """(9) as printed."""
    sine, cosine = np.sin(omega * tau), np.cos(omega * tau)
    above = omega * gamma**2 * sine + omega**2 * gamma**2 * cosine
    return above / ((omega**3 - omega * gamma**2) * sine + (gamma**2 - omega**2) * cosine)


def tau_of_10(points: Points, branch: np.ndarray) -> np.ndarray:
    """(10) as printed: without gamma^2 in its numerator, and with the plain arctangent."""
    w, square = points.omega, points.gamma**2
    above = -(w**2) * (points.stiffness + 1)
    below = -(w**3) + w * square * (1 + points.xi) / points.xi
    return (np.arctan(above / below) + 2 * np.pi * branch) / w


def residuals_beside_9(points: Points) -> np.ndarray:
    """How far (5) is from holding with (9) at frequencies of a curve that have a xi within it."""
    omega = np.linspace(points.omega.min(), points.omega.max(), FREQUENCIES)
    tau = np.full_like(omega, points.tau[0])
    xi = xi_of_9(omega=omega, tau=tau, gamma=points.gamma)
    kept = (xi >= points.xi.min()) & (xi <= points.xi.max())
    tried = replace(points, epsilon=0 * xi[kept], tau=tau[kept], xi=xi[kept], omega=omega[kept])
    return residual_of_5(tried, epsilon_of_8(tried, 2), tried.tau)


def residuals_on(curves: Dataset) -> dict:
    """Largest residuals on curves: of (5) by (7) to (10) as printed and as corrected, and of (6).

    And the numbers of points and branches.
    """
    points, branch = points_of(curves), curves.branch.values
    tau = tau_of_10(points, branch) if curves.attrs["ordinate"] == "tau" else points.tau
    return {
        "printed": residual_of_5(points, epsilon_of_8(points, 1), tau).max(),
        "corrected": float(curves.residual.max()),
        "of_6": residual_of_6(points).max(),
        "points": branch.size,
        "branches": np.unique(branch).size,
    }


def friction_of_3(theta, v, _delayed, epsilon, _tau):
    """d theta/dt of (3) as printed."""
    return -v * (theta * (1 + epsilon) * np.log(v))


def friction_of_4(theta, v, _delayed, epsilon, tau):
    """d theta/dt of (4) as printed; no number where v - tau is not positive."""
    argument = v - tau
    return -v * (theta * (1 + epsilon) * np.log(np.where(argument.real > 0, argument, np.nan)))


def friction_corrected(theta, v, delayed, epsilon, _tau):
    """d theta/dt of (3) and (4) as corrected; `delayed` is v(t - tau)."""
    return -v * (theta + (1 + epsilon) * np.log(delayed))


def mismatch_with_5(points: Points, tau: np.ndarray, friction: Callable) -> np.ndarray:
    """Characteristic determinant of the equations with this d theta/dt, less (5).

    Linearised at (0, 0, 1) by complex steps; infinite where the equations have no value there.
    """
    steady = [np.zeros(tau.shape), np.ones(tau.shape), np.ones(tau.shape)]
    slopes = []
    for varied in range(3):
        nudged = [value + (NUDGE * 1j if i == varied else 0j) for i, value in enumerate(steady)]
        slopes.append(friction(*nudged, points.epsilon, tau).imag / NUDGE)
    of_theta, of_v, of_delayed = slopes
    s = 1j * points.omega
    matrix = np.zeros((tau.size, 3, 3), dtype=complex)
    matrix[:, 0, 0] = s - of_theta
    matrix[:, 0, 2] = -(of_v + of_delayed * np.exp(-s * tau))
    matrix[:, 1, 1], matrix[:, 1, 2] = s, -1
    matrix[:, 2, 0], matrix[:, 2, 1] = points.stiffness, points.gamma**2
    matrix[:, 2, 2] = s + points.stiffness
    terms = terms_of_5(points, points.epsilon, tau)
    there = np.isfinite(matrix).all(axis=(1, 2))
    determinant = np.full(tau.size, np.inf, dtype=complex)
    determinant[there] = np.linalg.det(matrix[there])
    return np.abs(determinant - terms.sum(axis=0)) / np.abs(terms).max(axis=0)
