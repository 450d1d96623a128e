"""Verdicts on where runs end, on made-up tables."""

import math

import pytest
from made_up_results import (
    NO,
    PARTLY,
    YES,
    assert_finding,
    attractor_row,
    cases,
    finding,
    stability_row,
)

SCENE = {"scene": "mine"}
LONG = [(0.019, 0.0007), (0.0, 0.0), (-0.0145, 0.001)]
"""Exponents of the long run with their errors: that along the flow has none."""


def ending_on(*classes: str, long_run: bool = False, **given: str) -> dict:
    """Results of a scene whose histories end on these classes, its own first, last in the table."""
    rows = [attractor_row(met, history=i + 1, **given) for i, met in enumerate(classes)]
    exponents = [
        {"scene": scene, "exponent": value + off, "error": error, "mean_step": 0.1 + off}
        for scene, off in (("other", 0.2), ("mine", 0.0), ("mine", 0.3))
        for value, error in LONG
    ]
    made = {"attractors": rows[::-1], "linear_stability": [stability_row()]}
    return made | ({"exponents": exponents} if long_run else {})


def measuring(*values: float) -> dict:
    """Results of a scene with these largest exponents, whose error is 0.001."""
    rows = [attractor_row("chaos", history=i + 1, exponent_1=v) for i, v in enumerate(values)]
    return {"attractors": rows}


@cases(
    (
        # from the scene's own history, only from another, or from none
        *("attractor_class", SCENE | {"expected": "cycle"}),
        (ending_on("cycle"), YES, "own history: cycle (exponents -0.01 +- 0.001, "),
        (ending_on("cycle", "torus", "chaos"), YES, "Classes from 2 other histories: 1 chaos, 1"),
        (ending_on("fixed point", "cycle"), PARTLY, "own history: fixed point (exponents -0.01"),
        (ending_on("fixed point", "fixed point"), NO),
        (ending_on("undecided"), NO, "Classes from 0 other histories: none."),
        # the spectrum is not needed where the section confirms the class
        (ending_on("cycle"), YES, "Class by the spectrum: cycle."),
        (ending_on("cycle", by_spectrum="undecided"), YES, "Class by the spectrum: not needed."),
        (
            *(ending_on("cycle", by_spectrum="undecided", by_section="torus"), YES),
            "Class by the section: torus. Class by the spectrum: undecided.",
        ),
    ),
    (
        # the exponents are those of the long run, at the scene's own tolerance
        *("attractor_class", SCENE | {"expected": "chaos"}),
        (
            *(ending_on("chaos", long_run=True), YES),
            "(exponents of its long run 0.019 +- 0.0007, 0 (along the flow), -0.0145 +- 0.001)",
        ),
    ),
    (
        # by three standard errors in every run
        *("positive_exponent", SCENE),
        *((measuring(0.02, 0.018), YES), (measuring(0.02, 0.002), NO)),
        *((measuring(0.02, math.nan), NO), (measuring(math.nan), NO, "of scene mine is measured.")),
        (ending_on("chaos", long_run=True), NO, "of scene mine is 0.019 +- 0.0007 $v0/L$."),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


def test_scene_without_a_row_is_an_error():
    with pytest.raises(ValueError, match=r"no results of scene 'mine'.*: other"):
        finding("positive_exponent", {"attractors": [attractor_row("cycle", "other")]}, **SCENE)
