"""Verdicts on what delays do to the stability of scenes."""

import math

import pytest
from made_up_results import (
    NO,
    YES,
    Results,
    stability_row,
)

from scripts.claims.claims_results import changes
from scripts.studies.linear_stability.claims import amplitude_death, delay_destabilises


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
