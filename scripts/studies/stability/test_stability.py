"""Scripts of the studies: tables from runs and references, and what their figures show."""

import math

import numpy as np
import pytest

from scripts.files.tsv import read_table, write_table
from scripts.namelists.laws import PAPER
from scripts.namelists.parameters import cases_of_family
from scripts.namelists.program_groups import case_groups, work_precision_groups
from scripts.namelists.write_namelist import end_at_horizons
from scripts.studies.work_precision.horizons_table import horizon, row_of
from scripts.studies.work_precision.table import proportionality
from scripts.tables.accuracy import (
    Reference,
    distances,
    errors_of,
    largest,
)

TABLES = ["stability", "work-precision", "tolerance-proportionality"]


@pytest.fixture(scope="module")
def tables(smoke) -> dict[str, list[dict]]:
    folder = smoke.folder / "results" / "tables"
    return {name: read_table(folder / f"{name}.tsv") for name in TABLES}


@pytest.fixture
def reference() -> Reference:
    time = np.arange(5.0)
    uncertainty = np.full(5, 1e-17)
    return Reference(
        status="ok",
        time=time,
        state=np.zeros((3, 5)),
        uncertainty=uncertainty,
        amplification=10.0**time,
    )


def made_up_run(errors: list[float]) -> dict:
    state = np.zeros((3, len(errors)))
    state[1] = errors
    time = np.arange(float(len(errors)))
    return {"case": "made up", "setting": 1e-13, "t_end": 4.0, "time": time, "state": state}


def test_table_is_read_as_written(tmp_path):
    rows = [{"a": "word", "b": 1.5e-9, "c": math.nan}, {"a": "two words", "b": 3.0, "c": 0.0}]
    write_table(tmp_path / "table.tsv", rows)
    assert (tmp_path / "table.tsv").read_text() == "a\tb\tc\nword\t1.5e-09\t\ntwo words\t3\t0\n"
    read = read_table(tmp_path / "table.tsv")
    assert read[0]["b"] == 1.5e-9
    assert math.isnan(read[0]["c"])
    assert read[1] == {"a": "two words", "b": 3.0, "c": 0.0}


def test_family_is_all_combinations():
    """Names say what differs, sample times divide the run."""
    lists = {"tau": [0.0, 1.0], "epsilon": [0.7], "xi": [0.5], "gamma": [1e4, 0.8]}
    history = {"theta": [0.0], "u": [0.0], "v": [1.1]}
    family = {**lists, **history, "law": PAPER, "t_end": 100.0, "samples": 200}
    config = {"laws": {}, "stability": {"families": {"made": family}}}
    cases = cases_of_family(config, "made")
    assert [case["name"] for case in cases] == [
        "made tau=0 gamma=10000",
        "made tau=0 gamma=0.8",
        "made tau=1 gamma=10000",
        "made tau=1 gamma=0.8",
    ]
    assert [case["sample_interval"] for case in case_groups(config, cases)["cases"]] == 4 * [0.5]


def test_errors_are_relative_above_one():
    """The largest over theta, u, ln v; the first sample of a run, its history, does not count."""
    state, known = np.array([[0.2], [50.0], [0.0]]), np.array([[0.1], [40.0], [0.0]])
    assert distances(state, known) == pytest.approx([0.25])
    assert largest(np.array([9.0, 1.0, np.nan, 2.0])) == 2.0
    assert math.isnan(largest(np.array([0.0, np.nan])))


def test_samples_at_other_times_are_refused(reference):
    """Two states at different times cannot be compared."""
    run = made_up_run([0.0, 0.0])
    run["time"] = np.array([0.0, 0.9])
    with pytest.raises(ValueError, match=r"case 'made up'.*different times"):
        errors_of(run, reference)


@pytest.mark.parametrize(
    ("errors", "sample"),
    [([0.0, 1e-12, 1e-9, 0.0, 0.0], 1), ([0.0, 1e-12, np.nan, 0.0, 0.0], 1), ([0.0] * 5, 4)],
)
def test_horizon_is_where_trust_ends(reference, errors, sample):
    """The last sample before the first error that is too large, or the end."""
    assert horizon(made_up_run(errors), reference, 1e-10) == sample


def test_uncertain_reference_ends_trust_too(reference):
    reference.uncertainty[3] = 1e-9
    assert horizon(made_up_run([0.0] * 5), reference, 1e-10) == 2


def test_row_of_a_horizon(reference):
    """The largest error and amplification up to there; a horizon at the start is refused."""
    row = row_of(made_up_run([0.0, 1e-12, 1e-11, 1e-9, 0.0]), reference, 1e-10)
    assert (row["horizon"], row["error"], row["amplification"]) == (2.0, 1e-11, 100.0)
    with pytest.raises(ValueError, match="no sample within the trusted error"):
        row_of(made_up_run([0.0, 1.0, 0.0, 0.0, 0.0]), reference, 1e-10)


def test_measured_runs_end_at_the_horizon(smoke_config):
    rows = [{"scene": "torus", "horizon": 17.0}, {"scene": "chaos", "horizon": 8.0}]
    groups = end_at_horizons(work_precision_groups(smoke_config, "chaos"), rows)
    assert [case["t_end"] for case in groups["cases"]] == [8.0]


def test_proportionality_is_the_slope_of_useful_errors():
    """Errors at rounding or of the size of the attractor do not count."""
    rows = [
        {"scene": "s", "solver": "a", "tolerance": 10.0**-k, "error_max": 5 * 10.0**-k}
        for k in range(1, 15)
    ]
    rows += [{"scene": "s", "solver": "b", "tolerance": 1e-3, "error_max": math.nan}]
    first, second = proportionality(rows)
    assert first["slope"] == pytest.approx(1.0)
    assert first["median_error_per_tolerance"] == pytest.approx(5.0)
    assert first["points"] == 10
    assert second["points"] == 0
    assert math.isnan(second["slope"])


def test_every_case_is_a_row_of_each_method(tables, smoke_config):
    """And ends ok or with a reason; no number only where there is none."""
    study = smoke_config["stability"]
    cases = [
        case["name"] for name in study["families"] for case in cases_of_family(smoke_config, name)
    ]
    rows = tables["stability"]
    assert [row["case"] for row in rows[:: len(study["methods"])]] == cases
    for row in rows:
        assert row["status"] == "ok" or "stopped at t = " in row["reason"]
        if row["status"] == "ok" and not row["reference"].startswith("none"):
            assert row["error"] >= 0
        if row["method"] == "auto" and row["error_expected"] >= 0:
            assert row["error"] < 1e3 * max(row["error_expected"], row["tolerance"])


def test_errors_fall_with_the_tolerance(tables, smoke_config):
    """Of the solver's methods on the mild scenes; the baseline has its order."""
    for row in tables["tolerance-proportionality"]:
        if row["scene"] in ("oscillation", "torus"):
            order = {"rk4_linear": 2.0, "rk4_cubic": 4.0}.get(row["solver"], 1.0)
            assert row["slope"] == pytest.approx(order, rel=0.35)
