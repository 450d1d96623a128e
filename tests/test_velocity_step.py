"""The velocity_step program: against the exact solution of (1.2) at constant velocity.

The suite velocity_step shows the direct and the evolution effect, and the rest of the state.
"""

from itertools import pairwise

import numpy as np
import pytest
import xarray as xr


@pytest.fixture
def protocol(config) -> dict:
    return config["velocity_step"]


@pytest.fixture
def response(programs, protocol) -> xr.Dataset:
    return programs.made_by("velocity_step", protocol)


def velocities(protocol: dict) -> list[float]:
    slow, fast = protocol["v0"], protocol["v0"] + protocol["delta_v"]
    return [slow, fast, slow]


def friction(protocol: dict, v, theta):
    """Equation (1.1)."""
    law = protocol
    direct = law["a"] * np.log(law["v0"] / v + 1)
    return law["mu0"] - direct + law["b"] * np.log(theta / law["b_state"] + 1)


def exact_states(protocol: dict, response: xr.Dataset) -> np.ndarray:
    """(1.2) solved: the state decays exponentially to Dc/v in each phase."""
    n, dc = protocol["samples"], protocol["dc"]
    theta, states = dc / protocol["v0"], []
    for phase, v in enumerate(velocities(protocol)):
        t = response.time.values[phase * n : (phase + 1) * n]
        states.append(dc / v + (theta - dc / v) * np.exp(-v * (t - t[0]) / dc))
        theta = states[-1][-1]
    return np.concatenate(states)


def test_response_is_the_exact_one(protocol, response):
    """The state decays exponentially, to 100 x tolerance; friction is (1.1) at that state."""
    expected = exact_states(protocol, response)
    np.testing.assert_allclose(response.theta, expected, rtol=100 * protocol["tolerance"])
    v = np.repeat(velocities(protocol), protocol["samples"])
    of_law = friction(protocol, v, response.theta.values)
    np.testing.assert_allclose(response.mu, of_law, rtol=1e-9)


def test_steps_are_imposed_by_the_protocol(protocol, response):
    n, dc = protocol["samples"], protocol["dc"]
    v = np.array(velocities(protocol))
    slip = dc * np.array([protocol["slip_before"], protocol["slip_after"], protocol["slip_after"]])
    np.testing.assert_array_equal(response.velocity, np.repeat(v, n))
    for name, lengths in (("slip", slip), ("time", slip / v)):
        ends = np.cumsum([0.0, *lengths])
        expected = [np.linspace(*span, n) for span in pairwise(ends)]
        np.testing.assert_allclose(response[name], np.concatenate(expected), rtol=1e-12)


def test_effects_are_the_jumps_of_friction(protocol, response):
    """The direct effect as the velocity rises, and the evolution effect after it."""
    n, mu = protocol["samples"], response.mu.values
    assert response.attrs["direct_effect"] == pytest.approx(mu[n] - mu[n - 1], rel=1e-9)
    assert response.attrs["evolution_effect"] == pytest.approx(mu[2 * n - 1] - mu[n], rel=1e-3)
