# SPDX-License-Identifier: BSD-3-Clause
"""Models that are not smooth: steps end where their terms switch."""

from math import cos, pi, sin

import delaykit as dk
import numpy as np
import pytest
import sympy
from delaykit.runs import METHODS

KNOWN = {
    # Coulomb friction takes 2/10 of the amplitude in each half period
    "friction": (
        {"x": "v", "v": "-x - sign(v)/10"},
        {"x": 1, "v": 0},
        10,
        [-0.1 - 0.3 * cos(10 - 3 * pi), 0.3 * sin(10 - 3 * pi)],
        {"sign(v)": 3},
    ),
    "pulses in time": (
        {"y": "heaviside(sin(40*t))"},
        0,
        31,
        [31 - 197 * pi / 40],
        {"heaviside(sin(40*t))": 394},
    ),
    "a switch that moves another": (
        {"x": "1", "y": "where(t > where(x > 1, 0.5, 3), 1, 0)"},
        {"x": 0, "y": 0},
        4,
        [4, 3],
        {"x > 1": 1, "t > where(x > 1, 0.5, 3)": 1},
    ),
    "two at one time": (
        {"x": "1", "y": "where(x > 1 and t > 1, 1, 0)"},
        {"x": 0, "y": 0},
        4,
        [4, 3],
        {"x > 1": 1, "t > 1": 1},
    ),
    "no value on the other side": (
        {"y": "where(y > 1, log(y)/y - 1, -1)"},
        1,
        1,
        [0],
        {"y > 1": 0},
    ),
}
"""Equations, history, end, the exact state there and how often each term switches."""


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", KNOWN)
def test_steps_end_at_switches(kind, method):
    equations, history, end, known, switches = KNOWN[kind]
    run = dk.Model(equations).integrate(history, end, method=method)
    np.testing.assert_allclose(run.y[:, -1], known, rtol=1e-8, atol=1e-8)
    assert run.switches == switches


def test_a_relay():
    """Exact in straight pieces; a run that goes on, and a Dataset, have its switches."""
    model = dk.Model({"y": "-sign(y(t - 1))"})
    first = model.integrate(1, 9, dense_output=True)
    assert model.run(first, 21.25).attrs["switches"] == "sign(y(t - 1)): 6"
    assert model.integrate(first, 21.25).y[0, -1] == pytest.approx(-0.25, abs=1e-12)


def test_sliding():
    model = dk.Model({"y": "-sign(y - 1/4)"})
    with pytest.raises(dk.RunError, match=r"t = 0\.25.* from both sides .* sign\(y - 1/4\)"):
        model.integrate(0.5, 1)


NOT_SMOOTH = {
    "exponents": lambda m: m.exponents(1.0),
    "attractor": lambda m: m.attractor(1.0),
    "attractor near": lambda m: m.attractor(1.0, near={"y": 0}),
    "roots": lambda m: m.roots(near={"y": 0}),
    "hopf": lambda m: m.hopf(("a", "lag"), ((0, 1), (0, 1)), near={"y": 0}),
    "cycle": lambda m: m.cycle(m.integrate(1.0, 0.1), "a", (0, 1)),
}


@pytest.mark.parametrize("call", NOT_SMOOTH.values(), ids=NOT_SMOOTH)
def test_derivatives_of_what_is_not_smooth(call):
    """Each method names the term."""
    model = dk.Model({"y": "1 - a*abs(y(t - lag))"}, {"a": 1, "lag": 1})
    with pytest.raises((dk.ModelError, dk.RunError), match=r"smooth,? at abs\(y\(t - lag\)\)"):
        call(model)


def test_terms_that_are_not_smooth_of_sympy():
    """On the sides on which a run begins, before it leaves them."""
    y, p = sympy.symbols("y p", real=True)
    late = sympy.Function("y")(sympy.Symbol("t") - 1)
    terms = sympy.Max(y, p, 2) * sympy.Heaviside(y) + sympy.sign(-y) * sympy.Abs(late)
    low = sympy.And(y < 5, sympy.Or(late > 9, ~(y > 3)))
    rate = sympy.Piecewise((terms, low), (sympy.log(-y), True))
    run = dk.Model({"y": rate}, {"p": 1}).integrate(1.0, 0.5)
    # y' = 2 - 1
    np.testing.assert_allclose(run.y[0], 1 + run.t, rtol=1e-12)
    assert set(run.switches.values()) <= {0}
