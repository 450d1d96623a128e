# SPDX-License-Identifier: BSD-3-Clause
"""Events that change the state, in texts: exact solutions, and what is refused."""

import math

import delaykit as dk
import numpy as np
import pytest

METHODS = ("auto", "bs5", "dop853", "taylor", "radau5", "radau9", "radau13")


@pytest.fixture(scope="module")
def ball(cache) -> dk.Model:
    """A ball that is e times as fast after a bounce, and its velocity a quarter later."""
    bounce = {"when": "y = 0 falling", "set": {"v": "-e*v"}}
    equations = {"y": "v", "v": "-1", "late": "v(t - 1/4)"}
    return dk.Model(equations, {"e": 0.5}, events=bounce, name="ball")


@pytest.mark.parametrize("method", METHODS)
def test_ball(ball, method):
    """From height 1/2 it bounces at 1, 2, 2.5, 2.75 and 2.875."""
    past = {"y": 0.5, "v": 0, "late": 0}
    times = np.linspace(0, 2.9, 59)
    run = ball.integrate(past, 2.9, t_eval=times, method=method, events="y = 0 falling")
    bounces = 3 - 2.0 ** (1 - np.arange(6))

    def height(t):
        k = np.searchsorted(bounces, t, side="right")
        since, speed = t - bounces[k - 1], 0.5**k
        return np.where(k == 0, 0.5 - t**2 / 2, since * (speed - since / 2))

    assert np.allclose(run.y[0], height(times), rtol=0, atol=2e-8)
    assert np.allclose(run.y[2], height(np.maximum(times - 0.25, 0)) - 0.5, rtol=0, atol=2e-8)
    for times, states in zip(run.t_events, run.y_events, strict=True):
        assert np.allclose(times, bounces[:-1], rtol=0, atol=1e-8)
        assert np.allclose(states[:, 1], -(0.5 ** np.arange(5)), rtol=0, atol=1e-7)
    assert run.switches == {"y = 0 falling": 5}
    first = ball.integrate(past, 2.9, method=method, events="y = 0 stop", dense_output=True)
    assert np.allclose([first.t[-1], *first.y[:2, -1]], [1, 0, 0.5], rtol=0, atol=1e-8)
    onward = ball.integrate(first, 2.9, method=method, t_eval=[2.9])
    assert np.allclose(onward.y[:, 0], run.y[:, -1], rtol=0, atol=2e-8)
    words = "events follow each other without end: y = 0 falling"
    for e in (0.1, 0.5, 0.9):
        rest = 1 + 2 * e / (1 - e)
        with pytest.raises(dk.RunError, match=words) as caught:
            ball.integrate(past, 1.5 * rest, method=method, parameters={"e": e})
        assert caught.value.partial.t[-1] == pytest.approx(rest, rel=1e-8)


@pytest.mark.parametrize("method", METHODS)
def test_relay_with_a_delay(cache, method):
    """x' = -u(t - 1), u the sign of x: a triangle of period 4."""
    model = dk.Model(
        {"x": "-u(t - 1)", "u": "0"},
        events=[
            {"when": "x = 0 rising", "set": {"u": 1}},
            {"when": "x = 0 falling", "set": {"u": -1}},
        ],
        name="relay",
    )
    run = model.integrate({"x": 1, "u": 1}, 21.25, method=method, t_eval=[0.5, 2, 3, 21.25])
    assert np.allclose(run.y[0], [0.5, -1, 0, -0.25], rtol=0, atol=1e-9)
    assert run.switches == {"x = 0 rising": 5, "x = 0 falling": 6}


def test_integrate_and_fire(cache):
    """v' = a - v, 0 again at 1: fires every log(a/(a - 1)); x' = v(t - 1/2) follows."""
    model = dk.Model(
        {"v": "a - v", "x": "v(t - 1/2)", "spikes": "0"},
        {"a": 2},
        events={"when": "v = 1 rising", "set": {"v": 0, "spikes": "spikes + 1"}},
        name="neuron",
    )
    period = math.log(2)
    past = {"v": 0, "x": 0, "spikes": 0}
    run = model.integrate(past, 10.4 * period, events=["v = 1 rising", "spikes = 6.5 stop"])
    assert np.allclose(run.t_events[0], period * np.arange(1, 8), rtol=1e-8)
    assert run.t_events[1] == pytest.approx([7 * period], rel=1e-8)
    # both sides of each jump are sampled
    near = [run.y[0][np.abs(run.t - time) < 1e-6] for time in run.t_events[0][:6]]
    assert all(found.max() > 0.999 and found.min() < 0.001 for found in near)


def test_two_at_one_time_keep_their_order(cache):
    first = {"when": "t = 1/3", "set": {"y": "y + 1"}}
    second = {"when": "3*t = 1", "set": {"y": "2*y"}}
    for events, known in (([first, second], 4), ([second, first], 3)):
        model = dk.Model({"y": "0"}, events=events, name="order")
        assert model.integrate(1.0, 1).y[0, -1] == known


def test_event_at_the_level_of_another_one(cache):
    """A wall at 1 that counts from both sides: x turns back there, which is a passage, too."""
    walls = [
        {"when": "x = 1 rising", "set": {"v": "-v", "n": "n + 1"}},
        {"when": "x = 1 falling", "set": {"m": "m + 1"}},
        {"when": "x = 0 falling", "set": {"v": "-v"}},
    ]
    model = dk.Model({"x": "v", "v": "0", "n": "0", "m": "0"}, events=walls, name="walls")
    run = model.integrate({"x": 0.5, "v": 1, "n": 0, "m": 0}, 10)
    assert np.allclose(run.y[:, -1], [0.5, 1, 5, 5], atol=1e-9)
    assert np.allclose(run.t_events[0], 0.5 + 2 * np.arange(5), atol=1e-9)


def test_values_before_an_event_and_delayed_ones(cache):
    model = dk.Model(
        {"x": "1", "y": "0", "z": "0"},
        events={"when": "x(t - 1/2) = 1/2", "set": {"y": "z + x", "z": "y - x(t - 1/2)"}},
        name="swap",
    )
    run = model.integrate({"x": 0, "y": 3, "z": 5}, 2)
    assert np.allclose(run.y[:, -1], [2, 6, 2.5], atol=1e-9)


def test_event_with_a_delay_that_moves(cache):
    """y' = y(t/2) from 1, doubled at the time T where y = 2: its slope jumps at 2 T."""
    model = dk.Model(
        {"y": "y(t/2)"}, events={"when": "y = 2 rising", "set": {"y": "2*y"}}, name="both"
    )
    plain = dk.Model({"y": "y(t/2)"}, name="plain")
    start = plain.integrate(1.0, 3, events="y = 2 stop", dense_output=True, rtol=1e-12)
    at = start.t[-1]
    times = np.array([1.5, 2.5]) * at
    run = model.integrate(1.0, times[-1], t_eval=times, rtol=1e-11)
    nodes, weights = np.polynomial.legendre.leggauss(40)

    def integral(left, right, late):
        half = (right - left) / 2
        return half * weights @ late((left + half * (nodes + 1)) / 2)

    def doubled(t):
        return np.array([4 + integral(at, one, lambda s: start.sol(s)[0]) for one in np.ravel(t)])

    assert run.y[0, 0] == pytest.approx(doubled(1.5 * at)[0], abs=1e-9)
    known = doubled(2 * at)[0] + integral(2 * at, 2.5 * at, doubled)
    assert run.y[0, 1] == pytest.approx(known, abs=1e-9)


@pytest.mark.parametrize(
    ("events", "words"),
    [
        ({"when": "y = 1", "do": {"y": 0}}, "events: .*expected {when:"),
        ("y = 1", "events: 'y = 1'; expected {when:"),
        ({"when": "y = 1", "set": {}}, "events: .*expected {when:"),
        ({"when": "y > 1", "set": {"y": 0}}, "when of an event: 'y > 1'; expected LEFT = RIGHT"),
        ({"when": "y = 1 up", "set": {"y": 0}}, "event y = 1 up: '1 up'; expected an expression"),
        ({"when": "a = 1", "set": {"y": 0}}, "expected an equation with t or the states"),
        ({"when": "y = 1", "set": {"a": 0}}, "expected states, y; one whose slope is 0 for a"),
        ({"when": "y = 1", "set": {"y": "x"}}, "event y = 1: y: 'x'; expected one of a, y"),
        ([{"when": "y = 1", "set": {"y": 0}}] * 2, "expected LEFT = RIGHT, .* once"),
    ],
)  # fmt: skip
def test_refused(events, words):
    model = dk.Model({"y": "-y"}, {"a": 1}, events=events)
    with pytest.raises(dk.ModelError, match=words):
        model.run(1, 2)


def test_what_needs_a_smooth_model(ball):
    with pytest.raises(dk.RunError, match="not smooth at y = 0 falling"):
        ball.exponents({"y": 0.5, "v": 0, "late": 0}, 1, t_transient=1, t_end=2, interval=1)
    with pytest.raises(dk.ModelError, match="none where the model is not smooth, at y = 0 falling"):
        ball.roots(near={"y": 0, "v": 0, "late": 0})


def test_no_value_after_an_event(cache):
    event = {"when": "x = 1", "set": {"y": "log(x - 2)"}}
    model = dk.Model({"x": "1", "y": "x"}, events=event, name="no_value")
    with pytest.raises(dk.RunError, match="where y = NaN"):
        model.integrate({"x": 0, "y": 0}, 2)
