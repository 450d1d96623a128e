"""Checking what a configuration says about attractors, the atlas and the route to chaos."""

import pytest
from config_refusals import NO_NUMBERS, line_about, out_of_range, put, refusal

from scripts.config.check_attractors import FEWEST_SAMPLES
from scripts.config.check_config import checked

OF_SCENES = ("attractors", "observation")
COARSE = ("atlas", "grids", "coarse")
OBSERVATIONS = [OF_SCENES, (*COARSE, "observation"), ("route", "observation")]
OBSERVED = {
    "t_transient": ("> 0", [0.0, -1.0]),
    "t_observed": ("> 0", [0.0, -1.0]),
    "t_turning": (">= 0", [-1.0]),
    "interval": ("> 0", [0.0]),
    "blocks": ("a whole number >= 2", [1, 2.5, 1001]),
    "exponents": ("a whole number >= 1", [0, 1.5, 65]),
    "zero_level": (">= 0", [-1e-9]),
    "longest_bar": ("> 0", [0.0]),
    "doublings": ("a whole number >= 0", [-1, 0.5, 11]),
    "sample_interval": ("> 0", [0.0]),
    "tolerance": ("[1e-13, 1e-2]", [0.0, 9.9e-14, 1.01e-2]),
    "method": ("one of: auto, explicit", ["radau", None]),
    "most_steps": ("a whole number >= 1", [0, 1.5, 1000000001]),
    "kept": ("a whole number >= 0", [-1, 1.5, 100001]),
}
COUNT = ("a whole number >= 1 and <= 100000", [0, 1.5, 100001, "5", True])
PARTS = ("a whole number >= 1", [0, 1.5, 100001])
HISTORY = {"theta": ("a finite number", [None, "1"]), "u": ("a finite number", ["1"])}
RANGES = {
    **{(*OBSERVATIONS[1], key): rule for key, rule in OBSERVED.items()},
    **{(*place, "t_observed"): OBSERVED["t_observed"] for place in OBSERVATIONS},
    **{
        (place, "history", key): rule
        for place in ("atlas", "route")
        for key, rule in HISTORY.items()
    },
    **{(place, "history", "v"): ("> 0", [0.0, -1.0]) for place in ("atlas", "route")},
    **{(place, "gamma"): ("> 0", [0.0, -1.0, *NO_NUMBERS]) for place in ("atlas", "route")},
    ("attractors", "histories", "seed"): ("a whole number >= 0", [-1, 0.5, None]),
    ("atlas", "planes", "xi_05", "xi"): ("> 0", [0.0, -1.0]),
    (*COARSE, "epsilon_count"): COUNT,
    (*COARSE, "tau_count"): COUNT,
    (*COARSE, "parts"): PARTS,
    ("route", "xi"): ("> 0", [0.0, -1.0]),
    ("route", "tau"): (">= 0", [-1e-9]),
    ("route", "epsilon_count"): COUNT,
    ("route", "parts"): PARTS,
    ("scenes", "torus", "attractors", "histories"): ("a whole number >= 1", [0, 1.5, 1001]),
}
"""For each value: words of its range, and values out of range."""
WINDOWS = {
    ("attractors", "histories", "theta"): (None, [-1e308, 1e308]),
    ("attractors", "histories", "u"): (None, [-1e308, 1e308]),
    ("attractors", "histories", "ln_v"): (">= -700.0 and <= 700.0", [-701.0, 0.0], [0.0, 701.0]),
    ("atlas", "epsilon_window"): ("> -1.0", [-1.0, 0.5]),
    ("atlas", "tau_window"): (">= 0.0", [-0.1, 5.0]),
    ("route", "epsilon_window"): ("> -1.0", [-1.0, 0.5]),
}
"""For each window: words of its bounds, and windows beyond them."""
MISSING = [
    ("attractors",),
    ("atlas",),
    ("route",),
    *[("attractors", key) for key in ("histories", "observation")],
    *[("attractors", "histories", key) for key in ("seed", "theta", "u", "ln_v")],
    *[("atlas", key) for key in ("gamma", "epsilon_window", "tau_window", "planes", "grids")],
    ("atlas", "planes", "xi_05", "xi"),
    *[("atlas", "grids", key) for key in ("coarse", "fine")],
    *[(*COARSE, key) for key in ("epsilon_count", "tau_count", "parts", "observation")],
    *[("route", key) for key in ("xi", "gamma", "tau", "epsilon_window", "epsilon_count", "parts")],
    *[(*place, key) for place in OBSERVATIONS for key in ("t_observed", "t_turning")],
    *[(*place, "t_transient") for place in OBSERVATIONS[1:]],
    ("scenes", "torus", "attractors", "histories"),
]


def place_of(path: tuple[str, ...]) -> str:
    """How a refusal calls a place."""
    if path[:1] == ("scenes",):
        return " ".join([f"scene '{path[1]}'", *path[2:]])
    return " ".join(["config", *path])


@pytest.mark.parametrize(("path", "value", "words"), out_of_range(RANGES))
def test_value_out_of_range_is_refused(config, path, value, words):
    """The line names section, key, value and range."""
    config["route"]["history"] = {"v": 1.1}
    put(config, path, value)
    line = line_about(refusal(config), path[-1])
    assert line.startswith(f"{place_of(path[:-1])}: {path[-1]} = {value!r}; expected ")
    assert words in line


@pytest.mark.parametrize("path", WINDOWS)
def test_window_that_does_not_ascend_is_refused(config, path):
    """Nor may it be a point, of another length or no list."""
    for value in ([0.5, 0.5], [0.6, 0.5], [0.5], [0.1, 0.2, 0.3], 0.5):
        put(config, path, value)
        line = line_about(refusal(config), path[-1])
        assert line.startswith(
            f"{place_of(path[:-1])}: {path[-1]} = {value!r}; expected two ascending"
        )


@pytest.mark.parametrize(
    ("path", "bounds", "window"),
    [(path, bounds, window) for path, (bounds, *windows) in WINDOWS.items() for window in windows],
)
def test_window_beyond_its_bounds_is_refused(config, path, bounds, window):
    """The line names them."""
    put(config, path, window)
    line = line_about(refusal(config), path[-1])
    assert line.endswith(f"expected two ascending numbers{f' {bounds}' if bounds else ''}")


@pytest.mark.parametrize("path", MISSING)
def test_missing_key_is_refused(config, path):
    """The line names section and key; the scene's approach is no key of `attractors`."""
    section = config
    for key in path[:-1]:
        section = section[key]
    del section[path[-1]]
    assert f"{place_of(path[:-1])}: key ['{path[-1]}'] is missing" in refusal(config)


@pytest.mark.parametrize(
    "path",
    [
        ("attractors",),
        ("attractors", "histories"),
        ("atlas",),
        ("atlas", "planes", "xi_05"),
        ("atlas", "grids"),
        COARSE,
        ("route",),
        ("scenes", "torus", "attractors"),
        *OBSERVATIONS,
    ],
)
def test_unknown_key_is_refused(config, path):
    """The line names section and key."""
    put(config, (*path, "colour"), 1)
    assert f"{place_of(path)}: unknown key ['colour']" in refusal(config)


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
