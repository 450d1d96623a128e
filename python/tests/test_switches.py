# SPDX-License-Identifier: BSD-3-Clause
"""Where f saturates every method keeps to its tolerance: the battery of benchmarks/switches.py."""

import math

import delaykit as dk
import numpy as np
import pytest
from switches import METHODS, PROBLEMS


@pytest.mark.parametrize("method", METHODS)
def test_thirty_switches(method):
    """Against SciPy; 30 tolerances, times the condition, is the bound."""
    errors = {
        (problem.name, tolerance): problem.error(method, tolerance)
        for problem in PROBLEMS
        for tolerance in (1e-3, 1e-5, 1e-8)
    }
    assert {case: error for case, error in errors.items() if error > 30} == {}


@pytest.mark.parametrize("method", ["taylor", "auto"])
@pytest.mark.parametrize(
    ("equation", "exact"),
    [
        # coefficients that vanish by chance, whatever the degree
        ("-4*now**3*x**2", 1 / (1 + 6**4)),
        ("-5*now**4*x**2", 1 / (1 + 6**5)),
        # a kink 1e-4 wide that no coefficient shows
        ("sqrt((now - 2)**2 + 1e-8)", 11.0),
    ],
)
def test_series_that_look_free_of_error(equation, exact, method):
    model = dk.Model({"now": "1", "x": equation})
    for tolerance in (1e-3, 1e-4, 1e-5, 1e-6):
        run = model.integrate(
            {"now": 0, "x": 1}, 6, t_eval=[6], method=method, rtol=tolerance, atol=tolerance
        )
        assert abs(run.y[1, 0] - exact) < 10 * tolerance * (1 + exact)


@pytest.mark.parametrize("method", ["bs5", "dop853", "radau5", "radau9", "radau13"])
def test_estimates_do_not_vanish_by_chance(method):
    """One step of any length, h times rate up to 6, that is accepted is within the tolerance."""
    model = dk.Model({"x": "a*x"}, {"a": 1})
    for h in np.linspace(0.05, 6, 120):
        for a in (1, -1):
            run = model.integrate(
                1.0, h, parameters={"a": a}, first_step=h, max_step=h, t_eval=[h],
                method=method, rtol=1e-6, atol=1e-6,
            )  # fmt: skip
            assert abs(run.y[0, 0] - math.exp(a * h)) < 1e-5 * (1 + math.exp(a * h))


@pytest.mark.parametrize("method", ["auto", "taylor", "dop853", "radau9"])
def test_an_exponent_that_is_the_mean_of_a_switch(method):
    """w' = x - w f(x(t - 1/2)) along x = -cos t: 0, 0 and less the mean of f."""
    switch = "1 + tanh(200*(x(t - 1/2) - 9/10))"
    model = dk.Model({"x": "y", "y": "-x", "w": f"x - w*({switch})"})
    period = 2 * math.pi
    found = model.exponents(
        {"x": -1, "y": 0, "w": 1},
        3,
        t_transient=4 * period,
        t_end=64 * period,
        interval=period,
        method=method,
    )
    x = np.cos(np.linspace(0, period, 10**5, endpoint=False))
    mean = (1 + np.tanh(200 * (x - 0.9))).mean()
    np.testing.assert_allclose(found["value"], [0, 0, -mean], atol=1e-3)
