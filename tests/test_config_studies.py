"""Checking what a configuration says about stability and work against precision."""

import pytest
from config_refusals import line_about, put, refusal

from scripts.config.check_config import checked
from scripts.namelists.study_cases import case_of, measured_study

FAMILY = ("stability", "families", "growth")
CASE = ("work_precision", "cases", "stick")


def test_scenes_of_the_paper_are_measured_as_they_are(config):
    """With the parameters and the history of the scene, whatever these are."""
    config["scenes"]["torus"] |= {"epsilon": 0.4, "history": {"v": 1.3}}
    cases = measured_study(checked(config))["cases"]
    assert list(cases) == ["fixed_point", "oscillation", "torus", "chaos", "stick", "stiff"]
    measured = case_of("torus", cases["torus"])
    assert (measured["tau"], measured["epsilon"], measured["v"]) == (10.0, 0.4, 1.3)
    assert measured["t_end"] == 1000.0


def test_measured_scene_that_is_none_is_refused(config):
    """The line names the scenes and the way out."""
    config["work_precision"]["scenes"]["mine"] = {"t_end": 1.0}
    (line,) = [line for line in refusal(config).splitlines() if "'mine'" in line]
    assert line.startswith("config work_precision scenes: 'mine'; expected one of: fixed_point, ")


def test_measured_case_with_the_name_of_a_scene_is_refused(config):
    """One name is one thing."""
    config["work_precision"]["cases"]["chaos"] = dict(config["work_precision"]["cases"]["stick"])
    (line,) = [line for line in refusal(config).splitlines() if "'chaos'" in line]
    assert line.startswith("config work_precision cases: 'chaos'; expected a name that no scene ")


@pytest.mark.parametrize("place", [FAMILY[:2], CASE[:2]])
@pytest.mark.parametrize("name", ["Torus", "a b", "", 5])
def test_name_that_makes_no_file_name_is_refused(config, place, name):
    """Of a family and of a scene."""
    section = config[place[0]][place[1]]
    section[name] = dict(next(iter(section.values())))
    assert f"config {' '.join(place)}: name {name!r}; expected " in refusal(config)


@pytest.mark.parametrize("study", ["stability", "work_precision"])
def test_check_no_looser_than_the_reference_is_refused(config, study):
    """It would say nothing."""
    config[study]["reference"] = {"tolerance": 1e-17, "check_tolerance": 1e-17}
    line = line_about(refusal(config), "check_tolerance")
    assert line.startswith(f"config {study} reference: check_tolerance = 1e-17; expected ")
    assert line.endswith("> tolerance = 1e-17")


def test_too_many_combinations_are_refused(config):
    """More than a namelist holds."""
    put(config, (*FAMILY, "tau"), [float(i) for i in range(501)])
    assert "families growth: 1002 combinations; expected at most 1000" in refusal(config)


def test_endless_combinations_are_refused(config):
    """They are counted, not made."""
    for key in ("tau", "xi", "gamma", "theta", "u", "v"):
        put(config, (*FAMILY, key), [float(i) for i in range(1, 1001)])
    put(config, (*FAMILY, "epsilon"), [0.5])
    assert f"{10**18} combinations; expected at most 1000" in refusal(config)


def test_case_name_too_long_is_refused(config):
    """It would be cut."""
    families = config["stability"]["families"]
    families["abcdefghij" * 6] = families.pop("growth")
    assert "gamma=10000' of 72 letters; expected at most 64" in refusal(config)


def test_stationary_reference_of_a_short_run_is_refused(config):
    """It has not decayed by then."""
    put(config, (*FAMILY, "reference"), "stationary")
    line = line_about(refusal(config), "t_end")
    assert "families growth: t_end = 400.0; expected " in line
