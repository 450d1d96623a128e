"""Drawing from made-up data: data in, axes out."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from figure_contents import assert_on_page
from made_up_results import trajectory
from matplotlib import pyplot as plt

from scripts.drawing import trajectories
from scripts.drawing.along_parameter import mark_scenes
from scripts.drawing.style import METADATA, break_titles, logged, move_offsets, save

pytestmark = pytest.mark.usefixtures("styled")


def test_dense_oscillations_are_drawn_as_their_envelope():
    """Of an oscillation that grows: all of it lies in a band, whose edges are its extremes."""
    t = 0.1 * np.arange(40_001)
    size = 1 + t / t[-1]
    run = trajectory(t, v=1 + size * np.cos(t))
    _, axes = plt.subplots()
    assert trajectories.draw_signal(axes, run, 0.0, 4000.0)
    least, most = axes.lines
    at = most.get_xdata()
    np.testing.assert_allclose(most.get_ydata(), 2 + at / t[-1], atol=0.02)
    np.testing.assert_allclose(least.get_ydata(), -at / t[-1], atol=0.02)
    assert len(at) <= trajectories.MOST_TURNS
    assert not trajectories.draw_signal(axes, run, 0.0, 400.0)
    np.testing.assert_allclose(axes.lines[-1].get_ydata(), run.v[:4001])


def test_missed_part_of_a_maximum():
    """Exact for a parabola, at uneven times; 1 - cos(h/2) at most for a cosine of step h."""
    t = np.array([0.0, 1.0, 1.2, 1.9, 2.5])
    top = trajectory(t, v=3 - (t - 1.4) ** 2)
    assert trajectories.share_missed(top) == pytest.approx(3 / 2.96 - 1)
    for step in (0.02, 0.2, 0.6):
        t = np.arange(0.0, 1000.0, step)
        wave = trajectory(t, v=2 + np.cos(t))
        most = 3 / (2 + np.cos(step / 2)) - 1
        assert trajectories.share_missed(wave) == pytest.approx(most, rel=0.1)
    steady = trajectory(np.arange(9.0), v=np.ones(9))
    assert trajectories.share_missed(steady) == 0


def test_saved_figures_have_the_same_bytes_each_time(tmp_path):
    for name in ("first", "second"):
        with logged(tmp_path / "log"):
            figure, axes = plt.subplots()
            axes.plot([0, 1], [0, 1], label="$x$", rasterized=True)
            figure.legend()
            paths = {ending: tmp_path / f"{name}.{ending}" for ending in METADATA}
            save(figure, SimpleNamespace(**paths))
            assert not plt.get_fignums()
    for ending in ("pdf", "png", "svg"):
        first = (tmp_path / f"first.{ending}").read_bytes()
        assert first == (tmp_path / f"second.{ending}").read_bytes()
        assert not re.search(rb"Date|dc:date", first)


def test_long_titles_are_broken_on_the_page():
    """Between words; formulas stay whole, and look as before."""
    figure, panels = plt.subplots(1, 2)
    formula = r"$\lambda = -0.01997 \pm 0.6527\,i$"
    title = f"a scene {'with a long name ' * 5}and {formula}"
    panels[0].set_title(title)
    figure.suptitle(title + title)
    panels[1].set_title(formula)
    (whole,) = panels[1].findobj(lambda part: getattr(part, "get_text", str)() == formula)
    before = whole.get_window_extent().width
    break_titles(figure)
    assert_on_page(figure)
    assert whole.get_window_extent().width == before
    assert formula.replace(" ", "") in figure.get_suptitle()


def test_axes_keep_their_titles_and_say_their_factor():
    """Empty tick labels are no titles to break, and no factor lies over a label."""
    figure, axes = plt.subplots(figsize=(2.0, 2.0))
    axes.plot([0, 4e-7], [1, 1 + 4e-9])
    axes.set(xlabel="$u$")
    break_titles(figure)
    assert not any(label.get_wrap() for label in axes.get_yticklabels())
    figure.draw_without_rendering()
    assert move_offsets(figure)
    assert re.fullmatch(r"\$u\$\n\(\$.*10\^\{.7\}.*\$\)", axes.get_xlabel())
    assert axes.get_ylabel().endswith("+1}$)")
    assert_on_page(figure)
    assert not move_offsets(figure)


def test_names_of_scenes_on_a_line_are_apart():
    figure, axes = plt.subplots(figsize=(3.0, 2.0))
    axes.set_xlim(0, 20)
    place = {"epsilon": 0.5, "xi": 0.8, "gamma": 0.8}
    mark_scenes(
        axes, {"torus": {**place, "tau": 10.0}, "a_torus": {**place, "tau": 12.5}}, place, "tau"
    )
    figure.canvas.draw()
    first, second = (text.get_window_extent() for text in axes.texts)
    assert not first.overlaps(second)
