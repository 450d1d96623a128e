"""Work against precision: horizons of trust, tables of errors."""

import math

import numpy as np
import pytest

from scripts.config.check_config import checked
from scripts.files.tsv import read_table
from scripts.requests.write_namelist import end_at_horizons
from scripts.studies.work_precision import figure as drawing
from scripts.studies.work_precision.horizons_table import horizon, row_of
from scripts.studies.work_precision.plan import cases_of, measurement_groups
from scripts.studies.work_precision.table import proportionality
from scripts.tables.accuracy import Reference
from scripts.workflow.plan import read_plan


@pytest.fixture
def reference() -> Reference:
    time, state, uncertainty = np.arange(5.0), np.zeros((3, 5)), np.full(5, 1e-17)
    found = {"time": time, "state": state, "uncertainty": uncertainty}
    return Reference(status="ok", amplification=10.0**time, **found)


def made_up_run(errors: list[float]) -> dict:
    state = np.zeros((3, len(errors)))
    state[1] = errors
    time = np.arange(float(len(errors)))
    return {"case": "made up", "setting": 1e-13, "t_end": 4.0, "time": time, "state": state}


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
    groups = end_at_horizons(measurement_groups(smoke_config, "chaos"), rows)
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


def test_errors_fall_with_the_tolerance(smoke):
    """Of the solver's methods on the mild scenes; the baseline has its order."""
    table = smoke.folder / "results" / "tables" / "tolerance-proportionality.tsv"
    for row in read_table(table):
        if row["scene"] in ("oscillation", "torus"):
            order = {"rk4_linear": 2.0, "rk4_cubic": 4.0}.get(row["solver"], 1.0)
            assert row["slope"] == pytest.approx(order, rel=0.35)


def test_numbers_of_work_and_precision():
    """The fastest method of each scene; other solvers count where their runs are as long."""
    base = {"scene": "mine", "t_end": 10.0, "tolerance": 1e-8}
    ours = [
        {**base, "solver": "slow", "error_max": 1e-9, "seconds": 4.0},
        {**base, "solver": "fast", "error_max": 1e-7, "seconds": 2.0},
        {**base, "solver": "rough", "error_max": 1e-3, "seconds": 1.0},
    ]
    ours.append({**ours[0], "scene": "other", "t_end": 5.0})
    others = [
        {**base, "solver": "ours", "error_max": 1e-9, "seconds": 1.0},
        {**base, "solver": "other", "error_max": 1e-9, "seconds": 6.0},
        {**base, "solver": "other", "error_max": 1e-9, "seconds": 3.0, "t_end": 5.0},
    ]
    found = drawing.numbers(ours, others, "2026-11-22")
    assert found["fastest"] == ["fast (in one scene)", "slow (in one scene)"]
    assert found["ratios"] == ["3", "3"]


def test_scenes_of_the_paper_are_measured_as_they_are(config):
    """With the parameters and the history of the scene, whatever these are."""
    config["scenes"]["torus"] |= {"epsilon": 0.4, "history": {"v": 1.3}}
    cases = cases_of(checked(config))
    assert list(cases) == ["fixed_point", "oscillation", "torus", "chaos", "stick", "stiff"]
    measured = cases["torus"]
    assert (measured["tau"], measured["epsilon"]) == (10.0, 0.4)
    assert measured["history"] == {"theta": 0.0, "u": 0.0, "v": 1.3}
    assert measured["t_end"] == 1000.0


def test_scene_of_the_paper_can_be_measured_alone(tmp_path):
    (tmp_path / "mine.yaml").write_text("work_precision: { scenes: { torus: { t_end: 20.0 } } }")
    plan = read_plan({"user_file": str(tmp_path / "mine.yaml")})
    assert "<results>/tables/exponents.tsv" not in plan.targets()
    config = plan.config
    assert list(config["work_precision"]["scenes"]) == ["torus"]
    assert list(config["scenes"]) == ["torus"]
