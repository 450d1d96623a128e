"""Attractors: what the namelists of surveys ask for, and what their tables say."""

import math
from pathlib import Path

import numpy as np
import pytest
from made_up_results import survey_run as a_run

from scripts.models.models import HISTORY, PARAMETERS
from scripts.requests.attractor_surveys import drawn_histories
from scripts.tables import attractor_tables
from scripts.tables.motion_rows import (
    count_in_words,
    kind_of,
    parameter_of,
)


def test_histories_fill_their_ranges():
    """Evenly in theta, u and ln v; another seed gives others, more begin with the same."""
    ranges = {"seed": 3, "theta": [-1.0, 0.0], "u": [5.0, 7.0], "ln_v": [-4.0, -2.0]}
    drawn = drawn_histories(2000, ranges, HISTORY)
    assert drawn[:5] == drawn_histories(5, ranges, HISTORY)
    assert drawn[:5] != drawn_histories(5, {**ranges, "seed": 4}, HISTORY)
    for key, values in (
        ("theta", [history["theta"] for history in drawn]),
        ("u", [history["u"] for history in drawn]),
        ("ln_v", [math.log(history["v"]) for history in drawn]),
    ):
        low, high = ranges[key]
        counts, _ = np.histogram(values, bins=4, range=(low, high))
        assert counts.sum() == 2000
        assert (abs(counts - 500) < 100).all()


def test_points_that_were_not_computed_have_class_and_period_only():
    run = a_run(["cycle", "cycle"], period=[3, 3], time=[900.0, math.nan])
    run["computed"] = ("point", [1, 0], {"flag_meanings": "no yes"})
    first, second = attractor_tables.atlas_rows(run)
    columns = list(first)
    assert list(second) == columns
    assert columns[columns.index("class") - 1] == "computed"
    assert (first["computed"], second["computed"]) == ("yes", "no")
    assert first["by_section"] == "cycle"
    empty = {key for key, value in second.items() if isinstance(value, float) and math.isnan(value)}
    there = {*PARAMETERS, "law", *HISTORY, "computed", "class", "period"}
    assert set(columns) - empty == there
    assert (second["class"], second["period"]) == ("cycle", 3.0)


def test_rows_say_what_the_file_holds():
    """Zeros that stand for nothing become empty, and there are none. Signs are counted as the file
    has them: unclear ones are not zero; of a run that failed nothing is counted."""
    run = a_run(["chaos", "undecided"], period=[3, 0], problem=["", "it stopped"])
    signs = [[1, 0, -1, 2, 2], [math.nan] * 5]
    run = run.drop_dims("exponent").assign(sign=(("point", "exponent"), signs))
    run["lyapunov_exponent"] = run["lyapunov_error"] = run.sign
    first, second = attractor_tables.rows_of(run)
    assert (first["class"], first["period"], first["f1"]) == ("chaos", 3.0, 0.1)
    assert (first["exponent_1"], first["exponent_2"]) == (1.0, 0.0)
    assert math.isnan(first["f2"])
    assert math.isnan(first["f3"])
    assert first["time"] == 900.0
    assert math.isnan(second["period"])
    for key, value in {"problem": "it stopped", "reason": "not confirmed"}.items():
        assert (first[key], second[key]) == ("", value)
    counts = [f"{word}_exponents" for word in ("positive", "zero", "unclear")]
    assert [first[key] for key in counts] == [1, 1, 2]
    assert all(math.isnan(second[key]) for key in counts)


@pytest.mark.parametrize(("fastest", "tame"), [(1.9, "yes"), (2.1, "no")])
def test_histories_slower_than_the_attractor_are_tame(fastest, tame):
    """All of them; a run that failed has no attractor."""
    run = a_run(
        ["cycle"] * 3,
        history_v=[1.0, fastest, 1.0],
        largest_maximum=[2.0, 2.0, math.nan],
        problem=["", "", "it stopped"],
    )
    rows = attractor_tables.scene_rows("mine", run)
    assert [row["tame_histories"] for row in rows] == [tame] * 3


@pytest.mark.parametrize(
    ("classes", "values", "numbers"),
    [
        (["cycle", "chaos", "cycle", "fixed point", "chaos"], {}, [1, 2, 1, 3, 2]),
        *(
            ([name, name], {key: [3.0, 3.0 * factor]}, numbers)
            for name in ("cycle", "torus", "3-torus")
            for factor, numbers in ((1.005, [1, 1]), (1.02, [1, 2]))
            for key in ("smallest_maximum", "largest_maximum")
        ),
        (["cycle", "cycle"], {"period": [1, 2]}, [1, 2]),
        (["torus", "torus"], {"period": [0, 2]}, [1, 1]),
        *(
            ([name, name], {"lyapunov_exponent": [0.1, 0.1 + apart], "lyapunov_error": 0.01}, found)
            for name in ("chaos", "undecided")
            for apart, found in ((0.041, [1, 1]), (0.044, [1, 2]))
        ),
        (["fixed point"] * 2, {"largest_maximum": [1, 2], "lyapunov_exponent": [-1, -2]}, [1, 1]),
    ],
)
def test_attractors_are_numbered_as_they_are_met(classes, values, numbers):
    """Cycles and tori differ by a hundredth of a maximum, cycles by their period as well, others by
    three error bars of the first exponent, sqrt(2) x 0.01 here; the block has one fixed point.
    """
    rows = attractor_tables.scene_rows("mine", a_run(classes, **values))
    assert [row["attractor"] for row in rows] == numbers
    assert [row["history"] for row in rows] == list(range(1, len(classes) + 1))


@pytest.mark.parametrize("along", ["tau", "epsilon", "xi", "gamma", "v"])
def test_parameter_of_a_route(along):
    """The value that varies within a run; runs differ in their histories."""
    rows = []
    for path, u in (("mine/near.nc", 0.0), ("mine/slip.nc", -5.0)):
        varied = {f"history_{along}" if along == "v" else along: [1.0, 2.0], "history_u": u}
        rows += attractor_tables.route_rows(Path(path), a_run(["cycle", "cycle"], **varied))
    assert parameter_of(rows) == along


def test_points_are_counted_and_cycles_parted():
    rows = [
        {"class": "cycle", "period": 1.0, "problem": math.nan},
        {"class": "cycle", "period": 2.0, "problem": math.nan},
        {"class": "torus", "period": math.nan, "problem": math.nan},
        {"class": "undecided", "period": math.nan, "problem": math.nan},
    ]
    assert [kind_of(row) for row in rows] == ["cycle", "multi-loop cycle", "torus", "undecided"]
    assert count_in_words(rows) == "4 points, 1 undecided"
    failed = {"class": "undecided", "period": math.nan, "problem": "it stopped"}
    assert count_in_words([*rows, failed]) == "5 points, 1 undecided, 1 failed"
    taken = rows[0] | {"computed": "no"}
    assert count_in_words([*rows, taken]) == "5 points, 4 computed, 1 undecided"
