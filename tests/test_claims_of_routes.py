"""Verdicts on what changes along a parameter, on made-up tables of routes."""

import pytest
from made_up_results import (
    attractor_row,
    changed,
    hopf_curve,
    results,
    route_rows,
    stability_row,
    torus_point,
)

from scripts.claims.claims_of_routes import TESTS
from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, REPRODUCED
from scripts.tables.motion_rows import UNDECIDED


def twice(*classes: str) -> list[str]:
    """Each class at two neighbouring points."""
    return [name for name in classes for _ in range(2)]


def of_route(*classes: str):
    """Results of a route with one run."""
    return results(routes=route_rows(*classes))


@pytest.mark.parametrize(
    ("classes", "verdict"),
    [
        (twice("fixed point", "cycle", "torus", "chaos"), REPRODUCED),
        (twice("cycle", UNDECIDED, "torus", UNDECIDED, "chaos", "cycle"), REPRODUCED),
        (twice("cycle", "chaos", "cycle", "torus", "chaos"), REPRODUCED),
        (twice("cycle", "torus", "cycle/7", "chaos"), REPRODUCED),
        (twice("cycle", "torus", "cycle/1", "chaos"), NOT_REPRODUCED),
        (twice("cycle", "chaos", "torus"), NOT_REPRODUCED),
        (twice("cycle/1", "cycle/2", "cycle/4", "chaos"), NOT_REPRODUCED),
        (twice("torus", "chaos"), NOT_REPRODUCED),
        (twice(UNDECIDED), NOT_REPRODUCED),
    ],
)
def test_route(classes, verdict):
    """Classes follow each other; a cycle of several points behind a torus is locked there."""
    expected = {"expected": ["cycle", "torus", "chaos"]}
    assert TESTS["route"](of_route(*classes), routes=["mine"], **expected).verdict == verdict


def test_one_point_decides_nothing():
    """Unless another run has the same class there."""
    classes = ["cycle", "cycle", "torus", "chaos", "chaos"]
    test, rows = TESTS["route"], route_rows(*classes)
    claim = {"routes": ["mine"], "expected": ["cycle", "torus"]}
    assert test(results(routes=rows), **claim).verdict == NOT_REPRODUCED
    found = test(results(routes=rows + route_rows(*classes, run="up")), **claim)
    assert found.verdict == REPRODUCED
    assert "cycle 0.1 to 0.2, torus 0.3; in 2 of 2 runs." in found.evidence


def test_evidence_of_a_route():
    """What varies, the values of the others, where, and in how many runs."""
    rows = route_rows(*twice("cycle", "torus"), along="xi")
    rows += route_rows(*twice("cycle", "chaos"), along="xi", run="up")
    claim = {"routes": ["mine"], "expected": ["cycle", "torus"]}
    assert TESTS["route"](results(routes=rows), **claim).evidence == (
        "Along xi (tau = 10, epsilon = 0.5, gamma = 0.8): cycle 0.1 to 0.2, torus 0.3 to 0.4;"
        " in 1 of 2 runs."
    )


def test_evidence_is_of_the_run_with_the_longest_stretches():
    """Of two that show the same."""
    rows = route_rows(*twice("cycle", UNDECIDED, "torus"))
    rows += route_rows(*twice("cycle"), *["torus"] * 4, run="up")
    claim = {"routes": ["mine"], "expected": ["cycle", "torus"]}
    evidence = TESTS["route"](results(routes=rows), **claim).evidence
    assert evidence.endswith("cycle 0.1 to 0.2, torus 0.3 to 0.6; in 2 of 2 runs.")


def test_one_route_of_several_is_enough():
    """For a sequence that the paper reports."""
    rows = route_rows(*twice("cycle", "torus")) + route_rows(*twice("cycle", "chaos"), name="other")
    claim = {"routes": ["other", "mine"], "expected": ["cycle", "torus"]}
    found = TESTS["route"](results(routes=rows), **claim)
    assert found.verdict == REPRODUCED
    assert "in none of 1 runs. Along tau" in found.evidence


@pytest.mark.parametrize(
    ("first", "second", "verdict"),
    [
        (("cycle", "chaos"), ("torus", "fixed point", "chaos"), REPRODUCED),
        (("cycle", "chaos"), ("chaos", "cycle"), CORRECTED),
        (("chaos",), ("chaos", "cycle"), NOT_REPRODUCED),
    ],
)
def test_leads_to(first, second, verdict):
    """Along all routes, along some, along none."""
    rows = route_rows(*twice(*first)) + route_rows(*twice(*second), name="other", along="xi")
    claim = {"routes": ["mine", "other"], "before": ["cycle", "fixed point"], "after": "chaos"}
    found = TESTS["leads_to"](results(routes=rows), **claim)
    assert found.verdict == verdict
    assert ("cycle 0.1 to 0.2, chaos 0.3 to 0.4" in found.evidence) == (first == ("cycle", "chaos"))


@pytest.mark.parametrize(
    ("met", "delays", "along", "points", "verdict"),
    [
        (["cycle", "torus"], [0.1, 7.0], ["chaos"], [], REPRODUCED),
        (["cycle", "torus"], [7.0, 7.0], ["cycle", "torus"], [torus_point()], CORRECTED),
        (["cycle", "cycle"], [0.1, 7.0], ["cycle", "torus"], [torus_point()], CORRECTED),
        (["cycle", "cycle"], [0.1, 7.0], ["cycle", "torus"], [], NOT_REPRODUCED),
        (["cycle", "cycle"], [0.1, 7.0], ["cycle"], [torus_point()], NOT_REPRODUCED),
    ],
)
def test_delays_in_turn(met, delays, along, points, verdict):
    """By the scenes and their delays, or by a route with a torus bifurcation."""
    made = results(
        attractors=[attractor_row(name, scene) for name, scene in zip(met, "ab", strict=True)],
        linear_stability=[
            stability_row(scene, tau=tau) for scene, tau in zip("ab", delays, strict=True)
        ],
        routes=route_rows(*twice(*along)),
        cycle_points=points,
    )
    claim = {"scenes": ["a", "b"], "expected": ["cycle", "torus"], "route": "mine"}
    found = TESTS["delays_in_turn"](made, **claim)
    assert found.verdict == verdict
    assert ("These delays grow" in found.evidence) == (delays[0] < delays[1])


@pytest.mark.parametrize(
    ("point", "verdict"),
    [
        (torus_point(), REPRODUCED),
        (torus_point(0.2), REPRODUCED),
        (torus_point(0.15), NOT_REPRODUCED),
        (torus_point(0.35), NOT_REPRODUCED),
        (torus_point(xi=0.5), NOT_REPRODUCED),
        (torus_point(kind="period_doubling"), NOT_REPRODUCED),
        (torus_point(unstable_before=1.0), NOT_REPRODUCED),
    ],
)
def test_torus_route(point, verdict):
    """Cycle, torus and chaos in turn, and a torus bifurcation between cycle and torus."""
    made = results(routes=route_rows(*twice("cycle", "torus", "chaos")), cycle_points=[point])
    claim = {"routes": ["mine"], "expected": ["cycle", "torus", "chaos"]}
    found = TESTS["torus_route"](made, **claim)
    assert found.verdict == verdict
    known = "A pair of multipliers of a stable cycle leaves the unit circle at tau = "
    there = point["kind"] == "torus" and point["xi"] == 0.8 and not point["unstable_before"]
    assert (f"{known}{point['tau']}." in found.evidence) == there


BREAKDOWN, STRICT = ["cycle", "torus", "chaos"], ["torus", "3-torus", "chaos"]


@pytest.mark.parametrize(
    ("first", "second", "verdict", "words"),
    [
        (BREAKDOWN, STRICT, REPRODUCED, ""),
        (BREAKDOWN, ["torus", "chaos"], CORRECTED, "chaos), but not the third frequency"),
        (["cycle", *STRICT], ["chaos"], CORRECTED, "Newhouse, but not torus breakdown"),
        (["cycle", "chaos"], ["torus", "3-torus"], NOT_REPRODUCED, "show neither torus"),
    ],
)
def test_quasiperiodic_route(first, second, verdict, words):
    """Torus breakdown and a third frequency, one of them, or neither."""
    rows = route_rows(*twice(*first)) + route_rows(*twice(*second), name="other")
    made = results(routes=rows, cycle_points=[torus_point()])
    found = TESTS["quasiperiodic_route"](made, routes=["mine", "other"])
    assert found.verdict == verdict
    assert words in found.instead
    assert found.evidence.endswith("The atlas has no torus of three frequencies.")


def test_three_tori_of_the_atlas():
    """Where they are; what follows is the next class on the same line, undecided ones left out."""
    grid = {
        0.4: ["torus", "3-torus", UNDECIDED, "chaos"],
        0.5: ["torus", "3-torus", "torus", "chaos"],
        0.6: ["torus", "chaos", "chaos", "3-torus"],
    }
    rows = [
        attractor_row(met, epsilon=epsilon, tau=10.0 + i)
        for epsilon, classes in grid.items()
        for i, met in enumerate(classes)
    ]
    rows.append(attractor_row("chaos", epsilon=0.4, tau=11.5, xi=0.5))
    made = results(routes=route_rows(*twice("cycle")), atlas=rows)
    evidence = TESTS["quasiperiodic_route"](made, routes=["mine"]).evidence
    assert evidence.endswith(
        "The atlas has 3 tori of three frequencies: 3 at xi = 0.8, gamma = 0.8, for tau from 11 to"
        " 13. The next class is chaos beyond 1 of them with a longer delay, and beyond 2 with a"
        " larger epsilon."
    )


@pytest.mark.parametrize(
    ("l1", "points", "verdict"),
    [
        (-0.1, [torus_point()], REPRODUCED),
        (0.1, [torus_point()], NOT_REPRODUCED),
        (-0.1, [torus_point(criticality="subcritical")], NOT_REPRODUCED),
        (-0.1, [], NOT_REPRODUCED),
        (-0.1, [torus_point(), torus_point(epsilon=0.4)], REPRODUCED),
    ],
)
def test_two_supercritical_hopfs(l1, points, verdict):
    """That of steady sliding and all torus bifurcations of stable cycles on the line."""
    curves = changed(hopf_curve(xi=0.8), l1=l1)
    made = results(
        curves={"a": hopf_curve(), "b": curves},
        routes=route_rows(*twice("cycle", "torus")),
        cycle_points=points,
    )
    found = TESTS["two_supercritical_hopfs"](made, routes=["mine"], planes=["a", "b"])
    assert found.verdict == verdict


@pytest.mark.parametrize(
    ("in_epsilon", "in_xi", "verdict"),
    [
        (["cycle", "chaos"], ["chaos", "cycle"], REPRODUCED),
        (["cycle", "chaos"], ["cycle", "chaos"], CORRECTED),
        (["chaos", "cycle"], ["chaos", "cycle"], CORRECTED),
        (["chaos"], ["cycle", "chaos"], NOT_REPRODUCED),
    ],
)
def test_chaos_by_a_and_b(in_epsilon, in_xi, verdict):
    """B alone raises epsilon, A and B in proportion lower xi."""
    rows = route_rows(*twice(*in_epsilon), name="one", along="epsilon")
    rows += route_rows(*twice(*in_xi), name="two", along="xi")
    found = TESTS["chaos_by_a_and_b"](results(routes=rows), routes=["one", "two"])
    assert found.verdict == verdict


def test_route_without_rows_is_an_error():
    """It names table and route."""
    made = of_route("cycle", "cycle")
    with pytest.raises(ValueError, match=r"routes/other.tsv: no row of route 'other'.*: mine"):
        TESTS["route"](made, routes=["other"], expected=["cycle"])
