"""Checking what a configuration says about attractors, the atlas, routes and basins."""

import pytest
from config_refusals import line_about, place_of, put, refusal

from scripts.config.check_attractors import FEWEST_SAMPLES
from scripts.config.check_config import checked

SURVEYS = ("attractors", "atlas", "routes", "basins")
LINE = ("routes", "lines", "chaos_in_tau")


@pytest.mark.parametrize("name", ["Xi", "a b", "", 5])
def test_plane_whose_name_makes_no_file_name_is_refused(config, name):
    """As of a scene."""
    config["atlas"]["planes"][name] = {"xi": 1.0, "gamma": 1.0, "tau_window": [0.0, 1.0]}
    assert f"config atlas planes: name {name!r}; expected " in refusal(config)


@pytest.mark.parametrize(
    "path", [("routes", "lines"), ("routes", "histories"), ("basins", "places")]
)
@pytest.mark.parametrize("name", ["Xi", 5])
def test_other_names_that_make_no_file_name_are_refused(config, path, name):
    """Of lines, histories and places."""
    section = config[path[0]][path[1]]
    section[name] = next(iter(section.values()))
    assert f"{place_of(path)}: name {name!r}; expected " in refusal(config)


def test_history_with_the_name_of_a_sweep_is_refused(config):
    """Both would be the same file."""
    config["routes"]["histories"]["up"] = {}
    assert "config routes histories: name 'up'; expected another" in refusal(config)


def test_routes_without_histories_are_refused(config):
    """Sweeps would have no start."""
    config["routes"]["histories"] = {}
    assert "config routes: histories = {}; expected histories" in refusal(config)


def test_routes_without_sweeps_are_allowed(config):
    """Fixed histories alone."""
    config["routes"]["sweeps"] = []
    checked(config)


@pytest.mark.parametrize("along", ["tau", "epsilon", "xi", "gamma"])
def test_line_along_any_parameter(config, along):
    """It has the values of the three others; one of them missing is said."""
    values = {"tau": 7.0, "epsilon": 0.5, "xi": 0.5, "gamma": 0.8}
    fixed = {key: value for key, value in values.items() if key != along}
    line = {"along": along, "window": [0.1, 0.2], "count": 3}
    config["routes"]["lines"]["mine"] = {**line, **fixed}
    checked(config)
    fixed.popitem()
    config["routes"]["lines"]["mine"] = {**line, **fixed}
    (missing,) = set(values) - set(fixed) - {along}
    assert f"config routes lines mine: key ['{missing}'] is missing" in refusal(config)


def test_line_along_a_value_of_the_history(config):
    """It has all four parameters; v is positive."""
    line = {"along": "v", "window": [0.1, 0.2], "count": 3, "tau": 7.0, "epsilon": 0.5, "xi": 0.5}
    config["routes"]["lines"]["mine"] = line
    assert "config routes lines mine: key ['gamma'] is missing" in refusal(config)
    line |= {"gamma": 0.8, "window": [0.0, 0.2]}
    assert "config routes lines mine: window = [0.0, 0.2]; expected" in refusal(config)
    line["window"] = [0.1, 0.2]
    checked(config)


def test_value_of_the_parameter_that_varies_is_refused(config):
    """It would be without effect."""
    put(config, (*LINE, "tau"), 7.0)
    line = line_about(refusal(config), "tau")
    assert line == "config routes lines chaos_in_tau: tau = 7.0; expected no value, it is along tau"


@pytest.mark.parametrize(
    ("along", "window"),
    [("tau", [-0.1, 1.0]), ("epsilon", [-1.0, 1.0]), ("xi", [0.0, 1.0]), ("gamma", [0.0, 1.0])],
)
def test_line_beyond_the_range_of_its_parameter_is_refused(config, along, window):
    """The line names the window and the bound."""
    values = {"tau": 7.0, "epsilon": 0.5, "xi": 0.5, "gamma": 0.8} | {"window": window}
    del values[along]
    config["routes"]["lines"]["mine"] = {"along": along, "count": 3, **values}
    assert line_about(refusal(config), "window").startswith(
        f"config routes lines mine: window = {window}; expected two ascending numbers >"
    )


def test_former_section_names_the_new_one(config):
    """The single route is a line of `routes` now."""
    config["route"] = {}
    assert "unknown key ['route']; allowed: " in refusal(config)
    assert "(is it meant to be 'routes'?)" in refusal(config)


@pytest.mark.parametrize(
    ("section", "key"), [("atlas", "planes"), ("routes", "lines"), ("cycles", "lines")]
)
def test_nothing_to_draw_is_refused(config, section, key):
    """The line names the key."""
    config[section][key] = {}
    (line,) = refusal(config).splitlines()[1:]
    assert line.startswith(f"config {section}: {key} = {{}}; expected {key}, by name")


def test_more_parts_than_delays_are_refused(config):
    """Each part has a delay at least."""
    config["atlas"] |= {"tau_count": 3, "parts": 3}
    checked(config)
    config["atlas"]["parts"] = 4
    line = line_about(refusal(config), "parts")
    assert line == "config atlas: parts = 4; expected a whole number >= 1 and <= tau_count = 3"


@pytest.mark.parametrize("count", ["epsilon_count", "tau_count"])
def test_refinements_of_one_line_are_refused(config, count):
    """There are no cells to refine."""
    config["atlas"] |= {"parts": 1, "refinements": 1, count: 1}
    line = line_about(refusal(config), "refinements")
    assert line.startswith("config atlas: refinements = 1; expected 0 for one line, ")
    config["atlas"]["refinements"] = 0
    checked(config)


def test_part_of_too_many_points_is_refused(config):
    """Ten rows of 100000 in a part are as many as may be."""
    config["atlas"] |= {"epsilon_count": 100000, "tau_count": 80, "parts": 8, "refinements": 0}
    checked(config)
    config["atlas"]["parts"] = 7
    assert "config atlas: parts = 7 of 1200000 points; expected at most 1000000" in refusal(config)


@pytest.mark.parametrize("section", SURVEYS)
def test_samples_farther_apart_than_the_observation_is_long_are_refused(config, section):
    """The range names t_observed."""
    given = {"kept": 10, "t_observed": 100.0, "sample_interval": 100.1}
    config[section]["observation"] = given
    line = line_about(refusal(config), "sample_interval")
    assert line.startswith(f"config {section} observation: sample_interval = 100.1; expected ")
    assert line.endswith("<= t_observed = 100.0")


@pytest.mark.parametrize("section", SURVEYS)
def test_too_few_and_too_many_samples_are_refused(config, section):
    """Eight segments that overlap by half are as long as four and a half."""
    given = {"kept": 10, "t_observed": 100.0, "sample_interval": 100.0 / (4.5 * FEWEST_SAMPLES)}
    config[section]["observation"] = given
    checked(config)
    given["sample_interval"] = 100.0 / (4.5 * FEWEST_SAMPLES - 2)
    assert f"at least {FEWEST_SAMPLES} samples" in line_about(refusal(config), "sample_interval")
    for shortest in (1e-7, 1e-310):
        given["sample_interval"] = shortest
        assert "at most 100000000 samples" in line_about(refusal(config), "sample_interval")
