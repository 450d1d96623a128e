"""Verdicts on stability and Hopf bifurcations, on made-up tables and curves."""

import math

import numpy as np
import pytest
import xarray as xr
from made_up_results import (
    attractor_row,
    changed,
    hopf_curve,
    on_plane,
    results,
    route_rows,
    stability_row,
)

from scripts.claims.claims_of_bifurcations import TESTS
from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    REPRODUCED,
    changes,
)
from scripts.claims.roots_of_5 import unstable_pairs

BOTH = ["supercritical", "subcritical"]


def with_scenes(**rows):
    """Results with linear stability of scenes."""
    return results(linear_stability=[stability_row(name, **row) for name, row in rows.items()])


def test_changes_of_a_cell():
    """Every place with its pairs; none of an empty cell."""
    assert changes("2.5 (0 -> 1); 1e-3 (12 -> 11)") == [(2.5, 0, 1), (1e-3, 12, 11)]
    assert changes(math.nan) == []


def test_hopf_only_by_delay():
    """A point without delay refutes "only by", in its own plane; "merely by" needs a scene."""
    point = {"of": "plane", "kind": "hopf_without_delay", "xi": 0.5, "gamma": 0.8, "l1_1": -0.05}
    point["epsilon"] = 0.64 * 0.5 / 1.14
    test = TESTS["hopf_only_by_delay"]
    scenes = {"good": {}, "mine": {"tau_of_changes": "1 (1 -> 0); 5 (0 -> 1)"}}
    made = with_scenes(**scenes)
    made.hopf_points = [point]
    assert test(made, plane="plane", scenes=["mine"]).verdict == NOT_REPRODUCED
    found = test(made, plane="plane", scenes=["good", "mine"])
    assert found.verdict == CORRECTED
    assert "Read as 'merely by a delay' it holds." in found.evidence
    assert "already unstable without delay in mine (epsilon" in found.evidence
    assert "epsilon = 0.280701754" in found.evidence
    assert "gamma^2 xi/(xi + gamma^2) = 0.280701754" in found.evidence
    assert "supercritical" in found.evidence
    others = [point | {"of": "other"}, point | {"kind": "double_hopf"}]
    made.hopf_points = others
    assert test(made, plane="plane", scenes=["mine"]).verdict == REPRODUCED


@pytest.mark.parametrize(("depth", "verdict"), [(1e-17, NOT_REPRODUCED), (1e-3, REPRODUCED)])
def test_hopf_by_delay_at_faults(depth, verdict):
    """The widest interval decides, among the gamma of faults alone; to have none is an error."""
    point = {"xi": 0.5, "without_delay": 0.5, "depth": depth}
    rows = [point | {"gamma": 0.8, "depth": 0.1}, point | {"gamma": 1e4}]
    rows.append(point | {"gamma": 1e6, "depth": 1e-25})
    given = {"least": 1e4, "most": 1e12, "limit": 1e-6}
    test = TESTS["hopf_by_delay_at_faults"]
    found = test(results(fault_limit=rows), **given)
    assert found.verdict == verdict
    assert f"by at most {depth:.2g}, at gamma = 1e+04, where" in found.evidence
    with pytest.raises(ValueError, match="no gamma from 1e"):
        test(results(fault_limit=rows[:1]), **given)


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
    assert found.instead == "Steady sliding does not change its stability."
    found = test(on_plane(changed(curves, l1=0.1)), planes=["plane"], expected=["supercritical"])
    assert found.instead == "All 9 points are subcritical."


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
    ("crossing", "verdict", "instead"),
    [
        (np.where(np.arange(12) < 3, 1, -1), REPRODUCED, ""),
        (1, NOT_REPRODUCED, "A longer delay makes no pair stable."),
        (-1, NOT_REPRODUCED, "A longer delay makes no pair unstable."),
    ],
)
def test_pairs_gained_and_lost(crossing, verdict, instead):
    """Both signs are needed."""
    made = on_plane(changed(hopf_curve(), crossing=crossing))
    found = TESTS["pairs_gained_and_lost"](made, plane="plane")
    assert (found.verdict, found.instead) == (verdict, instead)


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
    place = {"tau": 5.25, "epsilon": 0.5, "xi": 0.8, "histories": 60.0}
    made.basins = [place | {"class": met, "share": 0.5} for met in ("cycle", "fixed point")]
    found = TESTS["amplitude_death"](made, scenes=["mine"])
    assert found.verdict == verdict
    assert "50 % of 60 at tau = 5.25, epsilon = 0.5, xi = 0.8." in found.evidence
    assert words in found.evidence


@pytest.mark.parametrize(
    ("cells", "verdict"),
    [
        (["2 (0 -> 1)", "1 (1 -> 0); 5 (0 -> 1)"], REPRODUCED),
        (["1 (1 -> 0); 5 (0 -> 1)"], NOT_REPRODUCED),
        ([math.nan], NOT_REPRODUCED),
    ],
)
def test_hopf_by_delay(cells, verdict):
    """Stable without delay and unstable at some delay, in one scene at least."""
    names = [f"scene_{i}" for i in range(len(cells))]
    made = with_scenes(
        **{name: {"tau_of_changes": cell} for name, cell in zip(names, cells, strict=True)}
    )
    found = TESTS["hopf_by_delay"](made, scenes=names)
    assert found.verdict == verdict
    assert ("at tau = 2" in found.evidence) == (verdict == REPRODUCED)


@pytest.mark.parametrize(
    ("with_tau", "with_xi", "verdict"),
    [
        (0.1, 0.1, CORRECTED),
        (0.0, 0.1, REPRODUCED),
        (0.1, 0.0, NOT_REPRODUCED),
    ],
)
def test_hopf_depends_on(with_tau, with_xi, verdict):
    """On xi it must, on the delay it must not."""
    curves = {
        name: changed(hopf_curve(), epsilon=np.linspace(0.3, 0.3 + spread, 12))
        for name, spread in (("a", with_tau), ("b", with_xi))
    }
    test = TESTS["hopf_depends_on"]
    found = test(results(curves=curves), at_fixed_xi="a", at_fixed_tau="b", limit=1e-3)
    assert found.verdict == verdict
    assert found.instead.endswith("also depends on tau.") == (verdict == CORRECTED)
    nowhere = {name: changed(curve, unstable_pairs=1) for name, curve in curves.items()}
    found = test(results(curves=nowhere), at_fixed_xi="a", at_fixed_tau="b", limit=1e-3)
    assert found.verdict == NOT_REPRODUCED


BELOW, ABOVE = {"epsilon": 0.2, "tau": 0.0}, {"epsilon": 0.4, "tau": 0.0}
"""Beside the Hopf point without delay, epsilon = gamma^2 xi/(xi + gamma^2) = 0.356 at xi = 0.8."""


@pytest.mark.parametrize(
    ("rows", "verdict"),
    [
        ([("fixed point", BELOW), ("torus", ABOVE)], REPRODUCED),
        ([("fixed point", BELOW), ("cycle", BELOW), ("chaos", ABOVE)], REPRODUCED),
        ([("fixed point", BELOW), ("undecided", ABOVE)], NOT_REPRODUCED),
        ([("fixed point", BELOW), ("cycle", ABOVE), ("fixed point", ABOVE)], NOT_REPRODUCED),
        (
            [("fixed point", BELOW), ("cycle", {**ABOVE, "largest_maximum": 1 + 1e-6})],
            NOT_REPRODUCED,
        ),
        ([("cycle", BELOW), ("cycle", ABOVE)], NOT_REPRODUCED),
        ([("fixed point", BELOW)], NOT_REPRODUCED),
    ],
)
def test_roots_decide(rows, verdict):
    """No rest with an unstable root; with none, rest or another attractor; both must be met."""
    made = [attractor_row(met, **given) for met, given in rows]
    found = TESTS["roots_decide"](results(atlas=made[1:], attractors=made[:1]), least_motion=1e-3)
    assert found.verdict == verdict


def test_roots_decide_counts_computed_points_only():
    """The others have the class of their neighbours."""
    rows = [
        attractor_row("cycle", computed="yes", **ABOVE),
        attractor_row("fixed point", computed="yes", **BELOW),
        attractor_row("fixed point", computed="no", largest_maximum=math.nan, **ABOVE),
        attractor_row("cycle", computed="no", largest_maximum=math.nan, **ABOVE),
    ]
    found = TESTS["roots_decide"](results(atlas=rows), least_motion=1e-3)
    assert found.verdict == REPRODUCED
    assert found.evidence.startswith("2 computed motions ")
    assert "nan" not in found.evidence


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
    """Which counts them by the argument principle, in every cell of the plane."""
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


def test_independent_of_spring():
    """The same epsilon and class at every xi, or one that changes; or no such point at all."""
    curves = changed(hopf_curve(), xi=np.linspace(0.1, 1, 12), tau=12.0)
    same = changed(curves, epsilon=0.3)
    alike, other = ["chaos"] * 4, ["cycle"] * 2 + ["chaos"] * 2

    def found(given, classes):
        made = on_plane(given)
        made.routes = route_rows(*classes, along="xi")
        return TESTS["independent_of_spring"](made, plane="plane", route="mine", limit=1e-3)

    assert found(same, alike).verdict == REPRODUCED
    assert found(curves, alike).instead == (
        "With xi = k L/A changes the critical epsilon of stability."
    )
    assert found(same, other).instead == (
        "With xi = k L/A changes the class of the motion at one epsilon."
    )
    evidence = found(curves, other).evidence
    assert "At tau = 12 " in evidence
    assert "Along xi at epsilon = 0.5 and tau = 10: cycle 0.1 to 0.2, chaos 0.3 to 0.4." in evidence
    assert found(changed(curves, unstable_pairs=1), alike).verdict == NOT_REPRODUCED
