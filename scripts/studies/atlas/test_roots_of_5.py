"""Roots of (5), and what motions do where one is unstable."""

import pytest
from made_up_results import NO, YES, assert_finding, attractor_row, cases, hopf_curve

from scripts.tables.roots_of_5 import unstable_roots

BELOW, ABOVE = {"epsilon": 0.2, "tau": 0.0}, {"epsilon": 0.4, "tau": 0.0}
"""Beside the Hopf point without delay, epsilon = gamma^2 xi/(xi + gamma^2) = 0.356 at xi = 0.8."""


REST = ("fixed point", BELOW)


def motions(*rows: tuple[str, dict]) -> dict:
    """Results of a scene, and of points of the atlas, with these classes and values."""
    made = [attractor_row(met, **given) for met, given in rows]
    return {"attractors": made[:1], "atlas": made[1:]}


@cases(
    (
        # no rest with an unstable root; with none, rest or another attractor; both must be met
        *("roots_decide", {"least_motion": 1e-3}),
        (motions(REST, ("torus", ABOVE)), YES, "2 computed motions "),
        (motions(REST, ("cycle", BELOW), ("chaos", ABOVE)), YES, "3 computed motions "),
        (motions(REST, ("undecided", ABOVE)), NO, "1 computed motions "),
        (motions(REST, ("cycle", ABOVE), ("fixed point", ABOVE)), NO),
        (motions(REST, ("cycle", {**ABOVE, "largest_maximum": 1 + 1e-6})), NO),
        (motions(REST), NO),
        # points of the atlas that were not computed have the class of their neighbours
        (motions(REST, ("cycle", ABOVE), ("chaos", {**ABOVE, "computed": "no"})), YES),
        (motions(REST, ("cycle", ABOVE), ("fixed point", {"computed": "no"})), YES, "2 computed"),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


@pytest.mark.parametrize(
    ("given", "number"),
    [
        ({"epsilon": 0.355, "tau": 0.0}, 0),
        ({"epsilon": 0.357, "tau": 0.0}, 2),
        ({"epsilon": -0.5, "tau": 50.0}, 0),
    ],
)
def test_roots_without_delay_and_without_crossing(given, number):
    """By Routh and Hurwitz; and friction that grows with v is stable at every delay."""
    assert unstable_roots(xi=0.8, gamma=0.8, **given) == number


@pytest.mark.parametrize("k", [1, 2])
def test_roots_change_on_hopf_curves(k):
    """By a pair, and nowhere else: on curves in closed form, a little to both sides."""
    curves = hopf_curve(k=k)
    for epsilon, tau in zip(curves.epsilon.values, curves.tau.values, strict=True):
        before, after = (
            unstable_roots(epsilon=epsilon, tau=tau + off, xi=0.5, gamma=0.8)
            for off in (-1e-6, 1e-6)
        )
        assert abs(after - before) == 2
