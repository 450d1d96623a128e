"""Verdicts on the printed equations, on Hopf curves in closed form."""

import re

import numpy as np
import pytest
from made_up_results import NO, PARTLY, YES, changed, hopf_curve, on_plane

from scripts.studies.formulas import claims as formula_claims
from scripts.studies.formulas.printed_formulas import (
    epsilon_of_8,
    points_of,
    residual_of_5,
    xi_of_9,
)

LIMIT = 1e-10
BELOW_ROUNDING = 1e-20
CURVE = hopf_curve()
ALIKE = changed(CURVE, epsilon=0.0, omega=0.8, tau=0.0)
"""Where the printed forms of (3) and (4) give (5): epsilon = 0, omega = gamma, tau = 0."""
FAST = hopf_curve(gamma=1e7, scale=1e7)
"""Where gamma^2 is below rounding in the numerator of (10), and the plain arctangent is enough."""
AT_12 = np.arange(12)
HOPF = 0.64 * 0.5 / 1.14
"""The Hopf point without delay: omega^2 = epsilon = gamma^2 xi/(xi + gamma^2)."""


def finding(test: str, curves, limit: float = LIMIT):
    name = "planes" if test in ("equation_6", "hopf_curves") else "plane"
    given = ["plane"] if name == "planes" else "plane"
    return getattr(formula_claims, test)(on_plane(curves), **{name: given, "limit": limit})


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


@pytest.mark.parametrize(
    ("test", "curves", "limit", "verdict"),
    [
        *[(test, CURVE, LIMIT, PARTLY) for test in ("equation_3", "equation_4", "equation_8")],
        *[(test, CURVE, BELOW_ROUNDING, NO) for test in ("equation_3", "equation_4", "equation_8")],
        *[(test, ALIKE, LIMIT, YES) for test in ("equation_3", "equation_4")],
        ("equation_6", CURVE, LIMIT, YES),
        ("equation_6", changed(CURVE, epsilon=CURVE.epsilon.values + 0.1), LIMIT, NO),
        # where gamma^1 is gamma^2 the printed (8) holds
        ("equation_8", hopf_curve(gamma=1.0), LIMIT, YES),
        ("equation_10", CURVE, LIMIT, PARTLY),
        ("equation_10", FAST, LIMIT, YES),
        # the largest of the residuals counts
        ("equation_10", changed(FAST, epsilon=FAST.epsilon.values + (AT_12 == 7)), LIMIT, PARTLY),
        ("equation_10", changed(CURVE, residual=(AT_12 == 3) * 0.1), LIMIT, NO),
        ("hopf_curves", CURVE, LIMIT, PARTLY),
        # tau as printed counts only where tau is drawn
        ("hopf_curves", hopf_curve(gamma=1.0, ordinate="xi"), LIMIT, YES),
        ("hopf_curves", hopf_curve(gamma=1.0), LIMIT, PARTLY),
        ("hopf_curves", changed(CURVE, residual=1e-3), LIMIT, NO),
        ("lag_of_the_plate", CURVE, LIMIT, NO),
        # at tau = 0 (5) has no delay
        (
            "lag_of_the_plate",
            changed(CURVE, epsilon=HOPF, omega=np.sqrt(HOPF), tau=0.0),
            LIMIT,
            YES,
        ),
    ],
)
def test_equations(test, curves, limit, verdict):
    """Whether each holds as printed, as corrected, or not at all."""
    assert finding(test, curves, limit).verdict == verdict


def curve_at_delay(omega: np.ndarray):
    """A curve at a fixed delay of 12: xi by the closed form, from omega and tau."""
    tau = 12.0
    b = np.tan(omega * tau + np.arctan(omega))
    xi = b * 0.64 * omega / (0.64 - omega**2)
    curves = hopf_curve(ordinate="xi").isel(point=slice(omega.size))
    epsilon = np.sqrt((1 + omega**2) * (1 + b**2)) - 1
    assert (xi > 0).all()
    return changed(curves, omega=omega, tau=tau, xi=xi, epsilon=epsilon)


def test_equation_9():
    """Right on the curve; that it also gives points beside a longer curve is a remark."""
    stretch = np.linspace(0.49, 0.53, 10)
    curves = curve_at_delay(stretch)
    found = finding("equation_9", curves)
    assert found.verdict == YES
    assert "at 0 of " in found.evidence
    wrong = changed(curves, xi=curves.xi.values * 1.01)
    assert finding("equation_9", wrong).verdict == NO
    wide = finding("equation_9", curve_at_delay(np.append(stretch, 0.95)))
    assert wide.verdict == YES
    beside = re.search(r"at (\d+) of (\d+) frequencies", wide.evidence)
    assert 0 < int(beside[1]) < int(beside[2])


def test_plane_without_curve_is_an_error():
    """Nothing is concluded from nothing."""
    with pytest.raises(ValueError, match="no Hopf curve in the window"):
        finding("equation_8", CURVE.isel(point=slice(0)))
