"""Verdicts on stiffness, stick-slip, the stationary state and friction, on made-up results."""

import numpy as np
import pytest
import xarray as xr
from made_up_results import results, run_row

from scripts.claims.claims_of_runs import TESTS
from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, REPRODUCED

STOPPED = {"status": "too_many_steps", "error": np.nan, "error_expected": np.nan}
OTHERS = [run_row(gamma=1.0), run_row(method="explicit")]
"""Runs that are not asked about."""


@pytest.mark.parametrize(
    ("runs", "verdict", "words"),
    [
        ([run_row(**STOPPED)], REPRODUCED, "0 of 1 runs by the method auto"),
        ([run_row(), run_row(**STOPPED)], NOT_REPRODUCED, "1 of 2 runs"),
        ([run_row()], NOT_REPRODUCED, "1 of 1 errors against quadruple precision are at most"),
        ([run_row(error=0.1)], NOT_REPRODUCED, "are at most 0.001. 0 are at most 100 times"),
        ([], NOT_REPRODUCED, "0 of 0 runs"),
    ],
)
def test_out_of_reach(runs, verdict, words):
    """Only where there are runs and none is completed; other methods and gammas do not count."""
    made = results(stability=runs + OTHERS)
    found = TESTS["out_of_reach"](made, method="auto", least=1e4, most=1e12)
    assert found.verdict == verdict
    assert words in found.evidence


@pytest.mark.parametrize(
    ("runs", "verdict"),
    [
        ([run_row(), run_row(least_ln_v=0.0)], REPRODUCED),
        ([run_row(least_ln_v=0.0)], NOT_REPRODUCED),
        ([run_row(status="step_underflow")], NOT_REPRODUCED),
    ],
)
def test_relaxation(runs, verdict):
    """The widest run that is completed decides."""
    found = TESTS["relaxation"](results(stability=runs), method="auto", ratio=1e3)
    assert found.verdict == verdict


@pytest.mark.parametrize(
    ("given", "verdict"),
    [
        ({"error": 1e-9}, REPRODUCED),
        ({"error": 1e-3}, NOT_REPRODUCED),
        ({"error": np.nan, "status": "too_many_steps"}, NOT_REPRODUCED),
        ({"error": 1e-9, "reference": "none: a limit cycle over many periods"}, NOT_REPRODUCED),
    ],
)
def test_stationary_state(given, verdict):
    """All long runs that decay must end there."""
    row = run_row(**{"reference": "exact stationary state, at t_end only", **given})
    found = TESTS["stationary_state"](results(stability=[row]), within=1e-6)
    assert found.verdict == verdict


def a_velocity_step(direct=0.006, evolution=-0.009, theta=10.0, end=0.0):
    """Friction through a step of the velocity and back."""
    attributes = {"direct_effect": direct, "evolution_effect": evolution}
    attributes |= {"a": 0.01, "b": 0.015, "b_state": 10.0, "v0": 1e-6, "delta_v": 9e-6}
    data = {
        "mu": ("sample", [0.6, 0.606, 0.597, 0.6 + end]),
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
        ({"theta": -5.0}, REPRODUCED, "-0.6931 to -0.6931 per unit of B"),
        ({}, CORRECTED, "0.6931 to 0.6931 per unit of B at the 4 samples"),
        ({"evolution": 0.003}, NOT_REPRODUCED, "after the step up varies by 0.2 per unit"),
    ],
)
def test_friction_falls_with_epsilon(given, verdict, words):
    """Itself by ln(theta/b + 1), only its change, or neither."""
    found = TESTS["friction_falls_with_epsilon"](a_velocity_step(**given))
    assert found.verdict == verdict
    assert words in found.evidence
