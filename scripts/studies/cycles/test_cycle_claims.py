"""Verdicts on cycles at a scene's parameters."""

import pytest
from made_up_results import (
    NO,
    PARTLY,
    PLACE,
    YES,
    Results,
    attractor_row,
    cycles_to_a_torus,
    stability_row,
    torus_point,
)

from scripts.claims import ledger  # noqa: F401  (it loads the tests of all studies)
from scripts.studies.cycles.claims import second_hopf, torus_of_scene


def at_scene(met: str, tau: float, **given):
    return Results(
        **{
            "attractors": [attractor_row(met)],
            "linear_stability": [stability_row(**{**PLACE, "tau": tau})],
            "cycles": {"mine": cycles_to_a_torus()},
            "cycle_points": [torus_point()],
            **given,
        }
    )


@pytest.mark.parametrize(
    ("met", "tau", "verdict"),
    [
        ("torus", 0.35, YES),
        ("torus", 0.24, PARTLY),
        ("cycle", 0.15, NO),
        ("chaos", 0.35, NO),
    ],
)
def test_torus_of_scene(met, tau, verdict):
    """A run that ends on a torus, where no cycle is stable: the special point parts the orbits."""
    assert torus_of_scene(at_scene(met, tau), scene="mine").verdict == verdict


@pytest.mark.parametrize(
    ("met", "tau", "given", "verdict"),
    [
        ("torus", 0.35, {}, YES),
        ("torus", 0.15, {}, NO),
        ("chaos", 0.35, {}, NO),
        ("torus", 0.35, {"cycle_points": []}, NO),
        ("torus", 0.35, {"cycle_points": [torus_point(kind="fold")]}, NO),
        ("torus", 0.35, {"cycle_points": [torus_point(unstable_before=2.0)]}, NO),
        ("torus", 0.35, {"cycles": {"mine": cycles_to_a_torus(xi=0.5)}}, NO),
    ],
)
def test_second_hopf(met, tau, given, verdict):
    """At the scene; elsewhere on a line through it is said, but is not there."""
    found = second_hopf(at_scene(met, tau, **given), scene="mine")
    assert found.verdict == verdict
    elsewhere = "With all other parameters the same it occurs at $tau = 0.25$."
    nowhere = "No torus bifurcation of a stable cycle is known on these lines."
    instead = nowhere if given else elsewhere
    assert found.instead == (instead if verdict == NO else "")
