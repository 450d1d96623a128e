"""The trajectory program: its file, and its numbers against another code."""

import re

import numpy as np
import pytest
import xarray as xr
from independent_chain import solve_chain

from conftest import ROOT, trajectory_settings


@pytest.fixture
def scene(good_inputs) -> dict:
    """A scene that the program accepts, to change."""
    return good_inputs["trajectory"]


@pytest.mark.parametrize("name", ["oscillation", "torus", "chaos"])
def test_scene_agrees_with_another_code(programs, scene, filled_config, name):
    """The paper's scenes over five delays; without delay and of chains: in the study of chains."""
    scene |= {**trajectory_settings(filled_config, name), "variables": ["theta", "u", "v"]}
    scene |= {"t_end": 5 * scene["tau"], "t_transient": 0.0, "sample_interval": 0.5}
    found = programs.made_by("trajectory", {**scene, "tolerance": 1e-11})
    history = {key: [value] for key, value in scene["history"].items()}
    states = solve_chain({**scene, **history, "kappa": 0.0, "ends": "free"}, scene["t_end"], 0.005)
    for place, values in enumerate((found.theta, found.u, np.log(found.v))):
        np.testing.assert_allclose(values, states[::100, place, 0], rtol=0, atol=1e-8)


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
    ("gamma", "epsilon", "tau"), [(1.5, 10.0, 0.1), (1e6, 0.9, 9.0), (1e10, 3.0, 0.0)]
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


@pytest.mark.parametrize("tau", [0.0, 10.0])
def test_steady_sliding_stays_exactly(programs, scene, tau):
    """(0, 0, 1) is the stationary state of (3) and (4)."""
    scene |= {"tau": tau, "history": {"theta": 0.0, "u": 0.0, "v": 1.0}}
    trajectory = programs.made_by("trajectory", scene)
    assert all((trajectory[name] == value).all() for name, value in scene["history"].items())


def test_attributes_tell_where_the_numbers_come_from(programs, scene):
    """All scene parameters, the method, its work, the program and the compiler."""
    scene |= {"tau": 9.5, "epsilon": 0.45, "xi": 0.85, "gamma": 0.75, "tolerance": 3e-8}
    scene |= {"history": {"theta": 0.1, "u": -0.2, "v": 1.3}, "t_end": 29.9}
    attributes = programs.made_by("trajectory", scene).attrs
    history = {f"history_{name}": value for name, value in scene.pop("history").items()}
    del scene["variables"]
    scene |= {"scene": scene.pop("name"), "model": scene.pop("law")}
    assert {key: attributes[key] for key in scene | history} == scene | history
    assert attributes["steps_accepted"] > 10
    assert attributes["steps_rejected"] >= 0
    assert attributes["evaluations"] > attributes["steps_accepted"] + attributes["steps_rejected"]
    build = (ROOT / "fortran" / "CMakeLists.txt").read_text()
    assert attributes["program_version"] == re.search(r"project\(.* VERSION (\S+)", build)[1]
    assert "GCC" in attributes["compiler"]


@pytest.mark.parametrize(
    ("t_end", "interval", "samples"),
    [(30.1, 0.25, 121), (29.99, 0.25, 120), (0.7, 0.1, 8), (1.0, 1.0, 2), (819.2, 0.1, 8193)],
)
def test_time_axis_counts_from_zero(programs, scene, t_end, interval, samples):
    """0, dt, 2 dt, ... up to t_end, also where it is no multiple of dt or blocks are full."""
    scene |= {"t_end": t_end, "t_transient": 0.0, "sample_interval": interval}
    t = programs.made_by("trajectory", scene).t.values
    assert t.size == samples
    assert t[-1] <= t_end
    np.testing.assert_allclose(t, interval * np.arange(samples), rtol=1e-15, atol=0)


@pytest.mark.parametrize("variables", [["v"], ["v", "theta"]])
def test_what_is_stored_does_not_change_the_numbers(programs, scene, variables):
    """Coarse samples of some variables are those of a run that stores all, to the last bit."""
    fine = programs.made_by("trajectory", {**scene, "sample_interval": 0.125})
    coarse = {**scene, "sample_interval": 1.0, "variables": variables}
    some = programs.made_by("trajectory", coarse)
    assert list(some.data_vars) == variables
    xr.testing.assert_equal(some, fine[variables].sel(t=some.t))
