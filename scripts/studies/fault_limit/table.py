"""The least epsilon of all Hopf curves over gamma, beside that without delay, as one table.

At the Hopf point without delay also l1, under the slip law and under the ageing law.
"""

import math

from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.ranges_of_gamma import PAPER

GAMMAS = sorted([PAPER, *(10 ** (i / 10) for i in range(-10, 121))])
"""The paper's, and ten in each decade from 0.1 up to the last of real faults."""
ITERATIONS = 60
"""Of Newton's method; from gamma = 0.1 on ten are enough."""
STIFFEST = 10.0
"""A xi beyond that of any fault: steady sliding is unstable there if b is 11 a or more."""


def leading_order(xi: float, gamma: float) -> float:
    """How far delays lower the least epsilon at large gamma: xi^3 (1 + xi)/(2 gamma^4)."""
    return xi**3 * (1 + xi) / (2 * gamma**4)


def lyapunov_coefficients(xi: float, gamma: float) -> dict[str, float]:
    """The coefficients l1 (docs/method.md) of both laws at the Hopf point without delay.

    With x = omega^2 = epsilon there, d = xi - x = xi^2/(xi + gamma^2) and |q|^2 = (1 + x)^2/x. The
    one of the ageing law has the sign of xi^2 - 8 xi d - 4 x d^2; with y = gamma^2/xi that is the
    sign of y^3 - 5 y^2 - (13 + 4 xi) y - 7, which changes once.
    """
    x, d = xi * gamma**2 / (xi + gamma**2), xi**2 / (xi + gamma**2)
    common = x**2.5 * d / (2 * (1 + x) ** 2 * (xi**2 + x * d**2) * (xi**2 + 4 * x * d**2))
    return {
        "l1_slip": -common * xi * (1 + x) * (xi + 8 * d),
        "l1_ageing": common * (xi**2 - 8 * xi * d - 4 * x * d**2),
    }


def row_of(xi: float, gamma: float) -> dict:
    """The minimum of (1 + epsilon)^2 = F(x), x = omega^2, on the Hopf curves.

    F = (1 + x) [1 + xi^2 (gamma^2 - x)^2/(gamma^4 x)] is convex, and its minimum lies at x0 + d
    with x0 = epsilon without delay. All differences are written as products: at large gamma they
    are far below the rounding error of F.
    """
    square = gamma**2
    x0 = xi * square / (xi + square)
    slope = -2 * xi * (1 + x0) / square
    d = 0.0
    # F'(x0 + d) is concave in d and negative at d = 0: Newton's method converges from below
    for _ in range(ITERATIONS):
        x = x0 + d
        excess = slope + xi**2 * d * (2 / square**2 + (x0 + x) / (x0 * x) ** 2)
        d -= excess / (xi**2 * (2 / square**2 + 2 / x**3))
    x = x0 + d
    drop = -d * (slope + xi**2 * d * (1 / square**2 + 1 / (x0**2 * x)))
    depth = drop / (1 + x0 + math.sqrt((1 + x0) ** 2 - drop))
    omega = math.sqrt(x)
    b = xi * (square - x) / (square * omega)
    return {
        "gamma": gamma,
        "xi": xi,
        "without_delay": x0,
        "least": x0 - depth,
        "depth": depth,
        "leading_order": leading_order(xi, gamma),
        **lyapunov_coefficients(xi, gamma),
        "omega": omega,
        "tau": (math.atan(b) - math.atan(omega) + 2 * math.pi) / omega,
    }


def widest_between(rows: list[dict], least: float, most: float) -> dict:
    """The row of a range of gamma with the widest interval that delays destabilise."""
    known = [row for row in rows if least <= row["gamma"] <= most]
    if not known:
        raise ValueError(f"no gamma from {least:g} to {most:g}")
    return max(known, key=lambda row: row["depth"] / row["without_delay"])


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        write_table(snakemake.output[0], [row_of(snakemake.params.xi, gamma) for gamma in GAMMAS])
