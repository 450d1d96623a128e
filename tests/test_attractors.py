"""Attractors: what the namelists of surveys ask for, and what their tables say."""

import copy
import math

import numpy as np
import pytest
import xarray as xr

from scripts.config.check_config import checked
from scripts.namelists import attractor_surveys
from scripts.tables import attractor_tables
from scripts.tables.motion_rows import count_in_words, first_met, kind_of

CLASSES = ["undecided", "fixed point", "cycle", "torus", "chaos"]


@pytest.fixture
def full(config) -> dict:
    """The whole config with its defaults."""
    return checked(config)


@pytest.mark.parametrize(
    ("count", "parts"), [(1, 1), (5, 2), (16, 4), (51, 17), (7, 7), (100, 3), (61, 8)]
)
def test_parts_hold_every_row_once(count, parts):
    """In order, and no part is larger than another by more than one."""
    ends = [attractor_surveys.part_of(count, parts, part) for part in range(1, parts + 1)]
    rows = [row for first, last in ends for row in range(first, last + 1)]
    assert rows == list(range(1, count + 1))
    sizes = [last - first + 1 for first, last in ends]
    assert max(sizes) - min(sizes) <= 1


@pytest.mark.parametrize("grid", ["coarse", "fine"])
def test_parts_of_the_atlas_cut_its_delays(full, grid):
    """All of epsilon in each part, both windows as a whole, at the xi of the plane."""
    settings = full["atlas"]["grids"][grid]
    rows = []
    for part in range(1, settings["parts"] + 1):
        points = attractor_surveys.atlas_groups(full, "xi_08", grid, part)["points"]
        assert points["epsilon_part"] == [1, settings["epsilon_count"]]
        assert points["epsilon_window"] == full["atlas"]["epsilon_window"]
        assert points["tau_window"] == full["atlas"]["tau_window"]
        assert (points["xi"], points["gamma"]) == (0.8, 0.8)
        rows += range(points["tau_part"][0], points["tau_part"][1] + 1)
    assert rows == list(range(1, settings["tau_count"] + 1))


def test_parts_of_the_route_cut_its_epsilons(full):
    """One delay, its own observation, and what spectra are asked for."""
    rows = []
    for part in range(1, full["route"]["parts"] + 1):
        groups = attractor_surveys.route_groups(full, part)
        points = groups["points"]
        assert (points["tau_window"], points["tau_count"]) == ([7.0, 7.0], 1)
        rows += range(points["epsilon_part"][0], points["epsilon_part"][1] + 1)
        assert groups["observation"].items() >= full["spectra"].items()
        assert "kept" not in groups["observation"]
        assert points["kept"] == full["route"]["observation"]["kept"]
    assert rows == list(range(1, full["route"]["epsilon_count"] + 1))


def test_histories_are_drawn_by_the_seed_and_the_own_one_is_first(full):
    """The same each time, more of them begin with the same, another seed gives others."""
    ranges = full["attractors"]["histories"]
    own = {"theta": 0.1, "u": 0.2, "v": 0.3}
    drawn = attractor_surveys.drawn_histories(own, 6, ranges)
    assert drawn[0] == own
    assert drawn == attractor_surveys.drawn_histories(own, 6, copy.deepcopy(ranges))
    assert drawn == attractor_surveys.drawn_histories(own, 9, ranges)[:6]
    other = attractor_surveys.drawn_histories(own, 6, {**ranges, "seed": ranges["seed"] + 1})
    assert other[0] == own
    assert all(one != another for one, another in zip(drawn[1:], other[1:], strict=True))


def test_histories_fill_their_ranges(full):
    """Evenly in theta, u and ln v."""
    ranges = {"seed": 3, "theta": [-1.0, 0.0], "u": [5.0, 7.0], "ln_v": [-4.0, -2.0]}
    drawn = attractor_surveys.drawn_histories({}, 2001, ranges)[1:]
    for key, values in (
        ("theta", [history["theta"] for history in drawn]),
        ("u", [history["u"] for history in drawn]),
        ("ln_v", [math.log(history["v"]) for history in drawn]),
    ):
        low, high = ranges[key]
        counts, _ = np.histogram(values, bins=4, range=(low, high))
        assert counts.sum() == 2000
        assert (abs(counts - 500) < 100).all()


def test_scene_asks_for_its_own_parameters_and_histories(full):
    """And for its own time of the approach."""
    groups = attractor_surveys.scene_groups(full, "true_torus")
    points, scene = groups["points"], full["scenes"]["true_torus"]
    assert (points["epsilon_window"], points["tau_window"]) == ([0.5, 0.5], [12.5, 12.5])
    assert len(points["theta"]) == len(points["u"]) == len(points["v"]) == 6
    assert points["v"][0] == scene["history"]["v"]
    assert groups["observation"]["t_transient"] == scene["t_transient"]


def a_run(classes: list[str], **given) -> xr.Dataset:
    """A file with one point for each class, other values of points as given."""
    size = len(classes)
    numbers = [CLASSES.index(name) for name in classes]
    meanings = " ".join(name.replace(" ", "_") for name in CLASSES)
    points = {
        **dict.fromkeys(("epsilon", "tau", "history_theta", "history_u", "history_v"), 1.0),
        **{"period": 1, "base_1": 0.1, "base_2": 0.0, "roughness": 0.5},
        **{"smallest_maximum": 1.0, "largest_maximum": 2.0},
        **given,
    }
    exponents = {key: points.pop(key, 0.0) for key in ("lyapunov_exponent", "lyapunov_error")}
    words = np.broadcast_to(points.pop("problem", " "), size)
    data = {key: ("point", np.broadcast_to(value, size)) for key, value in points.items()}
    for key in ("class", "by_exponents", "by_section", "by_spectrum"):
        data[key] = ("point", numbers, {"flag_meanings": meanings})
    for key, value in exponents.items():
        first = np.broadcast_to(value, size)
        data[key] = (("point", "exponent"), np.stack([first, first - 1], axis=1))
    data["problem"] = ("point", words.astype(object))
    return xr.Dataset(data, attrs={"xi": 0.5, "gamma": 0.8})


def attractors_in(run: xr.Dataset) -> list[int]:
    """Numbers of the attractors that its histories come to."""
    return [row["attractor"] for row in attractor_tables.scene_rows("mine", run)]


def test_rows_say_what_the_file_holds():
    """Zeros that stand for nothing become empty, blank problems too."""
    run = a_run(["cycle", "undecided"], period=[3, 0], problem=[" ", "it stopped"])
    first, second = attractor_tables.rows_of(run)
    assert (first["class"], first["period"], first["f1"]) == ("cycle", 3.0, 0.1)
    assert (first["exponent_1"], first["exponent_2"]) == (0.0, -1.0)
    assert math.isnan(first["f2"])
    assert math.isnan(second["period"])
    assert (first["problem"], second["problem"]) == ("", "it stopped")


def test_attractors_are_numbered_as_they_are_met():
    """Each history after the first is compared with all that were found."""
    run = a_run(["cycle", "chaos", "cycle", "fixed point", "chaos"])
    assert attractors_in(run) == [1, 2, 1, 3, 2]
    rows = attractor_tables.scene_rows("mine", run)
    assert [row["history"] for row in rows] == [1, 2, 3, 4, 5]


@pytest.mark.parametrize("name", ["cycle", "torus"])
@pytest.mark.parametrize(("factor", "numbers"), [(1.005, [1, 1]), (1.02, [1, 2])])
@pytest.mark.parametrize("key", ["smallest_maximum", "largest_maximum"])
def test_cycles_and_tori_are_told_apart_by_their_maxima(name, key, factor, numbers):
    """To a hundredth."""
    assert attractors_in(a_run([name, name], **{key: [3.0, 3.0 * factor]})) == numbers


def test_cycles_are_told_apart_by_their_period():
    """A torus has none."""
    assert attractors_in(a_run(["cycle", "cycle"], period=[1, 2])) == [1, 2]
    assert attractors_in(a_run(["torus", "torus"], period=[0, 2])) == [1, 1]


@pytest.mark.parametrize("name", ["chaos", "undecided"])
@pytest.mark.parametrize(("apart", "numbers"), [(0.041, [1, 1]), (0.044, [1, 2])])
def test_chaos_is_told_apart_by_its_first_exponent(name, apart, numbers):
    """Beyond three error bars of the difference, sqrt(2) x 0.01 here."""
    run = a_run([name, name], lyapunov_exponent=[0.1, 0.1 + apart], lyapunov_error=0.01)
    assert attractors_in(run) == numbers


def test_fixed_point_is_one():
    """The block has a single state of steady sliding."""
    run = a_run(["fixed point"] * 2, largest_maximum=[1.0, 2.0], lyapunov_exponent=[-1.0, -2.0])
    assert attractors_in(run) == [1, 1]


def test_classes_met_are_in_the_order_of_epsilon():
    """Each from its first point on; what is undecided is no class."""
    classes = ["undecided", "cycle", "torus", "undecided", "cycle", "chaos"]
    rows = [{"epsilon": 0.1 * i, "class": name} for i, name in enumerate(classes)]
    first = first_met(rows[::-1])
    assert list(first) == ["cycle", "torus", "chaos"]
    np.testing.assert_allclose(list(first.values()), [0.1, 0.2, 0.5])


def test_points_are_counted_and_cycles_parted():
    """Failures are named only where there are some."""
    rows = [
        {"class": "cycle", "period": 1.0, "problem": math.nan},
        {"class": "cycle", "period": 2.0, "problem": math.nan},
        {"class": "torus", "period": math.nan, "problem": math.nan},
        {"class": "undecided", "period": math.nan, "problem": math.nan},
    ]
    assert [kind_of(row) for row in rows] == ["cycle", "cycle of period > 1", "torus", "undecided"]
    assert count_in_words(rows) == "4 points, 1 undecided"
    failed = {"class": "undecided", "period": math.nan, "problem": "it stopped"}
    assert count_in_words([*rows, failed]) == "5 points, 1 undecided, 1 failed"
