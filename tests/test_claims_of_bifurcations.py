"""Verdicts on stability and Hopf bifurcations, on made-up tables and curves."""

import math

import numpy as np
import pytest
from made_up_results import (
    attractor_row,
    changed,
    hopf_curve,
    on_plane,
    results,
    stability_row,
)

from scripts.claims.claims_of_bifurcations import TESTS
from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    REPRODUCED,
    changes,
)

BOTH = ["supercritical", "subcritical"]


def with_scenes(**rows):
    """Results with linear stability of scenes."""
    return results(linear_stability=[stability_row(name, **row) for name, row in rows.items()])


def test_changes_of_a_cell():
    """Every place with its pairs; none of an empty cell."""
    assert changes("2.5 (0 -> 1); 1e-3 (12 -> 11)") == [(2.5, 0, 1), (1e-3, 12, 11)]
    assert changes(math.nan) == []


def test_hopf_only_by_delay():
    """A point without delay refutes it, in its own plane only."""
    point = {"of": "plane", "kind": "hopf_without_delay", "xi": 0.5, "gamma": 0.8, "l1_1": -0.05}
    point["epsilon"] = 0.64 * 0.5 / 1.14
    test = TESTS["hopf_only_by_delay"]
    found = test(results(hopf_points=[point]), plane="plane")
    assert found.verdict == NOT_REPRODUCED
    assert "epsilon = 0.280701754" in found.evidence
    assert float(found.evidence.split("a2 a1 - a0 = ")[1].split(" ")[0]) == pytest.approx(
        0, abs=1e-15
    )
    others = [point | {"of": "other"}, point | {"kind": "double_hopf"}]
    assert test(results(hopf_points=others), plane="plane").verdict == REPRODUCED


@pytest.mark.parametrize(
    ("l1", "expected", "verdict"),
    [
        (-0.1, ["supercritical"], REPRODUCED),
        (0.1, ["supercritical"], NOT_REPRODUCED),
        (np.where(np.arange(12) < 3, 0.1, -0.1), ["supercritical"], CORRECTED),
        (np.where(np.arange(12) < 3, 0.1, -0.1), BOTH, REPRODUCED),
        (-0.1, BOTH, NOT_REPRODUCED),
    ],
)
def test_kinds_of_hopf(l1, expected, verdict):
    """All of the kind, none, or some of another."""
    found = TESTS["kinds_of_hopf"](
        on_plane(changed(hopf_curve(), l1=l1)), planes=["plane"], expected=expected
    )
    assert found.verdict == verdict


def test_kinds_count_where_stability_changes():
    """A bifurcation beside other unstable pairs is counted, not judged."""
    curves = changed(hopf_curve(), l1=np.where(np.arange(12) < 3, 0.1, -0.1))
    curves = changed(curves, unstable_pairs=np.where(np.arange(12) < 3, 1, 0))
    test = TESTS["kinds_of_hopf"]
    found = test(on_plane(curves), planes=["plane"], expected=["supercritical"])
    assert found.verdict == REPRODUCED
    assert "Of all 12 points 3 are subcritical" in found.evidence
    nowhere = changed(curves, unstable_pairs=2)
    found = test(on_plane(nowhere), planes=["plane"], expected=["supercritical"])
    assert found.verdict == NOT_REPRODUCED


@pytest.mark.parametrize(
    ("cell", "verdict"),
    [("2 (0 -> 1)", REPRODUCED), ("2 (1 -> 2); 5 (2 -> 1)", NOT_REPRODUCED)],
)
def test_delay_destabilises(cell, verdict):
    """Each scene must have such a delay."""
    made = with_scenes(good={}, mine={"tau_of_changes": cell})
    found = TESTS["delay_destabilises"](made, scenes=["good", "mine"])
    assert found.verdict == verdict
    assert ("mine at no tau" in found.evidence) == (verdict == NOT_REPRODUCED)


@pytest.mark.parametrize(
    ("crossing", "verdict"),
    [
        (np.where(np.arange(12) < 3, 1, -1), REPRODUCED),
        (1, NOT_REPRODUCED),
        (-1, NOT_REPRODUCED),
    ],
)
def test_pairs_gained_and_lost(crossing, verdict):
    """Both signs are needed."""
    made = on_plane(changed(hopf_curve(), crossing=crossing))
    assert TESTS["pairs_gained_and_lost"](made, plane="plane").verdict == verdict


@pytest.mark.parametrize(
    ("cell", "verdict", "words"),
    [
        ("2 (0 -> 1); 5 (1 -> 0)", REPRODUCED, "mine at tau = 5."),
        ("2 (2 -> 1); 5 (1 -> 2)", NOT_REPRODUCED, "none"),
    ],
)
def test_amplitude_death(cell, verdict, words):
    """Fewer unstable pairs are not enough: none must be left."""
    made = with_scenes(mine={"tau_of_changes": cell})
    found = TESTS["amplitude_death"](made, scenes=["mine"])
    assert found.verdict == verdict
    assert words in found.evidence


@pytest.mark.parametrize(
    ("pairs", "met", "verdict"),
    [
        (0, "fixed point", REPRODUCED),
        (1, "torus", REPRODUCED),
        (0, "cycle", NOT_REPRODUCED),
        (1, "fixed point", NOT_REPRODUCED),
        (1, "undecided", NOT_REPRODUCED),
    ],
)
def test_roots_decide(pairs, met, verdict):
    """Rest without unstable pair, motion with one."""
    made = results(
        linear_stability=[stability_row(unstable_pairs=pairs)], attractors=[attractor_row(met)]
    )
    assert TESTS["roots_decide"](made, scenes=["mine"]).verdict == verdict


def test_independent_of_spring():
    """The same epsilon at every xi, or not; or no such point at all."""
    test = TESTS["independent_of_spring"]
    curves = changed(hopf_curve(), xi=np.linspace(0.1, 1, 12), tau=12.0)
    found = test(on_plane(curves), plane="plane", limit=1e-3)
    assert found.verdict == NOT_REPRODUCED
    assert "At tau = 12 " in found.evidence
    same = on_plane(changed(curves, epsilon=0.3))
    assert test(same, plane="plane", limit=1e-3).verdict == REPRODUCED
    nowhere = on_plane(changed(curves, unstable_pairs=1))
    assert test(nowhere, plane="plane", limit=1e-3).verdict == NOT_REPRODUCED
