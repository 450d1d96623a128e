"""Verdicts on the printed equations, on Hopf curves in closed form."""

import re

import numpy as np
import pytest
from made_up_results import NO, PARTLY, YES, assert_finding, cases, changed, finding, hopf_curve

from scripts.studies.formulas.printed_formulas import (
    epsilon_of_8,
    points_of,
    residual_of_5,
    xi_of_9,
)

PLANE, PLANES = {"plane": "plane"}, {"planes": ["plane"]}
BELOW_ROUNDING = {**PLANE, "limit": 1e-20}
CURVE = hopf_curve()
ALIKE = changed(CURVE, epsilon=0.0, omega=0.8, tau=0.0)
"""Where the printed forms of (3) and (4) give (5): epsilon = 0, omega = gamma, tau = 0."""
FAST = hopf_curve(gamma=1e7, scale=1e7)
"""Where gamma^2 is below rounding in the numerator of (10), and the plain arctangent is enough."""
AT_12 = np.arange(12)
HOPF = 0.64 * 0.5 / 1.14
"""The Hopf point without delay: omega^2 = epsilon = gamma^2 xi/(xi + gamma^2)."""


def on_plane(curves) -> dict:
    return {"curves": {"plane": curves}}


@pytest.mark.parametrize("gamma", [0.8, 3.0])
@pytest.mark.parametrize("k", [1, 2])
def test_corrected_formulas_hold_on_closed_form(gamma, k):
    """(5), (8) and (9); and (5) does not hold beside the curve."""
    points = points_of(hopf_curve(gamma=gamma, k=k))
    assert residual_of_5(points, points.epsilon, points.tau).max() < 1e-13
    assert residual_of_5(points, points.epsilon + 0.1, points.tau).min() > 1e-3
    np.testing.assert_allclose(epsilon_of_8(points, 2), points.epsilon, rtol=1e-12)
    np.testing.assert_allclose(
        xi_of_9(omega=points.omega, tau=points.tau, gamma=gamma), points.xi, rtol=1e-9
    )


def curve_at_delay(omega: np.ndarray):
    """A curve at a fixed delay of 12: xi by the closed form, from omega and tau."""
    tau = 12.0
    b = np.tan(omega * tau + np.arctan(omega))
    xi = b * 0.64 * omega / (0.64 - omega**2)
    curves = hopf_curve(ordinate="xi").isel(point=slice(omega.size))
    epsilon = np.sqrt((1 + omega**2) * (1 + b**2)) - 1
    assert (xi > 0).all()
    return changed(curves, omega=omega, tau=tau, xi=xi, epsilon=epsilon)


BOTH = {"planes": ["plane", "other"]}
BESIDE = changed(CURVE, epsilon=CURVE.epsilon.values + 0.1)
LIKE_PRINT, WRONG = hopf_curve(gamma=1.0, ordinate="xi"), changed(CURVE, residual=1e-3)
STRETCH = np.linspace(0.49, 0.53, 10)
AT_DELAY = curve_at_delay(STRETCH)


@cases(
    ("equation_3", PLANE, (on_plane(CURVE), PARTLY), (on_plane(ALIKE), YES)),
    ("equation_3", BELOW_ROUNDING, (on_plane(CURVE), NO)),
    ("equation_4", PLANE, (on_plane(CURVE), PARTLY), (on_plane(ALIKE), YES)),
    ("equation_4", BELOW_ROUNDING, (on_plane(CURVE), NO)),
    (
        *("equation_6", PLANES),
        (on_plane(CURVE), YES),
        (on_plane(BESIDE), NO),
    ),
    ("equation_6", BOTH, ({"curves": {"plane": CURVE, "other": BESIDE}}, NO)),
    (
        # where gamma^1 is gamma^2 the printed (8) holds
        *("equation_8", PLANE),
        *((on_plane(CURVE), PARTLY), (on_plane(hopf_curve(gamma=1.0)), YES)),
    ),
    ("equation_8", BELOW_ROUNDING, (on_plane(CURVE), NO)),
    (
        *("equation_9", PLANE),
        (on_plane(AT_DELAY), YES, "at 0 of "),
        (on_plane(changed(AT_DELAY, xi=AT_DELAY.xi.values * 1.01)), NO),
    ),
    (
        *("equation_10", PLANE),
        (on_plane(CURVE), PARTLY),
        (on_plane(FAST), YES),
        # the largest of the residuals counts
        (on_plane(changed(FAST, epsilon=FAST.epsilon.values + (AT_12 == 7))), PARTLY),
        (on_plane(changed(CURVE, residual=(AT_12 == 3) * 0.1)), NO),
    ),
    (
        # tau as printed counts only where tau is drawn
        *("hopf_curves", PLANES),
        (on_plane(CURVE), PARTLY),
        (on_plane(LIKE_PRINT), YES),
        (on_plane(hopf_curve(gamma=1.0)), PARTLY),
        (on_plane(WRONG), NO),
    ),
    # the worst plane counts
    ("hopf_curves", BOTH, ({"curves": {"plane": LIKE_PRINT, "other": CURVE}}, PARTLY)),
    ("hopf_curves", BOTH, ({"curves": {"plane": WRONG, "other": LIKE_PRINT}}, NO)),
    (
        # at tau = 0 (5) has no delay
        *("lag_of_the_plate", PLANE),
        (on_plane(CURVE), NO),
        (on_plane(changed(CURVE, epsilon=HOPF, omega=np.sqrt(HOPF), tau=0.0)), YES),
    ),
)
def test_verdicts(case):
    """Whether each equation holds as printed, as corrected, or not at all."""
    assert_finding(*case)


def test_equation_9_gives_points_beside_a_longer_curve():
    """As a remark: it is right on the curve."""
    wide = finding("equation_9", on_plane(curve_at_delay(np.append(STRETCH, 0.95))), **PLANE)
    assert wide.verdict == YES
    beside = re.search(r"at (\d+) of (\d+) frequencies", wide.evidence)
    assert 0 < int(beside[1]) < int(beside[2])


def test_plane_without_curve_is_an_error():
    """Nothing is concluded from nothing."""
    with pytest.raises(ValueError, match="no Hopf curve in the window"):
        finding("equation_8", on_plane(CURVE.isel(point=slice(0))), **PLANE)
