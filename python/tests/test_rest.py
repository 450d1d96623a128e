# SPDX-License-Identifier: BSD-3-Clause
"""Roots and Hopf points where there is no state at rest, or a root is 0 or on a bound."""

from math import atan2, cos, nan, pi, sqrt

import delaykit as dk
import numpy as np
import pytest


def model_of(texts: str) -> dk.Model:
    """A model of x and y with parameters a and b."""
    return dk.Model(dict(zip("xy", texts.split("; "), strict=False)), {"a": 1, "b": 1})


@pytest.mark.parametrize("method", ["roots", "hopf", "cycle"])
@pytest.mark.parametrize(
    "texts", ["a + b*x(t - 1)**2", "a + b*sin(y(t - 1) - x); a + b*sin(x(t - 1) - y)"]
)
def test_no_state_at_rest(texts, method):
    """Beyond a fold, and of two phases that rotate."""
    model = model_of(texts)
    window = {"hopf": (("a", "b"), ((1, 2), (1, 2))), "cycle": (None, "a", (1, 2))}
    said = "no state at rest near x = 1/2,.* tried Newton's method, a = 1.0, b = 1.0; expected "
    with pytest.raises(dk.RunError, match=said):
        getattr(model, method)(*window.get(method, ()), near=dict.fromkeys(model.states, 0.5))


def of_tanh(a, b):
    """1/a = cos(omega b) and -omega/a = sin(omega b) on curves, where omega^2 = a^2 - 1."""
    if abs(a) <= 1:
        return 0, 0
    omega = sqrt(a**2 - 1)
    return int(a > 1), omega * b - atan2(-omega / a, 1 / a) % (2 * pi) + pi / 2


@pytest.mark.parametrize(
    ("texts", "near", "window", "form"),
    [
        # Wright's equation, in which any x is at rest at a = 0; a root 0 at a = 1; none is at rest
        # at a = -1; and beyond the fold a = 0
        ("-x(t - b)*(1 + x)*a", 0, ((0, 10), (0, 3)), lambda a, b: (0, a * b)),
        ("-x + a*tanh(x(t - b))", 0, ((-6, 8), (0.1, 4)), of_tanh),
        ("1/(1 + a) - x(t - b)", 1, ((-8, 6), (0.1, 9)), lambda a, b: (0, b if a + 1 else nan)),
        ("a + b*x(t - 1)**2", -2, ((-8, 2), (1, 2)), lambda a, b: (0, 2 * (-a * b) ** 0.5)),
        # Hopf points without end are between two columns; a root is 0 anywhere by a symmetry
        (
            *("-x(t - b)/a", 0, ((-1, 1.1), (0.5, 1))),
            lambda a, b: (int(a < 0), abs(b / a) - pi * (a < 0)),
        ),
        (
            *("a*sin(y(t - b) - x); a*sin(x(t - b) - y)", 0.25, ((-3, 3), (0.1, 4))),
            lambda a, b: (int(a < 0) + int(a * b < -1), 0),
        ),
        # one real root without a pair
        ("a*x + b*x(t - 1)", 0, ((-3, 3), (0, 4.1)), lambda a, b: (int(a + b > 0), 0)),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value")
def test_windows_in_which_roots_cannot_be_counted_everywhere(texts, near, window, form):
    """Known: real roots, and an angle that is pi/2 + 2 pi k on curve k, which adds a pair."""
    model = model_of(texts)
    found = model.hopf(("a", "b"), window, near=dict.fromkeys(model.states, near), cells=7)
    known = [[form(a, b) for a in found.map_abscissa.values] for b in found.map_ordinate.values]
    real, angle = np.moveaxis(np.array(known), -1, 0)
    count = real + 2 * np.maximum(0, np.floor((angle / pi - 0.5) / 2) + 1)
    np.testing.assert_array_equal(found.map_unstable_roots, count)
    assert ("left_out" in found.attrs) == np.isnan(angle).any()
    turns = [form(*at)[1] / pi / 2 - 0.25 for at in np.transpose([found.a, found.b])]
    assert (len(turns) > 9) == (np.nanmax(angle) > pi / 2)
    np.testing.assert_allclose(turns, np.round(turns), atol=1e-11)


@pytest.mark.parametrize(
    ("text", "window", "hopf", "left_out"),
    [
        ("-x(t - 1)*(1 + x)*a", (0, 3), [pi / 2], []),
        # tan(omega) = -omega
        ("-x + a*tanh(x(t - 1))", (-3, 1), [1 / cos(2.028757838110434)], []),
        ("1/(1 + a) - x(t - 1)", (-2, 0), [], [-1]),
    ],
)
def test_lines_in_which_roots_cannot_be_counted_everywhere(text, window, hopf, left_out):
    found = model_of(text).cycle(None, "a", window, near={"x": 0}, most_orbits=3)
    np.testing.assert_allclose(found.get("hopf_a", []), hopf, rtol=1e-12)
    np.testing.assert_array_equal(found.get("left_out_a", []), left_out)


@pytest.mark.parametrize("bound", [-1, 10])
def test_no_root_is_above_a_bound(bound):
    """One is on the first, and no other."""
    assert model_of("-x + (a - 1)*x(t - 1)").roots(bound, near={"x": 0}).size == 0
