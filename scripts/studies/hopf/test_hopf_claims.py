"""Verdicts on stability and Hopf bifurcations, on made-up tables and curves."""

import math

import numpy as np
import pytest
from made_up_results import (
    NO,
    PARTLY,
    YES,
    Results,
    changed,
    hopf_curve,
    on_plane,
    stability_row,
)

from scripts.studies.hopf.claims import (
    hopf_by_delay,
    hopf_depends_on,
    hopf_only_by_delay,
    kinds_of_hopf,
    pairs_gained_and_lost,
)

FIRST = np.arange(12) < 3
"""Three of the points of a curve."""


def with_changes(*cells: str | float) -> Results:
    """Results of scenes a, b, ... whose stability changes at these delays."""
    rows = [
        stability_row(name, tau_of_changes=cell) for name, cell in zip("abc", cells, strict=False)
    ]
    return Results(linear_stability=rows)


@pytest.mark.parametrize(
    ("cells", "verdict", "words"),
    [
        # stable without delay and unstable at some delay, in one scene at least
        (["2 (0 -> 1)", "1 (1 -> 0); 5 (0 -> 1)"], YES, "at $tau = 2$."),
        (["1 (1 -> 0); 5 (0 -> 1)"], NO, "unstable without delay in a ($epsilon"),
        ([math.nan], NO, "No pair crosses the axis in a ($epsilon"),
    ],
)
def test_hopf_by_delay(cells, verdict, words):
    found = hopf_by_delay(with_changes(*cells), scenes=list("abc"[: len(cells)]))
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
