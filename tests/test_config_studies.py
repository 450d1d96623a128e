"""Checking what a configuration says about stability and work against precision."""

import pytest
from config_refusals import line_about, out_of_range, put, refusal

from scripts.config.check_config import checked

FAMILY = ("stability", "families", "growth")
SCENE = ("work_precision", "scenes", "torus")
RANGES = {
    ("stability", "tolerance"): ("[1e-13, 1e-2]", [0.0, 9.9e-14, 1.01e-2, "1e-9", None]),
    ("stability", "repeats"): ("a whole number >= 1", [0, 2.5, 101]),
    ("stability", "least_seconds"): ("[0, 10]", [-0.1, 10.1]),
    ("stability", "reference", "tolerance"): ("[1e-22, 1e-16]", [9e-23, 1.1e-16]),
    ("stability", "reference", "check_tolerance"): ("[1e-21, 1e-14]", [9e-22, 1.1e-14]),
    ("stability", "reference", "disturbance"): ("[1e-18, 1e-12]", [9e-19, 1.1e-12]),
    ("stability", "reference", "method"): ("one of: auto, explicit", ["radau", None]),
    (*FAMILY, "t_end"): ("> 0", [0.0, -1.0]),
    (*FAMILY, "samples"): ("a whole number >= 1", [0, 1.5, 10001]),
    (*FAMILY, "most_steps"): ("a whole number >= 1", [0, 100000001]),
    (*FAMILY, "reference"): ("quadruple", ["double", None]),
    (*FAMILY, "tau"): ("at least one finite number >= 0", [[], 1.0, [1.0, 1.0]]),
    (*FAMILY, "epsilon"): ("at least one finite number > -1", [[], 1.0]),
    (*FAMILY, "xi"): ("at least one finite number > 0", [[], 1.0]),
    (*FAMILY, "gamma"): ("at least one finite number > 0", [[], 1.0]),
    (*FAMILY, "theta"): ("at least one finite number", [[], 1.0]),
    (*FAMILY, "u"): ("at least one finite number", [[], 1.0]),
    (*FAMILY, "v"): ("at least one finite number > 0", [[], 1.0]),
    ("work_precision", "most_steps"): ("a whole number >= 1", [0, 1.5]),
    ("work_precision", "repeats"): ("a whole number >= 1", [0, 101]),
    ("work_precision", "least_seconds"): ("[0, 10]", [-0.1, 10.1]),
    ("work_precision", "trusted_error"): ("(0, 1e-3]", [0.0, 1.1e-3]),
    ("work_precision", "reference", "tolerance"): ("[1e-22, 1e-16]", [9e-23, 1.1e-16]),
    ("work_precision", "methods"): ("rk4_cubic", [[], ["auto", "auto"], "auto"]),
    ("work_precision", "tolerances"): ("[1e-13, 1e-2]", [[], [1e-3, 1e-3]]),
    ("work_precision", "steps"): ("> 0", [[], 0.1]),
    (*SCENE, "tau"): (">= 0", [-1.0]),
    (*SCENE, "epsilon"): ("> -1", [-1.0]),
    (*SCENE, "xi"): ("> 0", [0.0]),
    (*SCENE, "gamma"): ("> 0", [0.0]),
    (*SCENE, "v"): ("> 0", [0.0]),
    (*SCENE, "t_end"): ("> 0", [0.0]),
    (*SCENE, "sample_interval"): ("> 0", [0.0]),
}
"""For each value: words of its range, and values out of range."""
ELEMENTS = {
    (*FAMILY, "tau"): (">= 0", [-1.0, "much", None]),
    (*FAMILY, "epsilon"): ("> -1", [-1.0]),
    (*FAMILY, "xi"): ("> 0", [0.0]),
    (*FAMILY, "gamma"): ("> 0", [0.0, float("inf")]),
    (*FAMILY, "u"): ("a finite number", [float("nan")]),
    (*FAMILY, "v"): ("> 0", [0.0]),
    ("stability", "methods"): ("one of: auto, explicit", ["rk4_cubic"]),
    ("work_precision", "methods"): ("one of: explicit", ["euler"]),
    ("work_precision", "tolerances"): ("[1e-13, 1e-2]", [9e-14, 0.1]),
    ("work_precision", "steps"): ("> 0", [0.0]),
}
"""The same for elements of lists."""


@pytest.mark.parametrize(("path", "value", "words"), out_of_range(RANGES))
def test_value_out_of_range_is_refused(config, path, value, words):
    """The line names section, key, value and range."""
    checked(config)
    put(config, path, value)
    line = line_about(refusal(config), path[-1])
    assert line.startswith(f"config {' '.join(path[:-1])}: ")
    assert f"{path[-1]} = {value!r}; expected " in line
    assert words in line


@pytest.mark.parametrize(("path", "value", "words"), out_of_range(ELEMENTS))
def test_element_out_of_range_is_refused(config, path, value, words):
    """The line names list, place, value and range."""
    checked(config)
    put(config, path, [value])
    line = line_about(refusal(config), "0")
    assert line.startswith(f"config {' '.join(path)}: 0 = {value!r}; expected ")
    assert words in line


@pytest.mark.parametrize("path", [("stability",), FAMILY, ("work_precision",), SCENE])
def test_unknown_key_is_refused(config, path):
    """The line names section and key."""
    put(config, (*path, "colour"), 1)
    assert f"config {' '.join(path)}: unknown key ['colour']" in refusal(config)


@pytest.mark.parametrize(
    "path",
    [
        ("stability",),
        ("work_precision",),
        ("stability", "families"),
        ("work_precision", "scenes"),
        *((*place, key) for place in (FAMILY, SCENE) for key in ("tau", "xi", "t_end")),
    ],
)
def test_missing_key_is_refused(config, path):
    """The line names section and key."""
    section = config
    for key in path[:-1]:
        section = section[key]
    del section[path[-1]]
    assert f"{' '.join(['config', *path[:-1]])}: key ['{path[-1]}'] is missing" in refusal(config)


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


def test_samples_farther_apart_than_the_run_is_long_are_refused(config):
    """The range names t_end."""
    put(config, (*SCENE, "sample_interval"), 2000.0)
    line = line_about(refusal(config), "sample_interval")
    assert line.startswith("config work_precision scenes torus: sample_interval = 2000.0; ")
    assert line.endswith("<= t_end = 1000.0")
