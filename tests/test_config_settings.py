"""Checking what a configuration says outside scenes: each refusal in words."""

import contextlib

import pytest
from config_refusals import NO_NUMBERS, line_about, out_of_range, put, refusal

from scripts.config.check_config import checked
from scripts.config.read_config import ConfigError

SETTING_RANGES = {
    ("figures", "figure_4", "end_shown"): ("> 0", [0.0]),
    ("figures", "figure_4", "attractor_shown"): ("> 0", [0.0]),
    ("figures", "figure_5", "end_shown"): ("> 0", [0.0]),
    ("figures", "figure_5", "attractor_shown"): ("> 0", [0.0]),
    ("figures", "figure_6", "frequency_shown"): ("> 0", [0.0]),
    ("figures", "figure_7", "frequency_shown"): ("> 0", [0.0]),
    ("figures", "figure_4", "rows", "a", "time_shown"): ("> 0", [0.0]),
    ("spectra", "segments"): ("a whole number >= 1", [0, -1, 2.5]),
    ("spectra", "overlap"): ("[0, 1)", [-0.1, 1.0]),
    ("spectra", "peak_floor"): ("(0, 1]", [0.0, 1.1]),
    ("spectra", "peak_prominence"): (">= 1", [0.9]),
    ("hopf_curves", "tau_of_epsilon", "fixed"): ("> 0", [0.0, -1.0]),
    ("hopf_curves", "xi_of_epsilon", "fixed"): (">= 0", [-1.0]),
    ("hopf_curves", "tau_of_epsilon", "gamma"): ("> 0", [0.0]),
    ("hopf_curves", "tau_of_epsilon", "cells"): ("a whole number >= 1", [0, 2.5, 2001]),
    ("velocity_step", "mu0"): (">= 0", [-0.1]),
    ("velocity_step", "a"): (">= 0", [-0.1]),
    ("velocity_step", "b"): (">= 0", [-0.1]),
    ("velocity_step", "dc"): ("> 0", [0.0]),
    ("velocity_step", "v0"): ("> 0", [0.0]),
    ("velocity_step", "b_state"): ("> 0", [0.0]),
    ("velocity_step", "delta_v"): ("> 0", [0.0]),
    ("velocity_step", "slip_before"): ("> 0", [0.0]),
    ("velocity_step", "slip_after"): ("> 0", [0.0]),
    ("velocity_step", "samples"): ("a whole number >= 2", [1, 2.5]),
    ("velocity_step", "tolerance"): ("[1e-13, 1e-2]", [9.9e-14, 1.01e-2]),
}
"""For each number: words of its range, and values out of range."""
WINDOWS = [
    ("hopf_curves", plane, f"{axis}_window")
    for plane in ("tau_of_epsilon", "xi_of_epsilon")
    for axis in ("epsilon", "ordinate")
]


@pytest.mark.parametrize("figure", ["figure_4", "figure_5", "figure_6", "figure_7"])
def test_figure_row_of_an_unknown_scene_is_refused(config, figure):
    """The line names figure, row, value and the scenes there are."""
    config["figures"][figure]["rows"]["a"]["scene"] = "nowhere"
    line = line_about(refusal(config), "scene")
    assert figure in line
    assert " a: scene = 'nowhere'; expected one of: " in line
    assert line.endswith("fixed_point, oscillation, torus, chaos, true_torus")


@pytest.mark.parametrize("value", [None, 5, ["torus"]])
@pytest.mark.parametrize("key", ["scene", "paper"])
def test_word_of_a_figure_row_that_is_no_text_is_refused(config, key, value):
    """The line names figure, row, key and value."""
    config["figures"]["figure_6"]["rows"]["a"][key] = value
    assert f"config figures figure_6 rows a: {key} = {value!r}; expected " in refusal(config)


def test_figure_without_rows_is_refused(config):
    """A figure of nothing cannot be drawn."""
    config["figures"]["figure_4"]["rows"] = {}
    assert "config figures figure_4: rows = {}; expected " in refusal(config)


@pytest.mark.parametrize(("path", "value", "words"), out_of_range(SETTING_RANGES))
def test_setting_out_of_range_is_refused(config, path, value, words):
    """The line names place, key, value and range."""
    put(config, path, value)
    (line,) = refusal(config).splitlines()[1:]
    assert line.startswith(" ".join(["config", *path[:-1]]) + f": {path[-1]}")
    assert f" = {value!r}; expected " in line
    assert words in line


@pytest.mark.parametrize("value", NO_NUMBERS)
@pytest.mark.parametrize("path", SETTING_RANGES)
def test_setting_that_is_no_finite_number_is_refused(config, path, value):
    """The line names place, key and value."""
    put(config, path, value)
    (line,) = refusal(config).splitlines()[1:]
    assert line.startswith(" ".join(["config", *path[:-1]]) + f": {path[-1]} = {value!r}; expected")
    assert "number" in line


@pytest.mark.parametrize(
    ("path", "value", "words"),
    [
        (("spectra", "window"), "hamming", "hann, boxcar"),
        (("spectra", "window"), None, "hann, boxcar"),
        (("hopf_curves", "tau_of_epsilon", "ordinate"), "gamma", "tau, xi"),
        (("hopf_curves", "xi_of_epsilon", "ordinate"), 1, "tau, xi"),
    ],
)
def test_word_that_is_no_choice_is_refused(config, path, value, words):
    """The line names place, key, value and the choices."""
    put(config, path, value)
    line = line_about(refusal(config), path[-1])
    assert line.startswith(" ".join(["config", *path[:-1]]) + f": {path[-1]} = {value!r}; ")
    assert words in line


@pytest.mark.parametrize(
    "window", [[1.0, 0.5], [0.5, 0.5], [-1.5, 1.0], [1.0], [0, 1, 2], 1.0, None]
)
@pytest.mark.parametrize("path", WINDOWS)
def test_window_that_is_no_window_is_refused(config, path, window):
    """Two ascending numbers, not below the least value."""
    put(config, path, window)
    line = line_about(refusal(config), path[-1])
    assert line.startswith(" ".join(["config", *path[:-1]]) + f": {path[-1]} = {window!r}; ")
    assert "two ascending" in line


@pytest.mark.parametrize("value", NO_NUMBERS)
@pytest.mark.parametrize("path", WINDOWS)
def test_window_end_that_is_no_finite_number_is_refused(config, path, value):
    """The line names place, window and value."""
    put(config, path, [0.1, value])
    words = refusal(config)
    assert " ".join(["config", *path]) + f": 1 = {value!r}; expected a finite number" in words


@pytest.mark.parametrize(
    ("path", "window", "words"),
    [
        (("hopf_curves", "tau_of_epsilon", "epsilon_window"), [-1.0, 1.0], "> -1"),
        (("hopf_curves", "tau_of_epsilon", "epsilon_window"), [-0.5, -0.1], "> 0"),
        (("hopf_curves", "tau_of_epsilon", "epsilon_window"), [-0.5, 0.0], "> 0"),
        (("hopf_curves", "tau_of_epsilon", "ordinate_window"), [-0.1, 1.0], ">= 0"),
        (("hopf_curves", "xi_of_epsilon", "ordinate_window"), [0.0, 1.0], "> 0"),
    ],
)
def test_window_over_the_edge_is_refused(config, path, window, words):
    """The line names place, window, value and the edge."""
    put(config, path, window)
    line = line_about(refusal(config), path[-1])
    assert f"{path[-1]} = {window!r}; expected " in line
    assert words in line


@pytest.mark.parametrize("value", [8.0, 10**12])
def test_count_that_no_program_reads_is_refused(config, value):
    """A program takes `8.0` for no whole number, and none above 2**31."""
    config["spectra"]["segments"] = value
    with contextlib.suppress(ConfigError):
        segments = checked(config)["spectra"]["segments"]
        assert isinstance(segments, int)
        assert segments < 2**31


@pytest.mark.parametrize(
    "path",
    [
        ("threads",),
        ("spectra", "windows"),
        ("hopf_curves", "tau_of_epsilon", "xi"),
        ("velocity_step", "c"),
        ("figures", "figure_4", "colour"),
        ("figures", "figure_4", "rows", "a", "colour"),
        ("figures", "figure_6", "end_shown"),
    ],
)
def test_unknown_key_outside_scenes_is_refused(config, path):
    """The line names place and key, and lists what is known."""
    put(config, path, 1.0)
    *place, key = path
    (line,) = refusal(config).splitlines()[1:]
    start = " ".join(["config", *place]) + f": unknown key ['{key}']; allowed: "
    assert line.startswith(start)
    assert len(line) > len(start)


@pytest.mark.parametrize("figure", ["figure_9", 4])
def test_unknown_figure_is_refused(config, figure):
    """The line names the figure, not those that are known."""
    config["figures"][figure] = {}
    words = refusal(config)
    assert f"config figures: unknown key [{figure!r}]; allowed: figure_4, " in words


@pytest.mark.parametrize(
    "section", ["scenes", "figures", "spectra", "hopf_curves", "velocity_step"]
)
def test_missing_section_is_refused(config, section):
    """The line names the section, once."""
    del config[section]
    assert refusal(config).splitlines()[1:] == [f"config: key ['{section}'] is missing"]
