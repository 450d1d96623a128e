"""Attractors: what the namelists of surveys ask for, and what their tables say."""

import copy
import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from scripts.namelists import attractor_surveys
from scripts.namelists.laws import PAPER
from scripts.namelists.parameters import HISTORY, PARAMETERS
from scripts.results import paths
from scripts.tables import attractor_tables, basins_table
from scripts.tables.motion_rows import count_in_words, kind_of, parameter_of

CLASSES = ["undecided", "fixed point", "cycle", "torus", "3-torus", "chaos"]


@pytest.fixture
def full(filled_config) -> dict:
    """The whole config with its defaults, to change."""
    return copy.deepcopy(filled_config)


@pytest.mark.parametrize(
    ("count", "parts", "distance"),
    [*((1, 1, 1), (16, 4, 1), (7, 7, 1), (61, 8, 1), (51, 7, 2), (9, 9, 16), (1000, 31, 16))],
)
def test_parts_hold_every_row_once(count, parts, distance):
    """All parts but the last end with a line that is computed first; sizes are nearly the same."""
    ends = [attractor_surveys.part_of(count, parts, part, distance) for part in range(1, parts + 1)]
    rows = [row for first, last in ends for row in range(first, last + 1)]
    assert rows == list(range(1, count + 1))
    assert all((last - first) % distance == 0 for first, last in ends[:-1])
    sizes = [last - first + 1 for first, last in ends]
    assert max(sizes) - min(sizes) <= (1 if distance == 1 else 2 * distance - 1)


def test_parts_of_the_atlas_divide_its_delays(full):
    """All of epsilon in each part, both windows as a whole, at xi and gamma of the plane."""
    settings = full["atlas"]
    delays = []
    for part in range(1, settings["parts"] + 1):
        points = attractor_surveys.atlas_groups(full, "fault", part)["points"]
        columns, lines = points["axes"]
        assert (columns["along"], lines["along"]) == ("epsilon", "tau")
        assert columns["part"] == [1, settings["epsilon_count"]]
        assert columns["window"] == settings["epsilon_window"]
        assert lines["window"] == settings["planes"]["fault"]["ordinate_window"]
        assert points["refinements"] == settings["refinements"]
        assert points["parameters"] == {"xi": 0.5, "gamma": 1e8, "law": PAPER}
        delays += range(lines["part"][0], lines["part"][1] + 1)
    assert delays == list(range(1, settings["ordinate_count"] + 1))


@pytest.mark.parametrize(("run", "sweep"), [("near", "none"), ("slip", "none"), ("up", "up")])
def test_runs_of_a_route_go_along_its_parameter(full, run, sweep):
    """Three values are fixed; sweeps start from the first history."""
    routes = full["routes"]
    groups = attractor_surveys.route_groups(full, "chaos_in_epsilon", run)
    points, line = groups["points"], routes["lines"]["chaos_in_epsilon"]
    assert points["sweep"] == sweep
    count = line["count"]
    axis = {"along": "epsilon", "window": line["window"], "count": count, "part": [1, count]}
    assert points["axes"] == [axis]
    assert points["parameters"]["tau"] == 7.0
    history = routes["histories"].get(run, routes["histories"]["near"])
    assert groups["histories"] == {key: [history[key]] for key in HISTORY}
    assert groups["observation"].items() >= full["spectra"].items()
    assert (points["refinements"], points["kept"]) == (0, routes["observation"]["kept"])


def test_route_along_a_value_of_the_history(full):
    """One set of parameters and a history for each value; there are no sweeps."""
    line = {"along": "v", "window": [0.5, 1.5], "count": 3, "tau": 7.0, "epsilon": 0.5}
    full["routes"]["lines"]["mine"] = line | {"xi": 0.5, "gamma": 0.8, "law": PAPER}
    groups = attractor_surveys.route_groups(full, "mine", "slip")
    points, histories = groups["points"], groups["histories"]
    assert histories["v"] == [0.5, 1.0, 1.5]
    assert histories["u"] == [full["routes"]["histories"]["slip"]["u"]] * 3
    assert "axes" not in points
    assert points["sweep"] == "none"
    names = [path.split("/")[-1] for path in paths.runs_of_route(full, "mine")]
    assert names == ["near.nc", "slip.nc"]


def test_histories_fill_their_ranges():
    """Evenly in theta, u and ln v; another seed gives others, more begin with the same."""
    ranges = {"seed": 3, "theta": [-1.0, 0.0], "u": [5.0, 7.0], "ln_v": [-4.0, -2.0]}
    drawn = attractor_surveys.drawn_histories(2000, ranges)
    assert drawn[:5] == attractor_surveys.drawn_histories(5, ranges)
    assert drawn[:5] != attractor_surveys.drawn_histories(5, {**ranges, "seed": 4})
    for key, values in (
        ("theta", [history["theta"] for history in drawn]),
        ("u", [history["u"] for history in drawn]),
        ("ln_v", [math.log(history["v"]) for history in drawn]),
    ):
        low, high = ranges[key]
        counts, _ = np.histogram(values, bins=4, range=(low, high))
        assert counts.sum() == 2000
        assert (abs(counts - 500) < 100).all()


def a_run(classes: list[str], **given) -> xr.Dataset:
    """A file with one point for each class, other values of points as given."""
    size = len(classes)
    numbers = [CLASSES.index(name) for name in classes]
    meanings = " ".join(name.replace(" ", "_") for name in CLASSES)
    points = {
        **dict.fromkeys([*PARAMETERS, *(f"history_{key}" for key in HISTORY)], 1.0),
        **{"period": 1, "base_1": 0.1, "base_2": 0.0, "base_3": 0.0},
        **{"roughness": 0.5, "time": 900.0, "smallest_maximum": 1.0, "largest_maximum": 2.0},
        **{"recurrence_time": 8.0, "recurrence_variation": 0.1},
        **given,
    }
    exponents = {key: points.pop(key, 0.0) for key in ("lyapunov_exponent", "lyapunov_error")}
    words = np.broadcast_to(points.pop("problem", ""), size)
    data = {key: ("point", np.broadcast_to(value, size)) for key, value in points.items()}
    for key in ("class", "by_exponents", "by_section", "by_spectrum"):
        data[key] = ("point", numbers, {"flag_meanings": meanings})
    reasons = [int(name == "undecided") for name in classes]
    data["reason"] = ("point", reasons, {"flag_meanings": "none not_confirmed"})
    for key, value in exponents.items():
        first = np.broadcast_to(value, size)
        data[key] = (("point", "exponent"), np.stack([first, first - 1], axis=1))
    data["sign"] = (("point", "exponent"), np.sign(data["lyapunov_exponent"][1]))
    data["problem"] = ("point", words.astype(object))
    return xr.Dataset(data)


@pytest.mark.parametrize(
    ("columns", "lines", "refinements"),
    [(9, 7, 0), (1, 40, 0), (12, 40, 0), (13, 40, 1), (37, 25, 2), (200, 200, 2)],
)
def test_first_lines_of_a_small_atlas_are_not_too_far_apart(full, columns, lines, refinements):
    """At least six distances in each direction, and never more refinements than asked for."""
    full["atlas"] |= {"epsilon_count": columns, "tau_count": lines, "parts": 1, "refinements": 2}
    points = attractor_surveys.atlas_groups(full, "fault", 1)["points"]
    assert points["refinements"] == refinements


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
    """Zeros that stand for nothing become empty, and there are none."""
    run = a_run(["cycle", "undecided"], period=[3, 0], problem=["", "it stopped"])
    first, second = attractor_tables.rows_of(run)
    assert (first["class"], first["period"], first["f1"]) == ("cycle", 3.0, 0.1)
    assert (first["exponent_1"], first["exponent_2"]) == (0.0, -1.0)
    assert math.isnan(first["f2"])
    assert math.isnan(first["f3"])
    assert (first["reason"], second["reason"]) == ("", "not confirmed")
    assert first["time"] == 900.0
    assert math.isnan(second["period"])
    assert (first["problem"], second["problem"]) == ("", "it stopped")


def test_signs_are_counted_as_the_file_has_them():
    """Two are unclear, which are not zero; of a run that failed nothing is counted."""
    run = a_run(["chaos", "undecided"])
    signs = [[1, 0, -1, 2, 2], [math.nan] * 5]
    run = run.drop_dims("exponent").assign(sign=(("point", "exponent"), signs))
    run["lyapunov_exponent"] = run["lyapunov_error"] = run.sign
    first, second = attractor_tables.rows_of(run)
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


def test_shares_of_basins_have_standard_errors():
    """The most frequent motion first; a failed run belongs to none and counts as a history."""
    classes = ["cycle", "chaos", "cycle", "undecided", "cycle"]
    run = a_run(classes, problem=["", "", "", "it stopped", ""])
    first, second = basins_table.basin_rows("mine", run, [])
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
    found = basins_table.basin_rows("place", run, [{**row, "problem": math.nan} for row in rows])
    assert [(row["class"], row["period"], row["share"], row["shown_by"]) for row in found[:2]] == [
        ("cycle", 1.0, 1.0, "histories"),
        ("cycle", 3.0, 0.0, "mine up"),
    ]
    assert [row["class"] for row in found[2:]] == ["chaos"]
    assert found[2]["share_error"] == 0.0


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
