"""The programs measure and reference: files, refusals, and their numbers against SciPy."""

import csv
import math

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import solve_ivp

from scripts.namelists.write_namelist import write_groups

CASES = {
    "name": ["decay", "stiff"],
    "tau": [0.0, 1.0],
    "epsilon": [0.3, 0.7],
    "xi": [0.8, 0.5],
    "gamma": [0.8, 100.0],
    "theta": [0.1, 0.0],
    "u": [0.2, 0.0],
    "v": [1.5, 1.1],
    "t_end": [20.0, 5.0],
    "sample_interval": [0.5, 0.5],
}
MEASURE = {
    "methods": ["auto", "explicit", "rk4_cubic"],
    "tolerances": [1e-6, 1e-9],
    "steps": [0.01],
    "most_steps": 1000,
    "repeats": 2,
    "least_seconds": 1e-4,
}
REFERENCE = {
    "method": "radau13",
    "tolerance": 1e-18,
    "check_tolerance": 1e-16,
    "disturbance": 1e-15,
    "most_steps": 100000,
}
GROUP_OF = {"measure": ("measure", MEASURE), "reference": ("reference", REFERENCE)}


@pytest.fixture
def run(programs):
    """Run a program on the cases, some values of its groups changed."""

    def run_changed(program: str, cases: dict | None = None, **changes):
        group, values = GROUP_OF[program]
        listed = {**CASES, **(cases or {})}
        groups = {"cases_list": listed, group: {**values, **changes}}
        groups = {
            name: {key: value for key, value in content.items() if value is not None}
            for name, content in groups.items()
        }
        write_groups(programs.folder / "input.nml", groups)
        return programs.run(program, "input.nml", programs.output.name)

    return run_changed


def refusal(programs, finished) -> str:
    """The one line with which a program refused, after which nothing may be left."""
    assert finished.returncode == 1
    assert programs.left_behind() == []
    (line,) = finished.stderr.splitlines()
    assert line.startswith("error: input.nml: ")
    return line


def rows_of(path) -> list[dict]:
    """Rows of a table of references."""
    with open(path) as file:
        return list(csv.DictReader(file, delimiter="\t"))


@pytest.fixture
def measured(programs, run) -> xr.Dataset:
    """Measured runs of the cases."""
    finished = run("measure")
    assert (finished.returncode, finished.stdout, finished.stderr) == (0, "", "")
    return xr.load_dataset(programs.output)


@pytest.fixture
def references(programs, run) -> list[dict]:
    """References of the cases."""
    finished = run("reference")
    assert (finished.returncode, finished.stdout, finished.stderr) == (0, "", "")
    return rows_of(programs.output)


def test_each_method_runs_at_each_setting(measured):
    """In the order asked for, one case after the other."""
    settings = list(zip(measured.method.values, measured.setting.values, strict=True))
    solver = [(name, value) for name in ("auto", "explicit") for value in (1e-6, 1e-9)]
    expected = 2 * [*solver, ("rk4_cubic", 0.01)]
    assert [(name.strip(), value) for name, value in settings] == expected
    assert [str(name).strip() for name in measured.case.values] == 5 * ["decay"] + 5 * ["stiff"]


def test_failed_run_is_a_row_with_its_reason(measured):
    """The solver's own words, samples up to there and none after."""
    explicit = measured.isel(run=7)
    assert str(explicit.status.values).strip() == "too_many_steps"
    assert "1000 steps (most_steps) were used up" in str(explicit.reason.values)
    assert float(explicit.t_reached) < 5.0
    assert math.isnan(explicit.theta[10])
    ok = measured.isel(run=5)
    assert str(ok.status.values).strip() == "ok"
    assert str(ok.reason.values).strip() == ""
    assert float(ok.t_reached) == 5.0


def test_samples_stand_at_their_times(measured):
    """A shorter case is filled up with no numbers."""
    np.testing.assert_array_equal(measured.time[0], 0.5 * np.arange(41))
    np.testing.assert_array_equal(measured.time[5, :11], 0.5 * np.arange(11))
    assert np.isnan(measured.time[5, 11:]).all()
    assert np.isnan(measured.ln_v[5, 11:]).all()


def test_counts_and_extremes(measured):
    """Steps, evaluations and ln v of a run that is right; a series counts as one evaluation."""
    run = measured.isel(run=3)
    assert run.steps_accepted > 20
    assert run.evaluations > 10 * run.steps_accepted
    series = measured.isel(run=1)
    assert series.steps_accepted < series.evaluations < run.evaluations
    assert run.least_ln_v <= run.ln_v.min()
    assert run.most_ln_v >= run.ln_v.max()
    assert measured.isel(run=4).evaluations == 4 * 2000 + 1


def test_seconds_are_those_of_one_run(measured):
    """Short, but not nothing."""
    assert (measured.seconds > 0).all()
    assert (measured.seconds < 1).all()


def test_same_bytes_but_for_seconds(programs, run, measured):
    """A second run gives the same numbers."""
    run("measure")
    again = xr.load_dataset(programs.output)
    xr.testing.assert_identical(again.drop_vars("seconds"), measured.drop_vars("seconds"))


def test_reference_against_scipy(references):
    """Without delay, an integrator of others at its tightest."""
    rows = [row for row in references if row["case"] == "decay"]
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


def test_reference_states_its_uncertainty(references):
    """Far below double precision, and the magnification of a disturbance is 1 at the start."""
    assert len(references) == 41 + 11
    assert {row["status"] for row in references} == {"ok"}
    assert max(float(row["uncertainty"]) for row in references) < 1e-15
    first = references[0]
    assert float(first["amplification"]) == pytest.approx(1.0, abs=1e-3)
    assert all(len(row["u"].split("E")[0].lstrip("-")) >= 20 for row in references)


def test_measured_errors_follow_from_references(measured, references):
    """The tighter run is the nearer one, and both are near."""
    known = np.array([float(row["ln_v"]) for row in references if row["case"] == "decay"])
    loose, tight = (np.abs(measured.ln_v[i].values - known).max() for i in (0, 1))
    assert tight < loose < 1e-4
    assert tight < 1e-7


def test_reference_that_stops_says_so(programs, run):
    """A singularity of the problem: no samples after it, and the status in each row."""
    fast = {"v": [1e6, 1.1], "gamma": [0.8, 0.8], "epsilon": [0.5, 0.7], "theta": [0.0, 0.0]}
    fast["u"] = [0.0, 0.0]
    assert run("reference", fast).returncode == 0
    rows = [row for row in rows_of(programs.output) if row["case"] == "decay"]
    assert {row["status"] for row in rows} == {"step_underflow"}
    assert rows[-1]["u"] == "NaN"


@pytest.mark.parametrize("program", GROUP_OF)
@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("tau", [-1.0, 1.0], "case 'decay': tau = -1.0; expected a finite number >= 0.0"),
        ("epsilon", [0.3, -1.0], "case 'stiff': epsilon = -1.0; expected"),
        ("xi", [0.0, 0.5], "xi = 0.0; expected"),
        ("gamma", [0.8], "case 'stiff': gamma = NaN; expected"),
        ("theta", [math.inf, 0.0], "theta = Inf; expected"),
        ("u", [0.0, math.nan], "u = NaN; expected"),
        ("v", [0.0, 1.1], "v = 0.0; expected a finite number > 0.0"),
        ("t_end", [0.0, 5.0], "t_end = 0.0; expected"),
        ("sample_interval", [30.0, 0.5], "sample_interval = 30.0; expected"),
        ("sample_interval", [1e-7, 0.5], "number of samples t_end/sample_interval"),
        ("name", ["decay", "decay"], "name = 'decay' twice; expected each once"),
        ("name", ["a" * 65, "b"], "name of 65 letters; expected 1 to 64"),
        ("name", ["", ""], "name: no case; expected at least one"),
        ("colour", [1.0], "namelist group &cases_list: "),
    ],
)
def test_bad_case_is_refused(programs, run, program, key, value, words):
    """The line names file, case, key, value and range."""
    assert words in refusal(programs, run(program, {key: value}))


@pytest.mark.parametrize(
    ("program", "key", "value", "words"),
    [
        ("measure", "methods", ["euler"], "methods = 'euler'; expected one of 'auto' "),
        ("measure", "methods", ["auto", "rk4_cubicx"], "methods = 'rk4_cubicx'; expected"),
        ("measure", "methods", None, "methods = ''; expected one of"),
        ("measure", "tolerances", [1e-3, 1e-14], "tolerances = 1.0E-014; expected"),
        ("measure", "tolerances", None, "tolerances = NaN; expected"),
        ("measure", "steps", [0.1, 0.0], "steps = 0.0; expected"),
        ("measure", "steps", None, "steps = NaN; expected"),
        ("measure", "most_steps", 0, "most_steps = 0; expected a whole number >= 1"),
        ("measure", "most_steps", None, "most_steps = -1; expected"),
        ("measure", "repeats", -1, "repeats = -1; expected a whole number >= 0"),
        ("measure", "least_seconds", -1.0, "least_seconds = -1.0; expected"),
        ("measure", "colour", 1, "namelist group &measure: "),
        ("reference", "method", "rk4_cubic", "method = 'rk4_cubic'; expected one of"),
        ("reference", "tolerance", 1e-23, "tolerance = 1.0E-023; expected"),
        ("reference", "tolerance", None, "tolerance = NaN; expected"),
        ("reference", "check_tolerance", 1e-18, "check_tolerance = 1.0E-018; expected"),
        ("reference", "disturbance", 0.0, "disturbance = 0.0; expected"),
        ("reference", "most_steps", 0, "most_steps = 0; expected"),
        ("reference", "colour", 1, "namelist group &reference: "),
    ],
)
def test_bad_setting_is_refused(programs, run, program, key, value, words):
    """The line names file, key, value and range."""
    assert words in refusal(programs, run(program, **{key: value}))


@pytest.mark.parametrize("program", GROUP_OF)
def test_arguments_and_paths(programs, run, program):
    """Two arguments, a namelist that is there, a folder for the output."""
    assert run(program).returncode == 0
    programs.output.unlink()
    for arguments, words in [
        ([], f"{program} NAMELIST OUTPUT"),
        (["nowhere.nml", "output.nc"], "nowhere.nml"),
        (["input.nml", "nowhere/output.nc"], "nowhere/output.nc"),
    ]:
        finished = programs.run(program, *arguments)
        assert finished.returncode == 1
        assert words in finished.stderr
        assert programs.left_behind() == []
