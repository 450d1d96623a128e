"""Verdicts on stability and Hopf bifurcations, on made-up tables and curves."""

import math

import numpy as np
import pytest
import xarray as xr
from made_up_results import (
    NO,
    PARTLY,
    YES,
    Results,
    attractor_row,
    changed,
    hopf_curve,
    on_plane,
    route_rows,
    stability_row,
)

from scripts.claims.claims_results import changes
from scripts.studies.atlas.roots_of_5 import unstable_pairs
from scripts.studies.hopf.claims import (
    amplitude_death,
    delay_destabilises,
    hopf_by_delay,
    hopf_by_delay_at_faults,
    hopf_depends_on,
    hopf_only_by_delay,
    independent_of_spring,
    kinds_of_hopf,
    pairs_gained_and_lost,
    roots_decide,
)

FIRST = np.arange(12) < 3
"""Three of the points of a curve."""
BELOW, ABOVE = {"epsilon": 0.2, "tau": 0.0}, {"epsilon": 0.4, "tau": 0.0}
"""Beside the Hopf point without delay, epsilon = gamma^2 xi/(xi + gamma^2) = 0.356 at xi = 0.8."""


def with_changes(*cells: str | float) -> Results:
    """Results of scenes a, b, ... whose stability changes at these delays."""
    rows = [
        stability_row(name, tau_of_changes=cell) for name, cell in zip("abc", cells, strict=False)
    ]
    return Results(linear_stability=rows)


def test_changes_of_a_cell():
    assert changes("2.5 (0 -> 1); 1e-3 (12 -> 11)") == [(2.5, 0, 1), (1e-3, 12, 11)]
    assert changes(math.nan) == []


@pytest.mark.parametrize(
    ("test", "cells", "verdict", "words"),
    [
        # stable without delay and unstable at some delay, in one scene at least
        (hopf_by_delay, ["2 (0 -> 1)", "1 (1 -> 0); 5 (0 -> 1)"], YES, "at $tau = 2$."),
        (hopf_by_delay, ["1 (1 -> 0); 5 (0 -> 1)"], NO, "unstable without delay in a ($epsilon"),
        (hopf_by_delay, [math.nan], NO, "No pair crosses the axis in a ($epsilon"),
        # every scene must have such a delay
        (delay_destabilises, ["2 (0 -> 1); 5 (1 -> 0)", "3 (0 -> 1)"], YES, "; b at $tau = 3$."),
        (delay_destabilises, ["2 (0 -> 1)", "2 (1 -> 2); 5 (2 -> 1)"], NO, "; b at no $tau$."),
        # fewer unstable pairs are not enough: none must be left
        (amplitude_death, ["2 (0 -> 1); 5 (1 -> 0)"], YES, "stability: a at $tau = 5$."),
        (amplitude_death, ["2 (2 -> 1); 5 (1 -> 2)"], NO, "stability: none."),
    ],
)
def test_changes_with_the_delay(test, cells, verdict, words):
    found = test(with_changes(*cells), scenes=list("abc"[: len(cells)]))
    assert found.verdict == verdict
    assert words.removesuffix(".") in found.evidence


def test_hopf_only_by_delay():
    """A point without delay refutes "only by", in its own plane; "merely by" needs a scene."""
    point = {"of": "plane", "kind": "hopf_without_delay", "xi": 0.5, "gamma": 0.8, "l1_1": -0.05}
    point["epsilon"] = 0.64 * 0.5 / 1.14
    made = with_changes("2 (0 -> 1)", "1 (1 -> 0); 5 (0 -> 1)")
    made.hopf_points = [point]
    assert hopf_only_by_delay(made, plane="plane", scenes=["b"]).verdict == NO
    found = hopf_only_by_delay(made, plane="plane", scenes=["a", "b"])
    assert found.verdict == PARTLY
    assert "Read as 'merely by a delay' it holds." in found.evidence
    made.hopf_points = [point | {"of": "other"}, point | {"kind": "double_hopf"}]
    assert hopf_only_by_delay(made, plane="plane", scenes=["b"]).verdict == YES


@pytest.mark.parametrize(("depth", "verdict"), [(1e-17, NO), (1e-3, YES)])
def test_hopf_by_delay_at_faults(depth, verdict):
    """The widest interval decides, among the gamma of faults alone; to have none is an error."""
    point = {"xi": 0.5, "without_delay": 0.5, "depth": depth}
    rows = [point | {"gamma": 0.8, "depth": 0.1}, point | {"gamma": 1e4}]
    rows.append(point | {"gamma": 1e6, "depth": 1e-25})
    given = {"least": 1e4, "most": 1e12, "limit": 1e-6}
    found = hopf_by_delay_at_faults(Results(fault_limit=rows), **given)
    assert found.verdict == verdict
    assert f"by at most {depth:.2g}, at $gamma = 1e+04$, where" in found.evidence
    with pytest.raises(ValueError, match="no gamma from 1e"):
        hopf_by_delay_at_faults(Results(fault_limit=rows[:1]), **given)


@pytest.mark.parametrize(
    ("l1", "pairs", "expected", "verdict"),
    [
        (-0.1, 0, ["supercritical"], YES),
        (0.1, 0, ["supercritical"], NO),
        (np.where(FIRST, 0.1, -0.1), 0, ["supercritical"], PARTLY),
        (np.where(FIRST, 0.1, -0.1), 0, ["supercritical", "subcritical"], YES),
        # a bifurcation beside other unstable pairs is counted, not judged
        (np.where(FIRST, 0.1, -0.1), np.where(FIRST, 1, 0), ["supercritical"], YES),
        (-0.1, 2, ["supercritical"], NO),
    ],
)
def test_kinds_of_hopf(l1, pairs, expected, verdict):
    """All of the kind, none, or some of another, where stability changes."""
    made = on_plane(changed(hopf_curve(), l1=l1, unstable_pairs=pairs))
    assert kinds_of_hopf(made, planes=["plane"], expected=expected).verdict == verdict


@pytest.mark.parametrize(
    ("crossing", "verdict"), [(np.where(FIRST, 1, -1), YES), (1, NO), (-1, NO)]
)
def test_pairs_gained_and_lost(crossing, verdict):
    made = on_plane(changed(hopf_curve(), crossing=crossing))
    assert pairs_gained_and_lost(made, plane="plane").verdict == verdict


@pytest.mark.parametrize(
    ("with_tau", "with_xi", "pairs", "verdict"),
    [(0.1, 0.1, 0, PARTLY), (0.0, 0.1, 0, YES), (0.1, 0.0, 0, NO), (0.1, 0.1, 1, NO)],
)
def test_hopf_depends_on(with_tau, with_xi, pairs, verdict):
    """On xi it must, on the delay it must not; where no stability changes it depends on nothing."""
    curves = {
        name: changed(
            hopf_curve(), epsilon=np.linspace(0.3, 0.3 + spread, 12), unstable_pairs=pairs
        )
        for name, spread in (("a", with_tau), ("b", with_xi))
    }
    found = hopf_depends_on(Results(curves=curves), at_fixed_xi="a", at_fixed_tau="b", limit=1e-3)
    assert found.verdict == verdict
    assert found.instead.endswith("also depends on $tau$.") == (verdict == PARTLY)


@pytest.mark.parametrize(
    ("rows", "verdict"),
    [
        ([("fixed point", BELOW), ("torus", ABOVE)], YES),
        ([("fixed point", BELOW), ("cycle", BELOW), ("chaos", ABOVE)], YES),
        ([("fixed point", BELOW), ("undecided", ABOVE)], NO),
        ([("fixed point", BELOW), ("cycle", ABOVE), ("fixed point", ABOVE)], NO),
        ([("fixed point", BELOW), ("cycle", {**ABOVE, "largest_maximum": 1 + 1e-6})], NO),
        ([("fixed point", BELOW)], NO),
        # points of the atlas that were not computed have the class of their neighbours
        ([("fixed point", BELOW), ("cycle", ABOVE), ("chaos", {**ABOVE, "computed": "no"})], YES),
        ([("fixed point", BELOW), ("cycle", ABOVE), ("fixed point", {"computed": "no"})], YES),
    ],
)
def test_roots_decide(rows, verdict):
    """No rest with an unstable root; with none, rest or another attractor; both must be met."""
    made = [attractor_row(met, **given) for met, given in rows]
    found = roots_decide(Results(atlas=made[1:], attractors=made[:1]), least_motion=1e-3)
    assert found.verdict == verdict
    counted = [met for met, given in rows if met != "undecided" and "computed" not in given]
    assert found.evidence.startswith(f"{len(counted)} computed motions ")


@pytest.mark.parametrize(
    ("given", "pairs"),
    [
        ({"epsilon": 0.355, "tau": 0.0}, 0),
        ({"epsilon": 0.357, "tau": 0.0}, 1),
        ({"epsilon": -0.5, "tau": 50.0}, 0),
    ],
)
def test_pairs_without_delay_and_without_crossing(given, pairs):
    """By Routh and Hurwitz; and friction that grows with v is stable at every delay."""
    assert unstable_pairs(xi=0.8, gamma=0.8, **given) == pairs


@pytest.mark.parametrize("k", [1, 2])
def test_pairs_change_on_hopf_curves(k):
    """By one, and nowhere else: on curves in closed form, a little to both sides."""
    curves = hopf_curve(k=k)
    for epsilon, tau in zip(curves.epsilon.values, curves.tau.values, strict=True):
        before, after = (
            unstable_pairs(epsilon=epsilon, tau=tau + off, xi=0.5, gamma=0.8)
            for off in (-1e-6, 1e-6)
        )
        assert abs(after - before) == 1


@pytest.mark.parametrize(("plane", "xi"), [("tau_of_epsilon", 0.5), ("tau_of_epsilon_xi_08", 0.8)])
def test_pairs_are_those_of_the_program(smoke, plane, xi):
    """The program counts them by the argument principle, in every cell of the plane."""
    curves = xr.load_dataset(smoke.folder / "results" / "hopf" / f"{plane}.nc")
    counted = [
        [
            unstable_pairs(epsilon=float(epsilon), tau=float(tau), xi=xi, gamma=0.8)
            for epsilon in curves.map_epsilon
        ]
        for tau in curves.map_ordinate
    ]
    np.testing.assert_array_equal(curves.map_unstable_pairs, counted)
    assert curves.map_unstable_pairs.max() >= 2


@pytest.mark.parametrize(
    ("given", "classes", "verdict"),
    [
        ({"epsilon": 0.3}, ["chaos"] * 4, YES),
        ({}, ["chaos"] * 4, NO),
        ({"epsilon": 0.3}, ["cycle"] * 2 + ["chaos"] * 2, NO),
        ({"unstable_pairs": 1}, ["chaos"] * 4, NO),
    ],
)
def test_independent_of_spring(given, classes, verdict):
    """The same epsilon and class at every xi, or one that changes; or no such point at all."""
    curves = changed(hopf_curve(), xi=np.linspace(0.1, 1, 12), tau=12.0)
    made = Results(
        curves={"plane": changed(curves, **given)}, routes=route_rows(*classes, along="xi")
    )
    found = independent_of_spring(made, plane="plane", route="mine", limit=1e-3)
    assert found.verdict == verdict
