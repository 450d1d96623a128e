"""The answer to the question about real faults."""

import pytest
from made_up_results import (
    NO,
    YES,
    Results,
)

from scripts.studies.fault_limit.claims import hopf_by_delay_at_faults
from scripts.studies.fault_limit.finding import describe


@pytest.mark.parametrize(("depth", "verdict"), [(1e-17, NO), (1e-3, YES)])
def test_hopf_by_delay_at_faults(depth, verdict):
    """The widest interval decides, among the gamma of faults alone; to have none is an error."""
    point = {"xi": 0.5, "without_delay": 0.5, "depth": depth}
    rows = [point | {"gamma": 0.8, "depth": 0.1}, point | {"gamma": 1e4}]
    rows.append(point | {"gamma": 1e6, "depth": 1e-25})
    given = {"least": 1e4, "most": 1e12, "limit": 1e-6}
    found = hopf_by_delay_at_faults(Results(fault_limit=rows), **given)
    assert found.verdict == verdict
    assert f"by at most {depth:.2g}, at $gamma = 1e+04$, where" in found.evidence
    with pytest.raises(ValueError, match="no gamma from 1e"):
        hopf_by_delay_at_faults(Results(fault_limit=rows[:1]), **given)


def test_finding_has_the_numbers_of_the_tables():
    kinds = ("a", "hopf_without_delay"), ("b", "generalised_hopf"), ("c", "amplitude_death_begin")
    limit = {"xi": 0.5, "without_delay": 0.25}
    tables = {
        "hopf_points": [{"of": of, "kind": kind} for of, kind in kinds],
        "fault_limit": [
            limit | {"gamma": gamma, "depth": depth}
            for gamma, depth in ((0.8, 0.0481), (1e4, 9.3e-18))
        ],
    }
    found = describe(tables)
    # 10^3 (1 + 10)/(2 10^16) = 5.5e-13
    assert found["title"].endswith("narrower than 1e-12.")
    for words in ("$epsilon = 0.25$ for $xi = 0.5$", "by 0.048.", "9.3e-18 for", "5.5e-13 for"):
        assert words in found["words"]
    assert "Along the Hopf curves of 2 planes" in found["words"]
