"""The velocity step of Figure 8 against SciPy, with (1.1) and (1.2) written again."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from scripts.studies.velocity_step.table import effects_of, respond


@pytest.fixture
def step(default_config) -> dict:
    return default_config["velocity_step"]


def test_response_is_that_of_scipy(step):
    """Each phase by integration of (1.2) from the end of the one before; friction is (1.1)."""
    found, n, dc, v0 = respond(step), step["samples"], step["dc"], step["v0"]
    theta, start, passed = dc / v0, 0.0, 0.0
    for phase, (v, length) in enumerate(
        [(v0, step["slip_before"]), *[(v, step["slip_after"]) for v in (v0 + step["delta_v"], v0)]]
    ):
        part = {name: values[phase * n : (phase + 1) * n] for name, values in found.items()}
        times = np.linspace(start, start + length * dc / v, n)
        run = solve_ivp(
            lambda _, y, v=v: 1 - v * y / dc, times[[0, -1]], [theta], "DOP853", times,
            rtol=1e-12, atol=1e-12,
        )  # fmt: skip
        np.testing.assert_allclose(part["time"], times, rtol=1e-12)
        np.testing.assert_allclose(part["slip"], passed + v * (times - start), rtol=1e-12)
        np.testing.assert_array_equal(part["velocity"], v)
        np.testing.assert_allclose(part["theta"], run.y[0], rtol=1e-9)
        direct = step["a"] * np.log(v0 / v + 1)
        mu = step["mu0"] - direct + step["b"] * np.log(run.y[0] / step["b_state"] + 1)
        np.testing.assert_allclose(part["mu"], mu, rtol=1e-9)
        theta, start, passed = run.y[0, -1], times[-1], passed + length * dc


def test_effects_are_those_of_the_law_where_all_slip_has_passed(step):
    """From one steady state to the other, but for exp(-9) of the evolution effect."""
    v = step["v0"] + step["delta_v"]
    direct, evolution = effects_of(respond(step))
    assert direct == pytest.approx(step["a"] * np.log(2 / (step["v0"] / v + 1)), rel=1e-12)
    states = [step["dc"] / step["b_state"] / speed + 1 for speed in (v, step["v0"])]
    assert evolution == pytest.approx(step["b"] * np.log(states[0] / states[1]), rel=1e-3)
