"""Equation (5) and its roots, written apart from the programs."""

import numpy as np


def terms(s, epsilon, tau, xi, gamma):
    """The terms of the characteristic function (5)."""
    stiffness = gamma**2 / xi
    return [
        s**3,
        s**2 * (1 + stiffness),
        s * gamma**2 * (1 + 1 / xi),
        gamma**2 + 0 * s,
        -s * (1 + epsilon) * stiffness * np.exp(-s * tau),
    ]


def residual(s, *parameters):
    """|(5)| over its largest term."""
    parts = terms(s, *parameters)
    return np.abs(np.sum(parts, axis=0)) / np.max(np.abs(parts), axis=0)


def closed_form(omega, xi, gamma):
    """epsilon, and omega tau but for whole turns, of a pair i omega."""
    b = xi * (gamma**2 - omega**2) / (gamma**2 * omega)
    epsilon = np.sqrt((1 + omega**2) * (1 + b**2)) - 1
    return epsilon, np.arctan(b) - np.arctan(omega)


def count_by_crossings(epsilon, tau, xi, gamma):
    """Unstable pairs, independently: those of the cubic at tau = 0, and what crosses up to tau."""
    lost = gamma**2 * xi / (xi + gamma**2)
    pairs = 1 if epsilon > lost else 0
    c = xi**2 / gamma**4
    cubic = [c, c + 1 - 2 * c * gamma**2, 1 - 2 * c * gamma**2 + xi**2 - (1 + epsilon) ** 2, xi**2]
    squares = np.roots(cubic)
    squares = np.sort(squares[(abs(squares.imag) < 1e-9) & (squares.real > 0)].real)
    for way, omega in zip((-1, 1), np.sqrt(squares), strict=False):
        _, angle = closed_form(omega, xi, gamma)
        turns = np.arange(100)
        delays = (angle + 2 * np.pi * turns) / omega
        pairs += way * np.count_nonzero((delays > 0) & (delays < tau))
    return pairs
