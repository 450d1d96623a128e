# SPDX-License-Identifier: BSD-3-Clause
"""Spectra, sections and pictures."""

import math

import delaykit as dk
import numpy as np
import pytest


def test_a_spectrum_of_a_sine(sine):
    """sin t: one peak at 1/(2 pi), and a density whose integral is the variance 1/2."""
    run = sine.run(math.sin, 2000, t_eval=np.arange(0, 2000, 0.5), rtol=1e-11, atol=1e-11)
    found = dk.spectrum(run)
    np.testing.assert_allclose(found.peak_frequency, [1 / (2 * math.pi)], rtol=1e-4)
    np.testing.assert_allclose(found.density.integrate("frequency"), 1 / 2, rtol=1e-3)
    with pytest.raises(dk.ModelError, match="evenly spaced"):
        dk.spectrum(sine.run(math.sin, 200))


def test_a_section_of_a_sine(sine):
    """sin t rises through 1/2 once in 2 pi."""
    found = sine.section(math.sin, 40, "y = 0.5 rising", t_transient=10)
    np.testing.assert_allclose(found.t[0], math.pi / 6 + 4 * math.pi, atol=1e-6)
    np.testing.assert_allclose(found.time_between[1:], 2 * math.pi, atol=1e-6)
    np.testing.assert_allclose(found.y, 0.5, atol=1e-9)


def test_pictures(mackey_glass, sine):
    results = {
        "Lyapunov exponent, average up to a time": mackey_glass.exponents(1.2, t_end=4000),
        "beta": mackey_glass.hopf(("tau", "beta"), ((0.1, 20), (0.12, 0.5)), near={"y": 1}),
        "greatest y": mackey_glass.cycle(1.2, "tau", (5, 20), parameters={"tau": 6}, near={"y": 1}),
        "maxima of y": mackey_glass.scan(tau=[5, 10], history=0.5, t_end=500, progress=False),
        "the next time between passages": mackey_glass.section(1.2, 500, "y = 1"),
        "one-sided power spectral density of y": dk.spectrum(
            sine.run(math.sin, 200, t_eval=np.arange(0, 200, 0.5))
        ),
    }
    for label, found in results.items():
        axes = dk.plot(found)
        axes.figure.canvas.draw()
        assert axes.get_ylabel() == label
        assert axes.get_xlabel()
    with pytest.raises(dk.ModelError, match="plot: expected results of"):
        dk.plot(mackey_glass.run(1.2, 1))


def test_where_equations_saturate():
    """A logistic that is 1 to rounding, though its exponential overflows, leaves linear ones."""
    pair = {"x": "-x + y + 1/(1 + exp(k*(x(t - 1) - 2)))", "y": "b - y - b*x(t - 1)"}
    steep = dk.Model(pair, {"b": 2, "k": 800})
    linear = dk.Model({**pair, "x": "-x + y + 1"}, {"b": 2})
    for method in ("taylor", "radau9"):
        options = {"count": 2, "t_transient": 20, "t_end": 420, "method": method}
        found, known = (m.exponents({"x": 1.2, "y": 0}, **options).value for m in (steep, linear))
        np.testing.assert_allclose(found, known, atol=1e-9)
    curves = steep.hopf(("b", "k"), window=((0.5, 4), (700, 900)), near={"x": 1, "y": 0})
    np.testing.assert_allclose(curves.b, 1 + curves.omega**2, rtol=1e-9)
    np.testing.assert_allclose(curves.l1, 0, atol=1e-9)


def test_exponents_of_stick_slip():
    """Far from balance at the start, where slopes are 1e16: sizes of states are not theirs."""
    block = {
        "theta": "-v*(theta + (1 + epsilon)*log(v(t - tau)))",
        "u": "expm1(w)",
        "w": "-gamma**2/v*(u + (theta + log(v))/xi)",
    }
    numbers = {"tau": 0.4, "epsilon": 1.18, "xi": 0.5, "gamma": 1e8}
    model = dk.Model(block, numbers, auxiliary={"v": "exp(w)"}, fast="w")
    auto, radau = (
        model.exponents(
            {"theta": 0, "u": 0, "v": 1.5}, t_transient=500, t_end=600, interval=0.4, method=method
        ).value
        for method in ("auto", "radau9")
    )
    np.testing.assert_allclose(auto, radau, rtol=1e-5, atol=1e-7)


def test_attractor_of_pulses():
    """Two velocities are delayed: a pulse of 1e9 arrives, and v grows by e^12 in a slow step."""
    block = {
        "theta": "-v(t - tau)*(theta + (1 + epsilon)*log(v(t - tau)))",
        "u": "expm1(w)",
        "w": "-gamma**2/v*(u + (theta + log(v))/xi)",
    }
    numbers = {"tau": 41 / 3, "epsilon": 1.25, "xi": 0.5, "gamma": 1e8}
    rest = dict.fromkeys(block, 0)
    model = dk.Model(block, numbers, auxiliary={"v": "exp(w)"}, fast="w", steady_state=rest)
    times = {"t_transient": 2000, "t_observed": 800, "t_turning": 500, "interval": 20}
    auto, radau = (
        model.attractor({"theta": 0, "u": 0, "v": 1.5}, method=method, **times)
        for method in ("auto", "radau9")
    )
    assert auto["class"].item() == radau["class"].item() == "cycle"
    values = [found.lyapunov_exponent[:2] for found in (auto, radau)]
    np.testing.assert_allclose(*values, rtol=1e-3, atol=1e-9)
