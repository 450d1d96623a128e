"""Checking what a configuration says about stability and work against precision."""

import pytest
from config_refusals import line_about, put, refusal

FAMILY = ("stability", "families", "growth")
SCENE = ("work_precision", "scenes", "torus")


def test_scenes_of_the_paper_are_measured_as_they_are(default_config):
    """Scenes of one name have the same parameters in both sections."""
    measured, scenes = default_config["work_precision"]["scenes"], default_config["scenes"]
    both = measured.keys() & scenes.keys()
    assert both >= {"fixed_point", "oscillation", "torus", "chaos"}
    for name in both:
        for key in ("tau", "epsilon", "xi", "gamma"):
            assert measured[name][key] == scenes[name][key]


@pytest.mark.parametrize("place", [FAMILY[:2], SCENE[:2]])
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


def test_case_name_too_long_is_refused(config):
    """It would be cut."""
    families = config["stability"]["families"]
    families["a" * 60] = families.pop("growth")
    assert "gamma=10000' of 72 letters; expected at most 64" in refusal(config)


def test_stationary_reference_of_a_short_run_is_refused(config):
    """It has not decayed by then."""
    put(config, (*FAMILY, "reference"), "stationary")
    line = line_about(refusal(config), "t_end")
    assert "families growth: t_end = 400.0; expected " in line
