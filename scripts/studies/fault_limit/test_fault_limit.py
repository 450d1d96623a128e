"""The least epsilon of all Hopf curves, and the answer to the question about real faults."""

import math
from decimal import Decimal, localcontext

import numpy as np
import pytest
import xarray as xr
from made_up_results import NO, YES, assert_finding, cases, finding

from scripts.studies.fault_limit import table as fault_limit_table
from scripts.studies.fault_limit.finding import describe
from scripts.workflow.plan import read_plan

CONFIG = read_plan({}).config


def least_by_6(gamma: float, xi: float) -> tuple[Decimal, Decimal]:
    """The least epsilon by (6) without the delay, and omega^2, in 160 digits by ternary search.

    (6) gives X sin(omega tau) and X cos(omega tau), X = omega (1 + epsilon) gamma^2/xi.
    """
    square, xi = Decimal(gamma) ** 2, Decimal(xi)

    def epsilon(x: Decimal) -> Decimal:
        sine = x * (square / xi + 1) - square
        cosine = x - square * (1 + xi) / xi
        return ((sine**2 + x * cosine**2) / (x * (square / xi) ** 2)).sqrt() - 1

    low, high = Decimal(0), 10 * square * xi / (xi + square)
    for _ in range(700):
        one, two = (2 * low + high) / 3, (low + 2 * high) / 3
        low, high = (low, two) if epsilon(one) < epsilon(two) else (one, high)
    return epsilon(low), low


@pytest.mark.parametrize("xi", [0.3, 0.5, 2.0])
@pytest.mark.parametrize("gamma", [0.1, 0.8, 3.0, 10.0, 1e4, 1e8, 1e12])
def test_least_epsilon_in_many_digits(gamma, xi):
    """Against (6); also its distance from gamma^2 xi/(xi + gamma^2), down to 1e-50."""
    row = fault_limit_table.row_of(xi, gamma)
    with localcontext(prec=160):
        least, x = least_by_6(gamma, xi)
        without = Decimal(gamma) ** 2 * Decimal(xi) / (Decimal(xi) + Decimal(gamma) ** 2)
        depth = float(without - least)
    assert row["depth"] == pytest.approx(depth, rel=1e-10)
    assert row["least"] == pytest.approx(float(least), rel=1e-13)
    assert row["without_delay"] == pytest.approx(float(without), rel=1e-14)
    assert row["omega"] == pytest.approx(float(x.sqrt()), rel=1e-10)


LAWS = {
    "slip_delayed_logarithm": lambda theta, w, b: -math.exp(w) * (theta + b * w),
    "ageing_delayed_velocity": lambda theta, w, b: b * (math.exp(-theta / b) - math.exp(w)),
}
"""theta' without delay, with b = 1 + epsilon."""
XI = 0.5


def coefficient(law: str, gamma: float) -> float:
    return fault_limit_table.lyapunov_coefficients(XI, gamma)[f"l1_{law.partition('_')[0]}"]


@pytest.mark.parametrize("gammas", [[0.1, 1.5], [1.0, 6.0], [0.9e4, 1.1e4]])
@pytest.mark.parametrize("law", LAWS)
def test_kind_of_hopf_point_without_delay(programs, law, gammas):
    """Against the program's l1, and the place where it finds l1 = 0: a root of the cubic."""
    abscissa = [fault_limit_table.row_of(XI, gamma)["without_delay"] for gamma in gammas]
    plane = {"law": law, "ordinate": "gamma", "tau": 0.0, "xi": XI, "cells": 20}
    plane |= {"abscissa_window": [0.9 * abscissa[0], 1.1 * abscissa[1]], "ordinate_window": gammas}
    curves = programs.made_by("hopf", plane)
    known = [coefficient(law, gamma) for gamma in curves.gamma.values]
    assert len(known) > 10
    np.testing.assert_allclose(curves.l1, known, rtol=1e-7, atol=1e-13)
    (change,) = (y for y in np.roots([1, -5, -(13 + 4 * XI), -7]) if y > 0)
    change = math.sqrt(XI * change)
    found = curves.special_gamma[curves.special_kind == "generalised_hopf"]
    has_change = law.startswith("ageing") and gammas[0] < change < gammas[1]
    np.testing.assert_allclose(found, [change] * has_change, rtol=1e-9)


@pytest.mark.parametrize("branch", [1, 2, 3])
@pytest.mark.parametrize("gamma", [0.3, 0.8, 3.0, 10.0, 30.0])
def test_least_epsilon_is_on_a_curve_of_the_program(programs, gamma, branch):
    """Which knows the characteristic function alone: none of its points is lower, and of each
    branch one is that low but for a chord, 1e-4 of the window."""
    row = fault_limit_table.row_of(0.5, gamma)
    window = [row["least"] - row["depth"], row["least"] + 0.9 * row["depth"]]
    tau = row["tau"] + 2 * math.pi * (branch - 1) / row["omega"]
    delays = [tau * (1 + side * math.sqrt(row["depth"])) for side in (-2, 2)]
    plane = CONFIG["hopf_curves"]["tau_of_epsilon"] | {"gamma": gamma, "cells": 10}
    plane |= {"abscissa_window": window, "ordinate_window": delays}
    curves = programs.made_by("hopf", plane)
    assert float(curves.epsilon.min()) - row["least"] + 1e-14 >= 0
    of_branch = curves.isel(point=curves.branch.values == branch)
    lowest = of_branch.isel(point=int(of_branch.epsilon.values.argmin()))
    assert float(lowest.epsilon) - row["least"] < 2e-4 * row["depth"]
    assert float(lowest.tau) == pytest.approx(tau, rel=0.005)


def test_no_delay_destabilises_at_large_gamma(smoke):
    """At gamma = 1e8 the program counts no root to the right below epsilon = xi, at any delay; at
    gamma = 0.8 it does below the Hopf point without delay.
    """
    for plane, unstable in (("tau_of_epsilon_fault", False), ("tau_of_epsilon", True)):
        curves = xr.load_dataset(smoke.folder / "results" / "hopf" / f"{plane}.nc")
        row = fault_limit_table.row_of(0.5, curves.attrs["gamma"])
        stable = curves.map_unstable_roots[:, curves.map_abscissa.values < row["without_delay"]]
        assert stable.sizes["map_abscissa"] > 5
        assert bool((stable > 0).any()) is unstable


AT_FAULTS = {"least": 1e4, "most": 1e12, "limit": 1e-6}


def least_epsilon(**depths: float) -> dict:
    """Results with these depths at gamma = 0.8, 1e4 and 1e6."""
    gammas = {"paper": 0.8, "least": 1e4, "larger": 1e6}
    point = {"xi": 0.5, "without_delay": 0.5}
    rows = [{**point, "gamma": gammas[name], "depth": depth} for name, depth in depths.items()]
    return {"fault_limit": rows}


@cases(
    (
        # the widest interval decides, among the gamma of faults alone
        *("hopf_by_delay_at_faults", AT_FAULTS),
        (
            *(least_epsilon(paper=0.1, least=1e-17, larger=1e-25), NO),
            "by at most 1e-17, at $gamma = 1e+04$, where",
        ),
        (
            least_epsilon(paper=0.1, least=1e-3, larger=1e-25),
            YES,
            "by at most 0.001, at $gamma = 1e",
        ),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


def test_no_gamma_of_faults_is_an_error():
    with pytest.raises(ValueError, match="no gamma from 10000 to 1e"):
        finding("hopf_by_delay_at_faults", least_epsilon(paper=0.1), **AT_FAULTS)


def test_finding_has_the_numbers_of_the_tables():
    kinds = ("a", "hopf_without_delay"), ("b", "generalised_hopf"), ("c", "amplitude_death_begin")
    limit = {"xi": 0.5, "without_delay": 0.25}
    tables = {
        "hopf_points": [{"of": of, "kind": kind} for of, kind in kinds],
        "fault_limit": [
            limit | {"gamma": gamma, "depth": depth}
            for gamma, depth in ((0.8, 0.0481), (1e4, 9.3e-18))
        ],
    }
    found = describe(tables)
    # 10^3 (1 + 10)/(2 10^16) = 5.5e-13
    assert found["title"].endswith("wide for $xi = 0.5$, and narrower than 1e-12 up to $xi = 10$.")
    for words in ("$epsilon = 0.25$ for $xi = 0.5$", "by 0.048.", "9.3e-18 for", "5.5e-13 for"):
        assert words in found["words"]
    assert "Along the Hopf curves of 2 planes" in found["words"]
