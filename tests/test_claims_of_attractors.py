"""Verdicts on where runs end, on made-up tables of attractors."""

import math

import pytest
from made_up_results import NO, PARTLY, YES, Results, attractor_row, stability_row

from scripts.claims.claims_of_attractors import attractor_class, positive_exponent
from scripts.files.tsv import read_table

ATTRACTORS = """\
scene,history,theta,u,v,attractor,class,period,by_exponents,by_section,by_spectrum,exponent_1,\
error_1,exponent_2,error_2,exponent_3,error_3,f1,f2,smallest_maximum,largest_maximum
mine,2,0,0.1,1.5,1,cycle,2,cycle,cycle,undecided,1e-8,2e-8,-0.01,1e-6,-0.04,1e-6,0.0969,,2.1,2.3
mine,1,0,0,1.1,2,fixed point,,fixed point,fixed point,fixed point,,,,,,,,,1,1
"""


def of_classes(*classes: str) -> Results:
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
    found = attractor_class(of_classes(*classes), scene="mine", expected="cycle")
    assert found.verdict == verdict
    assert f"own history: {classes[0]} (exponents -0.01 +- 0.001, " in found.evidence
    assert f"Classes from {len(classes) - 1} other histories: " in found.evidence


def test_table_as_it_is_written(tmp_path):
    """Empty cells, histories in any order, a period."""
    path = tmp_path / "attractors.tsv"
    path.write_text(ATTRACTORS.replace(",", "\t"))
    made = Results(attractors=read_table(path), linear_stability=[stability_row()])
    found = attractor_class(made, scene="mine", expected="cycle")
    assert found.verdict == PARTLY
    assert "1 cycle with 2 loops" in found.evidence
    assert "nan" not in found.evidence


@pytest.mark.parametrize(
    ("exponents", "verdict", "beyond"),
    [
        ([0.02, 0.018], YES, 2),
        ([0.02, 0.002], NO, 1),
        ([-0.02, -0.01], NO, 0),
        ([0.02, math.nan], NO, 1),
    ],
)
def test_positive_exponent(exponents, verdict, beyond):
    """By three standard errors, of 0.001 each, in every run."""
    rows = [
        attractor_row("chaos", history=i + 1, exponent_1=value) for i, value in enumerate(exponents)
    ]
    found = positive_exponent(Results(attractors=rows), scene="mine")
    assert found.verdict == verdict
    assert f"above zero from {beyond} of {len(exponents)} histories" in found.evidence
    assert "nan" not in found.evidence


def test_exponents_are_those_of_the_long_run():
    """In both claims, at the scene's own tolerance; that along the flow has no error."""
    long = [(0.019, 0.0007), (0.0, 0.0), (-0.0145, 0.001)]
    made = of_classes("chaos")
    made.exponents = [
        {"scene": scene, "exponent": value + off, "error": error, "mean_step": 0.1 + off}
        for scene, off in (("other", 0.2), ("mine", 0.0), ("mine", 0.3))
        for value, error in long
    ]
    found = attractor_class(made, scene="mine", expected="chaos")
    assert "(exponents 0.019 +- 0.0007, 0 (along the flow), -0.0145 +- 0.001)" in found.evidence
    found = positive_exponent(made, scene="mine")
    assert "of scene mine is 0.019 +- 0.0007 $v0/L$." in found.evidence


def test_no_exponent_is_no_chaos():
    """Nothing is concluded from nothing."""
    made = Results(attractors=[attractor_row("undecided", exponent_1=math.nan)])
    assert positive_exponent(made, scene="mine").verdict == NO


def test_scene_without_a_row_is_an_error():
    """It names table and scene."""
    made = Results(attractors=[attractor_row("cycle", "other")])
    with pytest.raises(ValueError, match=r"attractors.tsv: no row of scene 'mine'.*: other"):
        positive_exponent(made, scene="mine")
