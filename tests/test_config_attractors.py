"""Checking what a configuration says about attractors, the atlas and the route to chaos."""

import pytest
from config_refusals import line_about, place_of, put, refusal

from scripts.config.check_attractors import FEWEST_SAMPLES
from scripts.config.check_config import checked

OF_SCENES = ("attractors", "observation")
COARSE = ("atlas", "grids", "coarse")
OBSERVATIONS = [OF_SCENES, (*COARSE, "observation"), ("route", "observation")]


@pytest.mark.parametrize("name", ["Xi", "a b", "", 5])
def test_plane_whose_name_makes_no_file_name_is_refused(config, name):
    """As of a scene."""
    config["atlas"]["planes"][name] = {"xi": 1.0}
    assert f"config atlas planes: name {name!r}; expected " in refusal(config)


def test_atlas_without_planes_is_refused(config):
    """There would be nothing to draw."""
    config["atlas"]["planes"] = {}
    assert "planes = {}; expected " in refusal(config)


@pytest.mark.parametrize(("path", "key"), [(COARSE, "tau_count"), (("route",), "epsilon_count")])
def test_more_parts_than_places_are_refused(config, path, key):
    """Of the side that is cut; as many are fine."""
    put(config, (*path, key), 3)
    put(config, (*path, "parts"), 3)
    checked(config)
    put(config, (*path, "parts"), 4)
    line = line_about(refusal(config), "parts")
    assert line.startswith(
        f"{place_of(path)}: parts = 4; expected a whole number >= 1 and <= {key} = 3"
    )


def test_part_of_too_many_points_is_refused(config):
    """Ten rows of 100000 in a part are as many as may be."""
    put(config, (*COARSE, "epsilon_count"), 100000)
    put(config, (*COARSE, "tau_count"), 80)
    put(config, (*COARSE, "parts"), 8)
    checked(config)
    put(config, (*COARSE, "parts"), 7)
    assert "coarse: parts = 7 of 1200000 points; expected at most 1000000" in refusal(config)


@pytest.mark.parametrize("path", OBSERVATIONS)
def test_samples_farther_apart_than_the_observation_is_long_are_refused(config, path):
    """The range names t_observed."""
    put(config, (*path, "t_observed"), 100.0)
    put(config, (*path, "sample_interval"), 100.1)
    line = line_about(refusal(config), "sample_interval")
    assert line.startswith(f"{place_of(path)}: sample_interval = 100.1; expected ")
    assert line.endswith("<= t_observed = 100.0")


@pytest.mark.parametrize("path", OBSERVATIONS)
def test_too_few_and_too_many_samples_are_refused(config, path):
    """Eight segments that overlap by half are as long as four and a half."""
    put(config, (*path, "t_observed"), 100.0)
    put(config, (*path, "sample_interval"), 100.0 / (4.5 * FEWEST_SAMPLES))
    checked(config)
    put(config, (*path, "sample_interval"), 100.0 / (4.5 * FEWEST_SAMPLES - 2))
    assert f"at least {FEWEST_SAMPLES} samples" in line_about(refusal(config), "sample_interval")
    put(config, (*path, "sample_interval"), 1e-7)
    assert "at most 100000000 samples" in line_about(refusal(config), "sample_interval")
    put(config, (*path, "sample_interval"), 1e-310)
    assert "at most 100000000 samples" in line_about(refusal(config), "sample_interval")


def test_approach_of_scenes_beside_their_own_is_refused(config):
    """There would be two of them."""
    config["attractors"]["observation"]["t_transient"] = 100.0
    line = line_about(refusal(config), "t_transient")
    assert line.startswith("config attractors observation: t_transient = 100.0; expected none")


def test_scene_without_approach_has_no_attractors(config):
    """Without the key it may do without."""
    config["scenes"]["chaos"]["t_transient"] = 0.0
    line = line_about(refusal(config), "t_transient")
    assert line.startswith("scene 'chaos': t_transient = 0.0; expected a finite number > 0")
    del config["scenes"]["chaos"]["attractors"]
    checked(config)
