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
