"""The trajectory program: its file, and its numbers against SciPy's integrator."""

import re
import time

import numpy as np
import pytest
import xarray as xr
from conftest import ROOT, of_trajectory
from scipy.integrate import solve_ivp

from scripts.config.check_config import checked

VARIABLES = ["theta", "u", "v"]
TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}
DELAYED = ["oscillation", "torus", "chaos"]


@pytest.fixture
def scene(good_inputs) -> dict:
    """A scene that the program accepts, to change."""
    return good_inputs["trajectory"]


def slopes(scene: dict, state: np.ndarray, delayed_v: float) -> list[float]:
    """Equation (4) as corrected, in v itself."""
    theta, u, v = state
    return [
        -v * (theta + (1 + scene["epsilon"]) * np.log(delayed_v)),
        v - 1,
        -(scene["gamma"] ** 2) * (u + (theta + np.log(v)) / scene["xi"]),
    ]


def without_delay(scene: dict, times: np.ndarray) -> np.ndarray:
    """Equation (3) by SciPy; shape (3, times)."""
    start = [scene["history"][name] for name in VARIABLES]
    span = (0.0, times[-1])
    run = solve_ivp(lambda t, y: slopes(scene, y, y[2]), span, start, t_eval=times, **TIGHT)
    return run.y


def by_method_of_steps(scene: dict, times: np.ndarray) -> np.ndarray:
    """Equation (4) by SciPy, one delay after the other; shape (3, times)."""
    tau = scene["tau"]
    state = np.array([scene["history"][name] for name in VARIABLES])
    values = np.empty((3, times.size))

    def past(t):
        return scene["history"]["v"]

    for n in range(int(np.ceil(times[-1] / tau))):
        span = (n * tau, (n + 1) * tau)
        run = solve_ivp(
            lambda t, y, past=past: slopes(scene, y, past(t - tau)),
            span,
            state,
            dense_output=True,
            **TIGHT,
        )
        inside = (times >= span[0]) & (times <= span[1])
        if inside.any():
            values[:, inside] = run.sol(times[inside])
        state = run.y[:, -1]

        def past(t, piece=run.sol):
            return piece(t)[2]

    return values


def values_of(trajectory: xr.Dataset) -> np.ndarray:
    """theta, u and v; shape (3, times)."""
    return np.array([trajectory[name].values for name in VARIABLES])


@pytest.mark.parametrize("tolerance", [1e-6, 1e-9])
def test_without_delay_agrees_with_scipy(programs, scene, config, tolerance):
    """The fixed-point scene, to 100 x tolerance."""
    scene |= {**of_trajectory(checked(config), "fixed_point"), "variables": VARIABLES}
    scene |= {"t_end": 100.0, "t_transient": 0.0, "tolerance": tolerance}
    trajectory = programs.made_by("trajectory", scene)
    expected = without_delay(scene, trajectory.t.values)
    np.testing.assert_allclose(values_of(trajectory), expected, rtol=0, atol=100 * tolerance)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-9])
@pytest.mark.parametrize("name", DELAYED)
def test_with_delay_agrees_with_scipy(programs, scene, config, name, tolerance):
    """The paper's delayed scenes over five delays, to 100 x tolerance."""
    scene |= {**of_trajectory(checked(config), name), "variables": VARIABLES}
    scene |= {"t_end": 5 * scene["tau"], "t_transient": 0.0, "tolerance": tolerance}
    assert scene["history"] == {"theta": 0.0, "u": 0.0, "v": 1.1}
    trajectory = programs.made_by("trajectory", scene)
    expected = by_method_of_steps(scene, trajectory.t.values)
    np.testing.assert_allclose(values_of(trajectory), expected, rtol=0, atol=100 * tolerance)


@pytest.mark.parametrize("tau", [1e-3, 0.37, 29.9, 31.0])
def test_delays_of_any_length_agree_with_scipy(programs, scene, tau):
    """Below a step, no multiple of a sample, nearly and more than the whole run."""
    scene |= {"tau": tau, "t_end": min(30.0, 200 * tau), "t_transient": 0.0}
    scene["sample_interval"] = scene["t_end"] / 64
    trajectory = programs.made_by("trajectory", scene)
    expected = by_method_of_steps(scene, trajectory.t.values)
    np.testing.assert_allclose(values_of(trajectory), expected, rtol=0, atol=1e-7)


def test_maxima_of_fast_events_are_stored(programs, good_inputs, scene):
    """Events shorter than the interval, of a cycle with two maxima; `slip_events` locates those."""
    scene |= {"tau": 9.0, "epsilon": 0.9, "xi": 0.5, "gamma": 1e6, "t_end": 900.0}
    scene |= {"t_transient": 600.0, "sample_interval": 0.05}
    events = good_inputs["slip_events"]
    found = programs.made_by("slip_events", {key: scene.get(key, events[key]) for key in events})
    v = programs.made_by("trajectory", scene).v
    ends = zip(found.onset.values, (found.onset + found.duration).values, strict=True)
    stored = [float(v.sel(t=slice(*event)).max()) for event in ends]
    assert len(stored) > 20
    np.testing.assert_allclose(stored, found.peak_velocity, rtol=5e-3)


@pytest.mark.parametrize(
    ("gamma", "epsilon", "tau"),
    [(1.5, 10.0, 0.1), (1e4, 3.0, 0.1), (1e6, 3.0, 0.0), (1e6, 0.9, 9.0), (1e10, 3.0, 0.0)],
)
def test_samples_follow_the_motion(programs, scene, gamma, epsilon, tau):
    """Between two of them v changes by a small part of its range, and even times are among them."""
    scene |= {"tau": tau, "epsilon": epsilon, "xi": 0.5, "gamma": gamma, "t_end": 600.0}
    scene |= {"t_transient": 0.0, "sample_interval": 0.05}
    trajectory = programs.made_by("trajectory", scene)
    t, v = trajectory.t.values, trajectory.v.values
    assert v.max() > 10
    assert np.abs(np.diff(v)).max() < 0.15 * v.max()
    assert (np.diff(t) > 0).all()
    assert np.isin(0.05 * np.arange(12001), t).all()
    assert t.size < 2.5 * 12001


def test_history_of_all_variables_is_taken(programs, scene):
    """A start far from steady sliding, against SciPy."""
    scene["history"] = {"theta": 0.3, "u": -0.2, "v": 0.7}
    trajectory = programs.made_by("trajectory", scene)
    expected = by_method_of_steps(scene, trajectory.t.values)
    np.testing.assert_allclose(values_of(trajectory)[:, 0], [0.3, -0.2, 0.7], rtol=1e-15)
    np.testing.assert_allclose(values_of(trajectory), expected, rtol=0, atol=1e-7)


@pytest.mark.parametrize("tau", [0.0, 10.0])
def test_steady_sliding_stays_exactly(programs, scene, tau):
    """(0, 0, 1) is the stationary state of (3) and (4)."""
    scene |= {"tau": tau, "history": {"theta": 0.0, "u": 0.0, "v": 1.0}}
    trajectory = programs.made_by("trajectory", scene)
    assert (trajectory.theta == 0).all()
    assert (trajectory.u == 0).all()
    assert (trajectory.v == 1).all()


def test_file_has_one_coordinate_and_the_variables(programs, scene):
    """Dimension and coordinate `t`, everything nondimensional and named."""
    trajectory = programs.made_by("trajectory", scene)
    assert dict(trajectory.sizes) == {"t": 121}
    assert list(trajectory.coords) == ["t"]
    assert list(trajectory.data_vars) == VARIABLES
    for variable in trajectory.variables.values():
        assert variable.dims == ("t",)
        assert variable.dtype == np.float64
        assert variable.attrs["units"] == "1"
        assert variable.attrs["long_name"]


def test_attributes_tell_where_the_numbers_come_from(programs, scene):
    """All scene parameters, the method, its work, the program and the compiler."""
    scene |= {"tau": 9.5, "epsilon": 0.45, "xi": 0.85, "gamma": 0.75, "tolerance": 3e-8}
    scene |= {"history": {"theta": 0.1, "u": -0.2, "v": 1.3}, "t_end": 29.9}
    attributes = programs.made_by("trajectory", scene).attrs
    history = {f"history_{name}": value for name, value in scene.pop("history").items()}
    del scene["variables"]
    scene["scene"] = scene.pop("name")
    assert {key: attributes[key] for key in scene | history} == scene | history
    assert attributes["steps_accepted"] > 10
    assert attributes["steps_rejected"] >= 0
    assert attributes["evaluations"] > attributes["steps_accepted"] + attributes["steps_rejected"]
    build = (ROOT / "fortran" / "CMakeLists.txt").read_text()
    assert attributes["program_version"] == re.search(r"project\(.* VERSION (\S+)", build)[1]
    assert "GCC" in attributes["compiler"]


@pytest.mark.parametrize(
    ("t_end", "interval", "samples"),
    [
        (30.0, 0.25, 121),
        (30.1, 0.25, 121),
        (29.99, 0.25, 120),
        (0.3, 0.1, 4),
        (0.7, 0.1, 8),
        (8.0, 8.0, 2),
        (8.0, 5.0, 2),
        (819.1, 0.1, 8192),
        (819.2, 0.1, 8193),
        (1638.4, 0.1, 16385),
    ],
)
def test_time_axis_counts_from_zero(programs, scene, t_end, interval, samples):
    """0, dt, 2 dt, ... up to t_end, also where it is no multiple of dt or blocks are full."""
    scene |= {"t_end": t_end, "t_transient": 0.0, "sample_interval": interval}
    t = programs.made_by("trajectory", scene).t.values
    assert t.size == samples
    assert t[-1] <= t_end
    np.testing.assert_allclose(t, interval * np.arange(samples), rtol=1e-15, atol=0)


def test_sampling_does_not_change_the_numbers(programs, scene):
    """Coarse samples are the fine ones left out, to the last bit."""
    fine = programs.made_by("trajectory", {**scene, "sample_interval": 0.125})
    coarse = programs.made_by("trajectory", {**scene, "sample_interval": 1.0})
    xr.testing.assert_equal(coarse, fine.sel(t=coarse.t))


@pytest.mark.parametrize("variables", [["v"], ["v", "theta"], ["u"], ["u", "v", "theta"]])
def test_only_listed_variables_are_stored(programs, scene, variables):
    """And they are the same, to the last bit."""
    everything = programs.made_by("trajectory", scene)
    some = programs.made_by("trajectory", {**scene, "variables": variables})
    assert list(some.data_vars) == variables
    xr.testing.assert_equal(some, everything[variables])


def test_two_runs_make_the_same_bytes(programs, scene):
    """Also in another second, in which NetCDF could keep a time stamp."""
    programs.made_by("trajectory", scene)
    first = programs.output.read_bytes()
    time.sleep(1.1)
    programs.made_by("trajectory", scene)
    assert programs.output.read_bytes() == first


def test_auto_is_the_taylor_method_here(programs, scene):
    """The block gives its series, and these scenes are not stiff."""
    auto = programs.made_by("trajectory", {**scene, "method": "auto"})
    taylor = programs.made_by("trajectory", {**scene, "method": "taylor"})
    assert auto.attrs["steps_implicit"] == taylor.attrs["steps_implicit"] == 0
    xr.testing.assert_equal(auto, taylor)


def test_tighter_tolerance_takes_more_steps(programs, scene):
    """The order of the explicit pair: about 10^(3/8) times as many for each factor of 1000."""
    scene["method"] = "explicit"
    steps = [
        programs.made_by("trajectory", {**scene, "tolerance": tolerance}).attrs["steps_accepted"]
        for tolerance in (1e-6, 1e-9, 1e-12)
    ]
    ratios = np.divide(steps[1:], steps[:-1])
    assert (ratios > 1.5).all()
    assert (ratios < 4.0).all()
