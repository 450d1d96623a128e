"""Verdicts on runs, spectra and the friction law, on made-up ones."""

import numpy as np
import pytest
from made_up_results import NO, PARTLY, YES, Results, run_row, spectrum

from scripts.studies.velocity_step.claims import (
    friction_falls_with_epsilon,
    mu0_is_steady_friction,
    same_state_law,
    velocity_step,
)
from scripts.studies.stability.claims import out_of_reach, stationary_state, stiffness_forbids
from scripts.studies.power_spectra.claims import single_peak, spectrum_class

STOPPED = {"status": "too_many_steps", "error": np.nan, "error_expected": np.nan}
OTHERS = [run_row(gamma=1.0), run_row(method="explicit")]
"""Runs by another method, or at another gamma, than the claims are about."""


@pytest.mark.parametrize(
    ("test", "runs", "verdict", "words"),
    [
        (out_of_reach, [run_row(**STOPPED)], YES, "0 of 1 runs by the method auto"),
        (out_of_reach, [run_row(), run_row(**STOPPED)], NO, "1 of 2 runs"),
        (out_of_reach, [], NO, "0 of 0 runs"),
        (stiffness_forbids, [run_row(), run_row(error=1e-6)], NO, "2 have an error within"),
        (stiffness_forbids, [run_row(), run_row(**STOPPED)], PARTLY, "1 of 2 runs by the method"),
        (stiffness_forbids, [run_row(), run_row(error=0.1)], PARTLY, "1 have an error within"),
        (stiffness_forbids, [run_row(error=0.1)], YES, "1 of 1 runs"),
        (stiffness_forbids, [run_row(**STOPPED)], YES, "0 have an error of at most 0.001"),
        (stiffness_forbids, [], YES, "0 of 0 runs"),
    ],
)
def test_runs_at_the_gamma_of_faults(test, runs, verdict, words):
    """Out of reach if none is completed; stiffness forbids if none is solved within its error."""
    found = test(Results(stability=runs + OTHERS), method="auto", least=1e4, most=1e12)
    assert found.verdict == verdict
    assert words in found.evidence


@pytest.mark.parametrize(
    ("given", "verdict"),
    [
        ({"error": 1e-9}, YES),
        ({"error": 1e-3}, NO),
        ({"error": np.nan, "status": "too_many_steps"}, NO),
        ({"error": 1e-9, "reference": "none: a limit cycle over many periods"}, NO),
    ],
)
def test_stationary_state(given, verdict):
    row = run_row(**{"reference": "exact stationary state, at t_end only", **given})
    assert stationary_state(Results(stability=[row]), within=1e-6).verdict == verdict


@pytest.mark.parametrize(
    ("made", "verdict"),
    [
        (spectrum(x1=50.0), YES),
        (spectrum(x1=50.0, x2=0.4), YES),
        (spectrum(x1=50.0, x2=3.4), PARTLY),
        (spectrum("quasiperiodic", x1=50.0), NO),
        (spectrum("undecided", x1=50.0), NO),
        (spectrum("none"), NO),
    ],
)
def test_single_peak(made, verdict):
    """One fundamental frequency with harmonics of 0.8 or 6.8 % or none, or another spectrum."""
    assert single_peak(Results(spectra={"mine": made}), scene="mine").verdict == verdict


@pytest.mark.parametrize("kind", ["periodic", "quasiperiodic", "continuum", "undecided", "none"])
def test_spectrum_class(kind):
    made = Results(spectra={"mine": spectrum(kind, x1=1.0)})
    found = spectrum_class(made, scene="mine", expected="quasiperiodic")
    assert found.verdict == (YES if kind == "quasiperiodic" else NO)
    assert f"scene mine: {kind}." in found.evidence


def a_step(direct=0.006, evolution=-0.009, theta=10.0, end=0.0, first=0.6, faster=1.0) -> Results:
    """Friction through a step of the velocity and back, at velocities `faster` than usual."""
    law = {"mu0": 0.6, "dc": 1e-5, "a": 0.01, "b": 0.015, "b_state": 10.0, "v0": 1e-6}
    mu = [first, first + direct, first + direct + evolution, 0.6 + end]
    velocity = [faster * v for v in (1e-6, 1e-5, 1e-5, 1e-6)]
    rows = [{"mu": m, "velocity": v, "theta": theta} for m, v in zip(mu, velocity, strict=True)]
    return Results(velocity_step=[{**row, **law, "delta_v": 9e-6} for row in rows])


@pytest.mark.parametrize(
    ("given", "verdict"),
    [({}, YES), ({"direct": -0.006}, NO), ({"evolution": -0.003}, NO), ({"end": 0.01}, NO)],
)
def test_velocity_step(given, verdict):
    assert velocity_step(a_step(**given)).verdict == verdict


@pytest.mark.parametrize(
    ("given", "verdict", "words"),
    [
        ({"theta": 10.0}, PARTLY, "by 0.6931 to 0.6931 per unit of $B$, and by 0.09531 to"),
        ({"theta": -5.0}, PARTLY, "by -0.6931 to -0.6931 per unit of $B$"),
        # ln 10 = 2.303
        ({}, PARTLY, "of the step, 10 $v0$, it changes by -2.303 per unit of $B - A$"),
        # both logarithms are negative
        ({"theta": -5.0, "faster": -5.0}, YES, ""),
        ({"faster": 0.05}, NO, ""),
    ],
)
def test_friction_falls_with_epsilon(given, verdict, words):
    """In every state by (1.1), by B and by A; in steady sliding by (2), where v > v0."""
    found = friction_falls_with_epsilon(a_step(**given))
    assert found.verdict == verdict
    assert words in found.evidence


@pytest.mark.parametrize(("first", "verdict"), [(0.6, YES), (0.6035, NO)])
def test_mu0_is_steady_friction(first, verdict):
    """By the friction before the step, with what is left in numbers."""
    found = mu0_is_steady_friction(a_step(first=first), limit=1e-6)
    assert found.verdict == verdict
    assert "$-A ln 2 = -0.006931$ and $B ln(theta/b + 1) = 0.0104$" in found.evidence
    assert "it is $B ln(theta/b) = 0$." in found.evidence


def test_same_state_law():
    found = same_state_law(a_step(), limit=1e-6)
    assert found.verdict == NO
    # theta = 10 s at v = 1e-5 m/s: x = 10, 1 - x and -x ln x
    assert "most at $x = 10$: $d theta/dt = -9$ by (1.2) and -23.03 by (2)" in found.evidence
    made = a_step()
    for row in made.velocity_step:
        row["velocity"] = 1e-5 / row["theta"]
    assert same_state_law(made, limit=1e-6).verdict == YES


def test_scene_without_spectrum_is_an_error():
    with pytest.raises(ValueError, match=r"results/spectra: no file of scene 'other'.*: mine"):
        single_peak(Results(spectra={"mine": spectrum()}), scene="other")
