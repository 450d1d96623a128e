"""Shares of random histories."""

import math
from pathlib import Path

import pytest
from made_up_results import survey_run as a_run

from scripts.studies.basins.table import basin_rows
from scripts.tables import attractor_tables


def test_shares_of_basins_have_standard_errors():
    """The most frequent motion first; a failed run belongs to none and counts as a history."""
    classes = ["cycle", "chaos", "cycle", "undecided", "cycle"]
    run = a_run(classes, problem=["", "", "", "it stopped", ""])
    first, second = basin_rows("mine", run, [])
    assert (first["motion"], first["class"], first["histories"]) == (1, "cycle", 5)
    assert (first["share"], second["share"]) == (0.6, 0.2)
    assert first["share_error"] == pytest.approx(math.sqrt(0.6 * 0.4 / 5))
    assert (second["class"], second["tau"]) == ("chaos", 1.0)


def test_motions_that_only_a_route_shows_have_no_share():
    """At the same parameters, each once; undecided points and known motions are none."""
    run = a_run(["cycle", "cycle"])
    other = a_run(
        ["cycle", "cycle", "chaos", "chaos", "undecided", "fixed point"],
        tau=[1.0] * 5 + [2.0],
        period=[1, 3, 0, 0, 0, 0],
    )
    rows = attractor_tables.route_rows(Path("results/mine/up.nc"), other)
    found = basin_rows("place", run, [{**row, "problem": math.nan} for row in rows])
    assert [(row["class"], row["period"], row["share"], row["shown_by"]) for row in found[:2]] == [
        ("cycle", 1.0, 1.0, "histories"),
        ("cycle", 3.0, 0.0, "mine up"),
    ]
    assert [row["class"] for row in found[2:]] == ["chaos"]
    assert found[2]["share_error"] == 0.0
