"""The programs measure and reference: files, refusals, and their numbers against SciPy."""

import csv
import math

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import solve_ivp


@pytest.fixture
def measured(programs, good_groups) -> xr.Dataset:
    return programs.made_of("measure", good_groups["measure"])


def references_of(programs, groups: dict[str, dict]) -> list[dict]:
    done = programs.run_groups("reference", groups)
    assert done.returncode == 0, done.stderr
    with open(programs.output) as file:
        return list(csv.DictReader(file, delimiter="\t"))


def test_measured_runs(measured):
    """Each method at each setting, in the order of the namelist, one case after the other. A series
    counts as one evaluation; a shorter case is filled up with NaN."""
    settings = list(zip(measured.method.values, measured.setting.values, strict=True))
    solver = [(name, value) for name in ("auto", "explicit") for value in (1e-6, 1e-9)]
    assert settings == 2 * [*solver, ("rk4_cubic", 0.01)]
    assert measured.case.values.tolist() == 5 * ["decay"] + 5 * ["stiff"]
    assert ((measured.seconds > 0) & (measured.seconds < 1)).all()
    np.testing.assert_array_equal(measured.time[0], 0.5 * np.arange(41))
    np.testing.assert_array_equal(measured.time[5, :11], 0.5 * np.arange(11))
    assert np.isnan(measured.time[5, 11:]).all()
    assert np.isnan(measured.ln_v[5, 11:]).all()
    series, run = measured.isel(run=1), measured.isel(run=3)
    assert series.steps_accepted < series.evaluations < run.evaluations
    assert run.evaluations > 10 * run.steps_accepted > 200
    assert run.least_ln_v <= run.ln_v.min() < run.ln_v.max() <= run.most_ln_v
    assert measured.isel(run=4).evaluations == 4 * 2000 + 1


def test_failed_run_is_a_row_with_its_reason(measured):
    """The solver's own words, samples up to there and none after."""
    explicit = measured.isel(run=7)
    assert explicit.status == "too_many_steps"
    assert "1000 steps (most_steps) were used up" in str(explicit.reason.values)
    assert float(explicit.t_reached) < 5.0
    assert math.isnan(explicit.theta[10])
    ok = measured.isel(run=5)
    assert (ok.status, ok.reason, float(ok.t_reached)) == ("ok", "", 5.0)


def test_reference_against_scipy(programs, good_groups):
    """Without delay, an integrator of others at its tightest. The uncertainty is far below double
    precision, and the magnification of a disturbance is 1 at the start."""
    rows = references_of(programs, good_groups["reference"])
    assert len(rows) == 41 + 11
    assert {row["status"] for row in rows} == {"ok"}
    assert max(float(row["uncertainty"]) for row in rows) < 1e-15
    assert float(rows[0]["amplification"]) == pytest.approx(1.0, abs=1e-3)
    assert all(len(row["u"].split("E")[0].lstrip("-")) >= 20 for row in rows)
    rows = [row for row in rows if row["case"] == "decay"]
    times = np.array([float(row["time"]) for row in rows])
    state = np.array([[float(row[name]) for name in ("theta", "u", "ln_v")] for row in rows]).T

    def slopes(_, y):
        theta, u, w = y
        v = np.exp(w)
        return [-v * (theta + 1.3 * w), v - 1, -(0.8**2) / v * (u + (theta + w) / 0.8)]

    start = [0.1, 0.2, math.log(1.5)]
    tight = {"method": "DOP853", "rtol": 3e-14, "atol": 1e-15}
    solved = solve_ivp(slopes, (0.0, 20.0), start, t_eval=times, **tight)
    np.testing.assert_allclose(state, solved.y, rtol=0, atol=3e-13)


def test_reference_that_stops_says_so(programs, good_groups):
    """A singularity of the problem: no samples after it, and the status in each row."""
    groups = good_groups["reference"]
    fast = {"v": 1e6, "gamma": 0.8, "epsilon": 0.5, "theta": 0.0, "u": 0.0}
    for key, value in fast.items():
        groups["cases"][key][0] = value
    rows = [row for row in references_of(programs, groups) if row["case"] == "decay"]
    assert {row["status"] for row in rows} == {"step_underflow"}
    assert rows[-1]["u"] == "NaN"
