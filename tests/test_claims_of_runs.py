"""Verdicts on stiffness and on the stationary state, on made-up runs."""

import numpy as np
import pytest
from made_up_results import NO, PARTLY, YES, Results, run_row

from scripts.claims.claims_of_runs import out_of_reach, stationary_state, stiffness_forbids

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
    """All long runs that decay must end there."""
    row = run_row(**{"reference": "exact stationary state, at t_end only", **given})
    assert stationary_state(Results(stability=[row]), within=1e-6).verdict == verdict
