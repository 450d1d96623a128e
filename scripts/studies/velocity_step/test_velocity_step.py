"""The velocity step of Figure 8 against SciPy, with (1.1) and (1.2) written again."""

import numpy as np
import pytest
from made_up_results import NO, PARTLY, YES, assert_finding, cases
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
        found_there = {name: values[phase * n : (phase + 1) * n] for name, values in found.items()}
        times = np.linspace(start, start + length * dc / v, n)
        run = solve_ivp(
            lambda _, y, v=v: 1 - v * y / dc, times[[0, -1]], [theta], "DOP853", times,
            rtol=1e-12, atol=1e-12,
        )  # fmt: skip
        np.testing.assert_allclose(found_there["time"], times, rtol=1e-12)
        np.testing.assert_allclose(found_there["slip"], passed + v * (times - start), rtol=1e-12)
        np.testing.assert_array_equal(found_there["velocity"], v)
        np.testing.assert_allclose(found_there["theta"], run.y[0], rtol=1e-9)
        direct = step["a"] * np.log(v0 / v + 1)
        mu = step["mu0"] - direct + step["b"] * np.log(run.y[0] / step["b_state"] + 1)
        np.testing.assert_allclose(found_there["mu"], mu, rtol=1e-9)
        theta, start, passed = run.y[0, -1], times[-1], passed + length * dc


def test_effects_are_those_of_the_law_where_all_slip_has_passed(step):
    """From one steady state to the other, but for exp(-9) of the evolution effect."""
    v = step["v0"] + step["delta_v"]
    direct, evolution = effects_of(respond(step))
    assert direct == pytest.approx(step["a"] * np.log(2 / (step["v0"] / v + 1)), rel=1e-12)
    states = [step["dc"] / step["b_state"] / speed + 1 for speed in (v, step["v0"])]
    assert evolution == pytest.approx(step["b"] * np.log(states[0] / states[1]), rel=1e-3)


def a_step(direct=0.006, evolution=-0.009, theta=10.0, end=0.0, first=0.6, faster=1.0) -> dict:
    """Friction through a step of the velocity and back, at velocities `faster` than usual."""
    law = {"mu0": 0.6, "dc": 1e-5, "a": 0.01, "b": 0.015, "b_state": 10.0, "v0": 1e-6}
    mu = [first, first + direct, first + direct + evolution, 0.6 + end]
    velocity = [faster * v for v in (1e-6, 1e-5, 1e-5, 1e-6)]
    rows = [{"mu": m, "velocity": v, "theta": theta} for m, v in zip(mu, velocity, strict=True)]
    return {"velocity_step": [{**row, **law, "delta_v": 9e-6} for row in rows]}


STEADY = {
    "velocity_step": [row | {"velocity": 1e-5 / row["theta"]} for row in a_step()["velocity_step"]]
}
"""Sliding at Dc/theta, where both state laws are 0."""


@cases(
    (
        *("velocity_step", {}),
        *((a_step(), YES), (a_step(direct=-0.006), NO)),
        *((a_step(evolution=-0.003), NO), (a_step(end=0.01), NO)),
    ),
    (
        # in every state by (1.1), by B and by A; in steady sliding by (2), where v > v0
        *("friction_falls_with_epsilon", {}),
        (a_step(), PARTLY, "by 0.6931 to 0.6931 per unit of $B$, and by 0.09531 to"),
        (a_step(theta=-5.0), PARTLY, "by -0.6931 to -0.6931 per unit of $B$"),
        # ln 10 = 2.303
        (a_step(), PARTLY, "of the step, 10 $v0$, it changes by -2.303 per unit of $B - A$"),
        # both logarithms are negative
        *((a_step(theta=-5.0, faster=-5.0), YES), (a_step(faster=0.05), NO)),
    ),
    (
        # by the friction before the step, with what is left in numbers
        *("mu0_is_steady_friction", {"limit": 1e-6}),
        (a_step(), YES, "$-A ln 2 = -0.006931$ and $B ln(theta/b + 1) = 0.0104$"),
        (a_step(first=0.6035), NO, "it is $B ln(theta/b) = 0$."),
    ),
    (
        # theta = 10 s at v = 1e-5 m/s: x = 10, 1 - x and -x ln x
        *("same_state_law", {"limit": 1e-6}),
        (a_step(), NO, "most at $x = 10$: $d theta/dt = -9$ by (1.2) and -23.03 by (2)"),
        (STEADY, YES),
    ),
)
def test_verdicts(case):
    assert_finding(*case)
