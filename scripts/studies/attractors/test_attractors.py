"""Verdicts on where runs end, and on cycles at a scene, on made-up tables and lines."""

import math

import pytest
from made_up_results import NO, PARTLY, YES, Results, attractor_row, stability_row

from scripts.studies.attractors.claims import attractor_class, positive_exponent


def results_with_classes(*classes: str) -> Results:
    """Results of a scene whose histories end on these classes, its own first."""
    rows = [attractor_row(met, history=i + 1) for i, met in enumerate(classes)]
    return Results(attractors=rows[::-1], linear_stability=[stability_row()])


@pytest.mark.parametrize(
    ("classes", "verdict"),
    [
        (["cycle"], YES),
        (["cycle", "torus", "chaos"], YES),
        (["fixed point", "cycle"], PARTLY),
        (["fixed point", "fixed point"], NO),
        (["undecided"], NO),
    ],
)
def test_attractor_class(classes, verdict):
    """From the scene's own history, only from another, or from none."""
    found = attractor_class(results_with_classes(*classes), scene="mine", expected="cycle")
    assert found.verdict == verdict
    assert f"own history: {classes[0]} (exponents -0.01 +- 0.001, " in found.evidence
    assert f"Classes from {len(classes) - 1} other histories: " in found.evidence


@pytest.mark.parametrize(
    ("exponents", "verdict"),
    [([0.02, 0.018], YES), ([0.02, 0.002], NO), ([0.02, math.nan], NO), ([math.nan], NO)],
)
def test_positive_exponent(exponents, verdict):
    """By three standard errors, of 0.001 each, in every run."""
    rows = [
        attractor_row("chaos", history=i + 1, exponent_1=value) for i, value in enumerate(exponents)
    ]
    assert positive_exponent(Results(attractors=rows), scene="mine").verdict == verdict


def test_exponents_are_those_of_the_long_run():
    """In both claims, at the scene's own tolerance; that along the flow has no error."""
    long = [(0.019, 0.0007), (0.0, 0.0), (-0.0145, 0.001)]
    made = results_with_classes("chaos")
    made.exponents = [
        {"scene": scene, "exponent": value + off, "error": error, "mean_step": 0.1 + off}
        for scene, off in (("other", 0.2), ("mine", 0.0), ("mine", 0.3))
        for value, error in long
    ]
    found = attractor_class(made, scene="mine", expected="chaos")
    assert (
        "(exponents of its long run 0.019 +- 0.0007, 0 (along the flow), -0.0145 +- 0.001)"
        in found.evidence
    )
    found = positive_exponent(made, scene="mine")
    assert "of scene mine is 0.019 +- 0.0007 $v0/L$." in found.evidence


def test_scene_without_a_row_is_an_error():
    made = Results(attractors=[attractor_row("cycle", "other")])
    with pytest.raises(ValueError, match=r"attractors.tsv: no row of scene 'mine'.*: other"):
        positive_exponent(made, scene="mine")
