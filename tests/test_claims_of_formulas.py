"""Verdicts on the printed equations, on Hopf curves in closed form."""

import re

import numpy as np
import pytest
from made_up_results import NO, PARTLY, YES, Results, changed, hopf_curve, on_plane

from scripts.claims import claims_of_formulas
from scripts.claims.printed_formulas import epsilon_of_8, points_of, residual_of_5, xi_of_9

LIMIT = 1e-10
BELOW_ROUNDING = 1e-20


def finding(test: str, curves, limit: float = LIMIT):
    """What a test finds on one plane."""
    name = "planes" if test in ("equation_6", "hopf_curves") else "plane"
    given = ["plane"] if name == "planes" else "plane"
    return getattr(claims_of_formulas, test)(on_plane(curves), **{name: given, "limit": limit})


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


@pytest.mark.parametrize("test", ["equation_3", "equation_4"])
def test_printed_equations_of_motion_need_a_correction(test):
    """And hold where the printed form happens to give (5): epsilon = 0, omega = gamma, tau = 0."""
    curves = hopf_curve()
    assert finding(test, curves).verdict == PARTLY
    assert finding(test, curves, BELOW_ROUNDING).verdict == NO
    alike = changed(curves, epsilon=0.0, omega=0.8, tau=0.0)
    assert finding(test, alike).verdict == YES


def test_equation_4_has_no_value_at_long_delays():
    """The points are counted: a delay of 1 or more leaves no logarithm."""
    tau = np.where(np.arange(12) < 3, 0.5, 2.0)
    words = finding("equation_4", changed(hopf_curve(), tau=tau)).evidence
    assert "no value at 9 of 12 points" in words


def test_equation_6():
    """On the curve, and beside it."""
    curves = hopf_curve()
    assert finding("equation_6", curves).verdict == YES
    beside = changed(curves, epsilon=curves.epsilon.values + 0.1)
    assert finding("equation_6", beside).verdict == NO


def test_equation_8_needs_a_correction_unless_gamma_is_1():
    """Where gamma^1 is gamma^2 the printed one holds."""
    assert finding("equation_8", hopf_curve()).verdict == PARTLY
    assert finding("equation_8", hopf_curve(gamma=1.0)).verdict == YES
    assert finding("equation_8", hopf_curve(), BELOW_ROUNDING).verdict == NO


def curve_at_delay(omega: np.ndarray):
    """A curve at a fixed delay of 12: xi by the closed form, from omega and tau."""
    tau = 12.0
    b = np.tan(omega * tau + np.arctan(omega))
    xi = b * 0.64 * omega / (0.64 - omega**2)
    curves = hopf_curve(ordinate="xi").isel(point=slice(omega.size))
    epsilon = np.sqrt((1 + omega**2) * (1 + b**2)) - 1
    return changed(curves, omega=omega, tau=tau, xi=xi, epsilon=epsilon)


def test_equation_9():
    """Right on the curve; that it also gives points beside a longer curve is a remark."""
    stretch = np.linspace(0.49, 0.53, 10)
    curves = curve_at_delay(stretch)
    assert (curves.xi > 0).all()
    assert finding("equation_9", curves).verdict == YES
    wrong = changed(curves, xi=curves.xi.values * 1.01)
    assert finding("equation_9", wrong).verdict == NO
    wide = curve_at_delay(np.append(stretch, 0.95))
    assert (wide.xi > 0).all()
    found = finding("equation_9", wide)
    assert found.verdict == YES
    beside = re.search(r"at (\d+) of (\d+) frequencies", found.evidence)
    assert 0 < int(beside[1]) < int(beside[2])
    assert "at 0 of " in finding("equation_9", curves).evidence


@pytest.mark.parametrize(
    ("printed", "corrected", "verdict"),
    [
        (1e-15, 1e-15, YES),
        (0.5, 1e-15, PARTLY),
        (0.5, 0.1, NO),
    ],
)
def test_equation_10(printed, corrected, verdict):
    """By the residuals that the curves carry; the largest one counts."""
    curves = changed(
        hopf_curve(),
        printed_residual=np.where(np.arange(12) == 7, printed, 0.0),
        residual=np.where(np.arange(12) == 3, corrected, 0.0),
    )
    found = finding("equation_10", curves)
    assert found.verdict == verdict
    assert f"{printed:.4g} with (10) as printed" in found.evidence


def test_hopf_curves_together():
    """As printed, as corrected, and neither; tau as printed counts only where tau is drawn."""
    assert finding("hopf_curves", hopf_curve()).verdict == PARTLY
    alike = hopf_curve(gamma=1.0, ordinate="xi")
    assert finding("hopf_curves", alike).verdict == YES
    assert finding("hopf_curves", hopf_curve(gamma=1.0)).verdict == PARTLY
    broken = changed(hopf_curve(), residual=1e-3)
    assert finding("hopf_curves", broken).verdict == NO


def test_lag_of_the_plate():
    """Curves with delays are not those without; at tau = 0 (5) has no delay."""
    assert finding("lag_of_the_plate", hopf_curve()).verdict == NO
    gamma, xi = 0.8, 0.5
    # the Hopf point without delay: omega^2 = epsilon = gamma^2 xi/(xi + gamma^2)
    epsilon = gamma**2 * xi / (xi + gamma**2)
    without = changed(hopf_curve(), epsilon=epsilon, omega=np.sqrt(epsilon), tau=0.0)
    assert finding("lag_of_the_plate", without).verdict == YES


def test_one_wrong_plane_is_enough():
    """The worst of several planes counts."""
    both = Results(curves={"a": hopf_curve(), "b": changed(hopf_curve(), residual=1e-3)})
    found = claims_of_formulas.hopf_curves(both, planes=["a", "b"], limit=LIMIT)
    assert found.verdict == NO
    assert "24 points" in found.evidence


def test_plane_without_curve_is_an_error():
    """Nothing is concluded from nothing."""
    with pytest.raises(ValueError, match="no Hopf curve in the window"):
        finding("equation_8", hopf_curve().isel(point=slice(0)))
