"""Drawing from made-up data: data in, axes out."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from figure_contents import assert_on_page, points_in
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from scripts.drawing import trajectories
from scripts.drawing.style import METADATA, STYLE, break_titles, logged, save
from scripts.figures import figure_6, true_torus


@pytest.fixture(autouse=True)
def _closed_figures():
    """No test leaves a figure open for the next one."""
    yield
    plt.close("all")


def a_trajectory(v: np.ndarray, u: np.ndarray) -> xr.Dataset:
    """A made-up trajectory with a time step of 0.1."""
    time = {"t": 0.1 * np.arange(v.size)}
    attributes = {"tau": 3.0, "epsilon": 0.25, "xi": 0.5, "gamma": 0.75, "t_transient": 50.0}
    return xr.Dataset({"u": ("t", u), "v": ("t", v)}, time, attributes)


def test_dense_oscillations_are_drawn_as_their_envelope():
    """Of an oscillation that grows: all of it lies in a band, whose edges are its extremes."""
    t = 0.1 * np.arange(40_001)
    size = 1 + t / t[-1]
    run = a_trajectory(1 + size * np.cos(t), 0 * t)
    _, axes = plt.subplots()
    assert trajectories.draw_velocity(axes, run, 0.0, 4000.0)
    least, most = axes.lines
    at = most.get_xdata()
    np.testing.assert_allclose(most.get_ydata(), 2 + at / t[-1], atol=0.02)
    np.testing.assert_allclose(least.get_ydata(), -at / t[-1], atol=0.02)
    assert len(at) <= trajectories.MOST_TURNS
    assert not trajectories.draw_velocity(axes, run, 0.0, 400.0)
    np.testing.assert_allclose(axes.lines[-1].get_ydata(), run.v[:4001])


def test_a_damped_pair_is_found_in_the_spectrum_of_the_beginning():
    """A wave that dies out beside a lasting one: its height follows from its mean in the window."""
    t = 0.1 * np.arange(20_001)
    dying = 0.1 * np.exp(-0.015 * t)
    run = a_trajectory(np.cos(0.62 * t) + dying * np.cos(1.11 * t), 0 * t)
    pairs = {"root_real": ("root", [0.01, -0.015, -0.08]), "root_imag": ("root", [0.62, 1.11, 0.2])}
    frequency, rate = true_torus.damped_pair(xr.Dataset(pairs))
    assert (frequency, rate) == (1.11 / (2 * np.pi), -0.015)
    found, height = true_torus.peak_near(frequency, *true_torus.early_spectrum(run))
    assert found == pytest.approx(frequency, abs=1e-3)
    mean = np.average(dying[:2001], weights=np.hanning(2001))
    assert height == pytest.approx(mean**2, rel=0.05)


def test_missed_part_of_a_maximum():
    """Exact for a parabola, at uneven times; 1 - cos(h/2) at most for a cosine of step h."""
    t = np.array([0.0, 1.0, 1.2, 1.9, 2.5])
    top = xr.Dataset({"v": ("t", 3 - (t - 1.4) ** 2)}, {"t": t})
    assert trajectories.share_missed(top) == pytest.approx(3 / 2.96 - 1)
    for step in (0.02, 0.2, 0.6):
        t = np.arange(0.0, 1000.0, step)
        wave = xr.Dataset({"v": ("t", 2 + np.cos(t))}, {"t": t})
        most = 3 / (2 + np.cos(step / 2)) - 1
        assert trajectories.share_missed(wave) == pytest.approx(most, rel=0.1)
    steady = xr.Dataset({"v": ("t", np.ones(9))}, {"t": np.arange(9.0)})
    assert trajectories.share_missed(steady) == 0


BASE, HARMONIC, OTHER = (0.1, 9.0, 0, 1, 0), (0.2, 5.0, 1, 2, 0), (0.27, 1.0, 4, 0, 0)
SECOND = (0.35, 4.0, 2, 0, 1)


def draw_spectrum(*peaks: tuple[float, float, int, int, int]) -> Axes:
    """The logarithmic panel of a made-up spectrum up to a frequency of 0.5, with peaks of
    frequency, power, kind and multiples of both bases."""
    frequency = np.linspace(0, 5, 501)
    names = ["peak_frequency", "peak_power", "peak_kind", "peak_multiple", "peak_second_multiple"]
    columns = dict(zip(names, np.transpose(peaks), strict=True))
    data = {name: ("peak", column) for name, column in columns.items()}
    data["power"] = ("frequency", 1e-3 + 0 * frequency)
    data["base_frequency"] = ("base", [f for f, _, kind, *_ in peaks if kind in (0, 2)])
    attributes = {"scene": "made_up", "line_share": 0.75, "spectrum_kind": "undecided"}
    spectrum = xr.Dataset(data, {"frequency": frequency}, attributes)
    settings = {"rows": {"a": {"paper": "word"}}, "frequency_shown": 0.5}
    return figure_6.draw([spectrum], settings).axes[0]


def test_peaks_are_named_by_kind():
    """Base, harmonic with its multiple, other in another colour, each with its frequency."""
    peaks = [BASE, HARMONIC, SECOND, OTHER]
    axes = draw_spectrum(*peaks)
    labels = {text.get_text(): text.get_color() for text in axes.texts}
    names = ["$f_1$\n0.1000", "$2f_1$\n0.2000", "$f_2$\n0.3500", "other\n0.2700"]
    assert list(labels) == names
    *explained, other = labels.values()
    assert len(set(explained)) == 1
    assert other not in explained
    assert {(x, y) for x, y, _ in points_in(axes)} == {p[:2] for p in peaks}


def test_peaks_beside_a_higher_one_get_a_dot_only():
    """Labels would lie on each other or on a dot; peaks beyond the axis get nothing."""
    beside, beyond = (0.13, 2.0, 3, -3, 2), (0.6, 3.0, 1, 6, 0)
    beside_a_dot = (0.155, 1.0, 3, -2, 2)
    axes = draw_spectrum(BASE, beside, beside_a_dot, beyond)
    assert [text.get_text() for text in axes.texts] == ["$f_1$\n0.1000"]
    assert {x for x, *_ in points_in(axes)} == {0.1, 0.13, 0.155}


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
    with plt.style.context(STYLE):
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
