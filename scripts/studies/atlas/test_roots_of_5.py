"""Roots of (5), and what motions do where one is unstable."""

import pytest
from made_up_results import NO, YES, Results, attractor_row, hopf_curve

from scripts.studies.atlas.claims import roots_decide
from scripts.tables.roots_of_5 import unstable_roots

BELOW, ABOVE = {"epsilon": 0.2, "tau": 0.0}, {"epsilon": 0.4, "tau": 0.0}
"""Beside the Hopf point without delay, epsilon = gamma^2 xi/(xi + gamma^2) = 0.356 at xi = 0.8."""


@pytest.mark.parametrize(
    ("rows", "verdict"),
    [
        ([("fixed point", BELOW), ("torus", ABOVE)], YES),
        ([("fixed point", BELOW), ("cycle", BELOW), ("chaos", ABOVE)], YES),
        ([("fixed point", BELOW), ("undecided", ABOVE)], NO),
        ([("fixed point", BELOW), ("cycle", ABOVE), ("fixed point", ABOVE)], NO),
        ([("fixed point", BELOW), ("cycle", {**ABOVE, "largest_maximum": 1 + 1e-6})], NO),
        ([("fixed point", BELOW)], NO),
        # points of the atlas that were not computed have the class of their neighbours
        ([("fixed point", BELOW), ("cycle", ABOVE), ("chaos", {**ABOVE, "computed": "no"})], YES),
        ([("fixed point", BELOW), ("cycle", ABOVE), ("fixed point", {"computed": "no"})], YES),
    ],
)
def test_roots_decide(rows, verdict):
    """No rest with an unstable root; with none, rest or another attractor; both must be met."""
    made = [attractor_row(met, **given) for met, given in rows]
    found = roots_decide(Results(atlas=made[1:], attractors=made[:1]), least_motion=1e-3)
    assert found.verdict == verdict
    counted = [met for met, given in rows if met != "undecided" and "computed" not in given]
    assert found.evidence.startswith(f"{len(counted)} computed motions ")


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
