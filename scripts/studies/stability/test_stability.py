"""Stiff and extreme cases: families, their table, and verdicts on them."""

import copy

import numpy as np
import pytest
from made_up_results import NO, PARTLY, YES, assert_finding, cases, run_row

from scripts.claims.ledger import check_user_claims
from scripts.config.check_config import checked
from scripts.files.read_config import ConfigError
from scripts.files.tsv import read_table
from scripts.models.models import PAPER
from scripts.requests.program_groups import case_groups
from scripts.studies.stability import figure as drawing
from scripts.studies.stability.finding import describe
from scripts.studies.stability.plan import cases_of_family


def test_family_is_all_combinations():
    """Names say what differs, sample times divide the run."""
    lists = {"tau": [0.0, 1.0], "epsilon": [0.7], "xi": [0.5], "gamma": [1e4, 0.8]}
    history = {"theta": [0.0], "u": [0.0], "v": [1.1]}
    family = {**lists, "history": history, "law": PAPER, "t_end": 100.0, "samples": 200}
    config = {"laws": {}, "stability": {"families": {"made": family}}}
    cases = cases_of_family(config, "made")
    assert [case["name"] for case in cases] == [
        "made tau=0 gamma=10000",
        "made tau=0 gamma=0.8",
        "made tau=1 gamma=10000",
        "made tau=1 gamma=0.8",
    ]
    assert [case["sample_interval"] for case in case_groups(config, cases)["cases"]] == 4 * [0.5]


def test_every_case_is_a_row_of_each_method(smoke, smoke_config):
    """And ends ok or with a reason; no number only where there is none."""
    study = smoke_config["stability"]
    cases = [
        case["name"] for name in study["families"] for case in cases_of_family(smoke_config, name)
    ]
    rows = read_table(smoke.folder / "results" / "tables" / "stability.tsv")
    assert [row["case"] for row in rows[:: len(study["methods"])]] == cases
    for row in rows:
        assert row["status"] == "ok" or "stopped at t = " in row["reason"]
        if row["status"] == "ok" and not row["reference"].startswith("none"):
            assert row["error"] >= 0
        if row["method"] == "auto" and row["error_expected"] >= 0:
            assert row["error"] < 1e3 * max(row["error_expected"], row["tolerance"])


STOPPED = {"status": "too_many_steps", "error": np.nan, "error_expected": np.nan}
AT_FAULTS = {"method": "auto", "least": 1e4, "most": 1e12}


def runs(*given: dict) -> dict:
    """Results of runs, beside those of another gamma and of another method."""
    rows = [run_row(**one) for one in given]
    return {"stability": [*rows, run_row(gamma=1.0), run_row(method="explicit")]}


def long_run(reference: str = "exact stationary state, at t_end only", **given) -> dict:
    """Results of a long run that decays."""
    return {"stability": [run_row(reference=reference, **given)]}


@cases(
    (
        # out of reach if none is completed
        *("out_of_reach", AT_FAULTS),
        (runs(STOPPED), YES, "0 of 1 runs by the method auto"),
        *((runs({}, STOPPED), NO, "1 of 2 runs"), (runs(), NO, "0 of 0 runs")),
    ),
    (
        # stiffness forbids if none is solved within its error
        *("stiffness_forbids", AT_FAULTS),
        (runs({}, {"error": 1e-6}), NO, "2 have an error within"),
        (runs({}, STOPPED), PARTLY, "1 of 2 runs by the method"),
        (runs({}, {"error": 0.1}), PARTLY, "a case has an error of 0.1 at $t = 100$: it magnifies"),
        *((runs({"error": 0.1}), YES, "1 of 1 runs"), (runs(), YES, "0 of 0 runs")),
        (runs(STOPPED), YES, "0 have an error of at most 0.001"),
    ),
    (
        *("stationary_state", {"within": 1e-6}),
        *((long_run(error=1e-9), YES), (long_run(error=1e-3), NO)),
        (long_run(error=np.nan, status="too_many_steps"), NO),
        (long_run(error=1e-9, reference="none: a limit cycle over many periods"), NO),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


def test_numbers_of_stability():
    """Completed runs, and those with the error that is expected."""
    run = {"method": "auto", "tolerance": 1e-9, "error_expected": 1e-9}
    ended = [run | {"status": "ok", "error": error} for error in (1e-8, 2e-7)]
    found = drawing.numbers([*ended, run | {"status": "stopped", "error": 1.0}])
    counts = {"runs": 3, "completed": 2, "measured": 2, "within": 1}
    assert found["methods"] == [{"name": "auto", **counts}]


@pytest.mark.parametrize("holds", [True, False])
def test_finding_follows_the_table(holds):
    """The title says the opposite if the results do."""
    runs = ((1e4, "auto", "ok"), (1e12, "explicit", "stopped"), (0.8, "auto", "stopped"))
    rows = [
        {"gamma": gamma, "method": method, "status": status, "steps": 7.0, "error": 15.0}
        for gamma, method, status in runs
    ]
    found = describe({"stability": rows if holds else rows[1:]})
    assert ("not" in found["title"]) is not holds
    assert ("In 1 of them the problem magnifies errors beyond 0.001" in found["words"]) is holds


def test_claim_about_an_empty_range_is_refused(default_config):
    values = {"method": "auto", "least": 1e13, "most": 1e12}
    claim = {"place": "here", "claim": "So.", "look_at": "stability.tsv"}
    said = {"mine": {**claim, "test": {"out_of_reach": values}}}
    words = "least = 10000000000000.0; expected a finite number <= most = 1000000000000.0"
    with pytest.raises(ConfigError, match=words):
        check_user_claims(said, checked(copy.deepcopy(default_config)), set())
