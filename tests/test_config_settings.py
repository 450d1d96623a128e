"""Checking what a configuration says outside scenes: each refusal in words."""

import pytest
from config_refusals import assert_refused, line_about, refusal

from scripts.config.check_config import checked


@pytest.mark.parametrize("figure", ["figure_4", "figure_5", "figure_6", "figure_7", "events"])
def test_figure_row_of_an_unknown_scene_is_refused(config, figure):
    """The line names figure, row, value and the scenes there are."""
    config["figures"][figure]["rows"]["a"]["scene"] = "nowhere"
    line = line_about(refusal(config), "scene")
    assert figure in line
    assert " a: scene = 'nowhere'; expected one of: " in line
    assert line.endswith(", ".join(config["scenes"]))


def test_values_that_contradict_others_are_refused(config):
    """The line names the range that the other value leaves."""
    contradictions = {
        ("scenes", "torus", "exponents", "t_end"): (2000.0, "> t_transient = 2000.0 and > tau"),
        ("hopf_curves", "tau_of_epsilon", "fixed"): (0.0, "> 0"),
        ("work_precision", "scenes", "torus", "sample_interval"): (2000.0, "<= t_end = 1000.0"),
    }
    assert_refused(checked(config), contradictions)


def test_figure_without_rows_is_refused(config):
    """A figure of nothing cannot be drawn."""
    config["figures"]["figure_4"]["rows"] = {}
    assert "config figures figure_4: rows = {}; expected " in refusal(config)


@pytest.mark.parametrize("figure", ["figure_9", 4])
def test_unknown_figure_is_refused(config, figure):
    """The line names the figure, not those that are known."""
    config["figures"][figure] = {}
    words = refusal(config)
    assert f"config figures: unknown key [{figure!r}]; allowed: figure_4, " in words
