"""Unstable roots of the characteristic equation (5), counted from its Hopf points.

Written apart from the Fortran programs, which count them by the argument principle.
"""

import numpy as np


def unstable_roots(epsilon: float, tau: float, xi: float, gamma: float) -> int:
    """How many roots of (5) have a positive real part.

    (5) is p(s) = c s exp(-s tau) with p = s^3 + a s^2 + b s + gamma^2. Without delay the criterion
    of Routh and Hurwitz counts. With a growing delay pairs cross the imaginary axis at +-i omega
    with |p|^2 = c^2 omega^2: to the right where |p|^2 - c^2 omega^2 grows with omega, otherwise to
    the left.
    """
    square = gamma**2
    a, b, c = square / xi + 1, square / xi + square, (1 + epsilon) * square / xi
    roots = 2 * int(a * (b - c) < square)
    difference = [1.0, a**2 - 2 * b, b**2 - 2 * a * square - c**2, square**2]
    for root in np.roots(difference):
        if abs(root.imag) > 1e-12 * abs(root) or root.real <= 0:
            continue
        omega = np.sqrt(root.real)
        p = square - a * omega**2 + 1j * omega * (b - omega**2)
        first = np.mod(-np.angle(p / (1j * c * omega)), 2 * np.pi) / omega
        crossings = 1 + int((tau - first) * omega / (2 * np.pi)) if tau > first else 0
        roots += 2 * crossings * int(np.sign(np.polyval(np.polyder(difference), root.real)))
    return roots
