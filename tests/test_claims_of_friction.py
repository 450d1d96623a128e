"""Verdicts on the friction law, on made-up velocity steps."""

import pytest
import xarray as xr
from made_up_results import results

from scripts.claims.claims_of_friction import TESTS
from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, REPRODUCED


def a_velocity_step(direct=0.006, evolution=-0.009, theta=10.0, end=0.0, first=0.6):
    """Friction through a step of the velocity and back."""
    attributes = {"direct_effect": direct, "evolution_effect": evolution, "mu0": 0.6, "dc": 1e-5}
    attributes |= {"a": 0.01, "b": 0.015, "b_state": 10.0, "v0": 1e-6, "delta_v": 9e-6}
    data = {
        "mu": ("sample", [first, 0.606, 0.597, 0.6 + end]),
        "theta": ("sample", [theta] * 4),
        "velocity": ("sample", [1e-6, 1e-5, 1e-5, 1e-6]),
    }
    return results(friction=xr.Dataset(data, attrs=attributes))


@pytest.mark.parametrize(
    ("given", "verdict"),
    [
        ({}, REPRODUCED),
        ({"direct": -0.006}, NOT_REPRODUCED),
        ({"evolution": -0.003}, NOT_REPRODUCED),
        ({"end": 0.01}, NOT_REPRODUCED),
    ],
)
def test_velocity_step(given, verdict):
    """A jump, a larger fall, and back again."""
    assert TESTS["velocity_step"](a_velocity_step(**given)).verdict == verdict


@pytest.mark.parametrize(
    ("given", "verdict", "words"),
    [
        ({"theta": 10.0}, CORRECTED, "by 0.6931 to 0.6931 per unit of B, and by 0.09531 to"),
        ({"theta": -5.0}, CORRECTED, "by -0.6931 to -0.6931 per unit of B"),
        # ln 10 = 2.303
        ({}, CORRECTED, "of the step, 10 v0, it changes by -2.303 per unit of B - A"),
    ],
)
def test_friction_falls_with_epsilon(given, verdict, words):
    """In every state by (1.1), by B and by A; in steady sliding by (2), where v > v0."""
    found = TESTS["friction_falls_with_epsilon"](a_velocity_step(**given))
    assert found.verdict == verdict
    assert words in found.evidence


def test_friction_that_falls_with_epsilon():
    """Where both logarithms are negative: a negative theta, and steps back."""
    made = a_velocity_step(theta=-5.0)
    made.friction = made.friction.assign(velocity=-5 * made.friction.velocity)
    assert TESTS["friction_falls_with_epsilon"](made).verdict == REPRODUCED
    slower = a_velocity_step()
    slower.friction = slower.friction.assign(velocity=0.05 * slower.friction.velocity)
    assert TESTS["friction_falls_with_epsilon"](slower).verdict == NOT_REPRODUCED


@pytest.mark.parametrize(("first", "verdict"), [(0.6, REPRODUCED), (0.6035, NOT_REPRODUCED)])
def test_mu0_is_steady_friction(first, verdict):
    """By the friction before the step, with what is left in numbers."""
    found = TESTS["mu0_is_steady_friction"](a_velocity_step(first=first), limit=1e-6)
    assert found.verdict == verdict
    assert "-A ln 2 = -0.006931 and B ln(theta/b + 1) = 0.0104" in found.evidence
    assert "it is B ln(theta/b) = 0." in found.evidence


def test_same_state_law():
    """Different away from v theta = Dc, equal there."""
    found = TESTS["same_state_law"](a_velocity_step(), limit=1e-6)
    assert found.verdict == NOT_REPRODUCED
    # theta = 10 s at v = 1e-5 m/s: x = 10, 1 - x and -x ln x
    assert "differ most at x = 10: d theta/dt = -9 by (1.2) and -23.03 by (2)" in found.evidence
    steady = a_velocity_step()
    steady.friction = steady.friction.assign(velocity=1e-5 / steady.friction.theta)
    assert TESTS["same_state_law"](steady, limit=1e-6).verdict == REPRODUCED
