# SPDX-License-Identifier: BSD-3-Clause
"""Delays that depend on time or the states, in texts: exact solutions, and what is refused."""

import math

import delaykit as dk
import numpy as np
import pytest

METHODS = ("auto", "bs5", "dop853", "radau5", "radau9", "radau13")


@pytest.fixture(scope="module")
def own_past(cache) -> dk.Model:
    """y' = y(y(t)), problem 1.3.10 of Paul (1994)."""
    return dk.Model({"y": "y(y)"}, name="own_past")


@pytest.fixture(scope="module")
def pantograph(cache) -> dk.Model:
    """y' = a y(t/2) + b y of Fox, Mayers, Ockendon and Tayler (1971)."""
    return dk.Model({"y": "a*y(t/2) + b*y"}, {"a": 0.7, "b": -1}, name="pantograph")


@pytest.mark.parametrize("method", METHODS)
def test_jump_of_the_history_returns(own_past, method):
    run = own_past.integrate(0.5, 5.5, t_start=2, initial=1.0, method=method, t_eval=[3, 5, 5.5])
    known = [1.5, 2 * math.exp(0.5), 4 - 2 * math.log(2 * math.log(2) - 0.5)]
    assert np.allclose(run.y[0], known, rtol=0, atol=2e-8)
    assert run.counts["breaking_points"] >= 2


def test_series_of_the_pantograph(pantograph):
    """Coefficient n + 1 is (a 2**-n + b)/(n + 1) times coefficient n."""
    for t in (0.5, 2.0):
        known = term = 1.0
        for n in range(60):
            term *= t * (0.7 * 0.5**n - 1) / (n + 1)
            known += term
        assert pantograph.integrate(1.0, t).y[0, -1] == pytest.approx(known, abs=1e-9)


def test_driven_with_a_delay_of_the_state(cache):
    """y' = y y(log y - 1)/(t + 1) of Paul (1992), in three pieces."""
    model = dk.Model({"y": "y*y(log(y) - 1)/(t + 1)"}, name="pieces")
    times = [1.0, 5.0, 10.0]
    known = [2.0, math.exp(6 / math.e), (math.e / (3 - math.log(11))) ** math.e]
    run = model.integrate(1.0, 10, t_eval=times)
    assert np.allclose(run.y[0], known, rtol=1e-8, atol=0)


def test_bound_of_the_delay(cache):
    """It may depend on parameters; a longer delay is refused with its value."""
    equation, numbers = {"y": "-y(t - 1 - a*cos(t))"}, {"a": 0.5}
    model = dk.Model(equation, numbers, longest_delay="1 + a", name="bound")
    assert list(model.delays()) == [1.5]
    by_function, free = model.run(math.sin, 20), dk.Model(equation, numbers, name="free")
    assert by_function.y.values[-1] == pytest.approx(model.run(math.sin, 20, rtol=1e-11).y[-1])
    assert model.run(0.5, 20).y[-1] == pytest.approx(free.run(0.5, 20).y.values[-1], abs=1e-8)
    short = dk.Model(equation, numbers, longest_delay=1.25, name="short")
    with pytest.raises(dk.RunError, match=r"delay 1 is 1\.5 at t = 0\.0; 0\.\.1\.25 expected"):
        short.run(0.5, 20)


def test_delay_below_zero(cache):
    model = dk.Model({"y": "-y(t - (1 - t))"}, name="below_zero")
    with pytest.raises(dk.RunError, match="a delay out of its range") as caught:
        model.run(1.0, 2)
    assert caught.value.partial.t[-1] == pytest.approx(1, abs=1e-9)


def test_unknown_bound_and_a_history_over_time(own_past):
    with pytest.raises(dk.ModelError, match="expected constants, or a model with longest_delay"):
        own_past.run(lambda t: 1.0, 3)
    assert list(own_past.delays()) == [np.inf]


def test_goes_on_from_dense_output(own_past):
    first = own_past.integrate(0.5, 3, t_start=2, initial=1.0, dense_output=True)
    run = own_past.integrate(first, 5.5)
    known = 4 - 2 * math.log(2 * math.log(2) - 0.5)
    assert run.y[0, -1] == pytest.approx(known, abs=1e-7)


def test_roots_and_hopf_points_are_those_of_the_frozen_delay(cache):
    """s = -a exp(-s T) (Cooke and Huang 1996), at s = i omega a T = pi/2; W(-1.6) of Lambert."""
    model = dk.Model(
        {"x": "-a*x(t - T - c*tanh(x))"}, {"a": 1.6, "T": 1, "c": 0.5}, steady_state={"x": 0}
    )
    known = 0.013113669474157886 + 1.579100653687886j
    assert model.roots(-0.1)[:2] == pytest.approx([known, known.conjugate()], abs=1e-10)
    found = model.hopf(("T", "a"), ((0.5, 2), (0.5, 3)))
    first = found.sel(point=found.omega * found["T"] < 3)
    assert first.point.size > 5
    assert (first["T"] * first.a).values == pytest.approx(math.pi / 2, abs=1e-8)
    assert np.isnan(found.l1).all()
    with pytest.raises(dk.RunError, match="cycles: delays depend on t or the states"):
        model.cycle({"x": 0.1}, along="a", window=(1.5, 2))
    with pytest.raises(dk.ModelError, match="none where a delay depends on t at rest: t/2"):
        dk.Model({"x": "-x(t/2)"}, steady_state={"x": 0}, name="half").roots(-1)


def test_rest_near_a_guess_is_that_of_expressions(cache):
    """Rest x = a**2, y = log(a): the same roots, curves and counts; two states share a delay."""
    texts = {
        "x": "-k*(x(t - T/(1 + x)) - a**2) + (y(t - T/(1 + x)) - log(a))/5",
        "y": "a - exp(y) + (x(t - 1 - y**2) - x)/3",
    }
    numbers = {"a": 1.2, "k": 1.5, "T": 3}
    known = dk.Model(texts, numbers, steady_state={"x": "a**2", "y": "log(a)"}, name="known")
    guess, model = {"x": 1.0, "y": 0.1}, dk.Model(texts, numbers, name="computed")
    roots = known.roots(-2)
    assert len(roots) > 5
    assert model.roots(-2, near=guess) == pytest.approx(roots, abs=1e-9)
    for along, window in ((("a", "k"), ((0.5, 2), (0.2, 3))), (("a", "T"), ((0.5, 2), (0.5, 9)))):
        one = known.hopf(along, window, cells=10)
        other = model.hopf(along, window, near=guess, cells=10)
        assert one.point.size > 20
        for name in (*along, "omega", "map_unstable_roots"):
            np.testing.assert_allclose(other[name], one[name], rtol=1e-9, atol=1e-9)


def test_hopf_points_of_a_rest_that_is_computed(cache):
    """a = x exp(x) at rest: s = -k exp(-s T/(1 + x)) with k = (1 + x) exp(x); T exp(x) = pi/2."""
    late = "x(t - T/(1 + x))"
    model = dk.Model({"x": f"a - {late}*exp({late})"}, {"a": 1, "T": 1}, name="lambert")
    found = model.hopf(("a", "T"), ((0.2, 3), (0.1, 1.3)), near={"x": 0.5}, cells=10)
    first = found.sel(point=found.branch == 0)
    power = math.pi / 2 / first["T"]
    assert first.point.size > 20
    np.testing.assert_allclose(first.a, power * np.log(power), rtol=1e-9)
    np.testing.assert_allclose(first.omega, (1 + np.log(power)) * power, rtol=1e-9)


@pytest.mark.parametrize("near", [None, {"x": 0.5}])
def test_delay_below_zero_at_rest(cache, near):
    model = dk.Model(
        {"x": "-b*(x(t - 1 + x) - a)"}, {"a": 2, "b": 1}, name="early", steady_state={"x": "a"}
    )
    with pytest.raises(dk.RunError, match=r"a = 2.0, b = 1.0; expected one with .* delays >= 0"):
        model.roots(-1, near=near)
    found = model.hopf(("a", "b"), ((-2, 2), (1, 4)), near=near, cells=8)
    turns = 2 * math.pi * found.branch
    np.testing.assert_allclose((1 - found.a) * found.b, math.pi / 2 + turns, rtol=1e-9)
    np.testing.assert_array_equal(np.isnan(found.map_unstable_roots[0]), found.map_abscissa > 1)
    assert "delays >= 0" in found.left_out


def test_scan(pantograph):
    found = pantograph.scan("final", a=[0.5, 0.7], history={"y": 1.0}, t_end=1.0, progress=False)
    assert not any(found.reason.values)
    assert found.final.values[1, 0] == pytest.approx(pantograph.integrate(1.0, 1.0).y[0, -1])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda one: one.exponents(1.0), "expected constant ones"),
        (lambda one: one.attractor(1.0), "expected constant ones"),
        (lambda one: one.hopf(("a", "b"), ((0, 1), (0, 1)), near={"y": 0}), "on t at rest: t/2"),
        (lambda one: one.roots(-1, near={"y": 0}), "none where a delay depends on t at rest: t/2"),
        (lambda one: one.run(1.0, 1.0, method="taylor"), "gives no Taylor series"),
    ],
)
def test_refusals(pantograph, call, words):
    with pytest.raises((dk.ModelError, dk.RunError), match=words):
        call(pantograph)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("y(t - y(t - 1))", "a delay >= 0 of numbers, parameters, t and the states at t"),
        ("y(t - abs(y))", "a delay >= 0 of numbers, parameters, t and the states at t"),
        ("y(t + 1)", "a delay >= 0"),
    ],
)
def test_delays_that_are_none(cache, text, words):
    with pytest.raises(dk.ModelError, match=words):
        dk.Model({"y": text}, name="none").run(1.0, 1.0)


def test_options_that_need_constant_delays(cache):
    with pytest.raises(dk.ModelError, match="none where a delay depends on t or the states"):
        dk.Model({"y": "-y(t - 1 - y**2)"}, name="fixed", fast="y").run(1.0, 1.0)
    with pytest.raises(dk.ModelError, match="none where no delay depends on t or the states"):
        dk.Model({"y": "-y(t - 1)"}, name="constant", longest_delay=3).run(1.0, 1.0)
    with pytest.raises(dk.ModelError, match="an expression of parameters"):
        dk.Model({"y": "-y(t - y)"}, name="bound", longest_delay="y").run(1.0, 1.0)
    with pytest.raises(dk.ModelError, match="none where a delay depends on t or the states"):
        dk.Model(
            {"y": "-y(t - y**2) + second_difference(y)"}, name="chain", blocks=3, ends="ring"
        ).run(1.0, 1.0)
