"""Verdicts on stiffness and on the stationary state, on made-up runs."""

import numpy as np
import pytest
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
    ("runs", "verdict", "words"),
    [
        ([run_row(), run_row(error=1e-6)], NOT_REPRODUCED, "2 have an error within"),
        ([run_row(), run_row(**STOPPED)], CORRECTED, "1 of 2 runs by the method auto"),
        ([run_row(), run_row(error=0.1)], CORRECTED, "1 have an error within"),
        ([run_row(error=0.1)], REPRODUCED, "1 of 1 runs"),
        ([run_row(**STOPPED)], REPRODUCED, "0 have an error of at most 0.001"),
        ([], REPRODUCED, "0 of 0 runs"),
    ],
)
def test_stiffness_forbids(runs, verdict, words):
    """Not where every run is solved; one that stops or is wrong shows."""
    made = results(stability=runs + OTHERS)
    found = TESTS["stiffness_forbids"](made, method="auto", least=1e4, most=1e12)
    assert found.verdict == verdict
    assert words in found.evidence


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
