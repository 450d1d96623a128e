"""The figure and the caption of a scene: the class rests on longer runs than what is drawn."""

import math

import numpy as np
import pytest
import xarray as xr
from made_up_results import attractor_row, spectrum, trajectory
from matplotlib import pyplot as plt

from scripts.drawing.trajectories import draw_signal
from scripts.studies.scenes import figure as scene
from scripts.tables.attractor_tables import SAME_MAXIMUM

PEAK = 2e9
"""Largest v of events at the parameters of faults."""


def run_with(largest: float, first: float | None = None, count: int = 30) -> xr.Dataset:
    """Events 10 apart up to time 10 `count`, with this largest v, and another one of the first."""
    t = np.linspace(0.0, 10.0 * count, 100 * count + 1)
    phase = np.sin(0.1 * np.pi * t) ** 200
    heights = np.where(t < 10.0, largest if first is None else first, largest)
    v = 0.004 * (heights / 0.004) ** phase
    return trajectory(t, v=v)


def row_of(motion: str, **given) -> dict:
    peaks = {"smallest_maximum": PEAK, "largest_maximum": PEAK, "recurrence_time": 10.0}
    return attractor_row(motion, **{**peaks, **given})


@pytest.mark.parametrize(
    ("motion", "run", "said"),
    [
        ("cycle", run_with(PEAK), False),
        ("cycle", run_with(PEAK, first=PEAK / (1 + 2 * SAME_MAXIMUM)), True),
        ("cycle", run_with(PEAK, first=PEAK * (1 + 2 * SAME_MAXIMUM)), True),
        ("torus", run_with(0.7 * PEAK), False),
        ("chaos", run_with(PEAK, first=1.1), False),
        ("chaos", run_with(1.1), True),
        ("fixed point", run_with(1.001), False),
        ("fixed point", run_with(1.1), True),
    ],
)
def test_transient_in_place_of_the_attractor_is_said(motion, run, said):
    """What is drawn as attractor has its largest v; of a cycle already in the first period."""
    assert bool(scene.unsettled(run, row_of(motion))) is said


def test_run_without_a_class_has_no_hint():
    assert scene.unsettled(run_with(1.1), row_of("undecided", largest_maximum=math.nan)) == ""


def test_rest_that_is_not_disturbed_is_said():
    """By v alone, which follows theta and u at once at large gamma."""
    words = scene.motion_in_words(row_of("undecided", reason="unstable rest", problem=""))
    assert "the history disturbs too little, disturb theta or u" in words


@pytest.mark.parametrize(
    ("motion", "kind", "bin_width", "words"),
    [
        ("cycle", "continuum", 0.001, "too short"),
        ("cycle", "periodic", 0.001, "periodic"),
        ("cycle", "periodic", 0.1, "too short"),
        ("torus", "periodic", 0.001, "too short"),
        ("chaos", "continuum", 0.001, "69 % of the power is broadband"),
        ("chaos", "continuum", 0.1, "too short"),
        ("undecided", "continuum", 0.001, "69 % of the power is broadband"),
        ("undecided", "continuum", 0.1, "too short"),
        ("fixed point", "continuum", 0.001, "approach to steady sliding"),
    ],
)
def test_spectrum_says_nothing_against_the_class(motion, kind, bin_width, words):
    """A run with too few events has no lines; one with other lines than the class is too short."""
    seen = spectrum(kind).assign_coords(frequency=[0.0, bin_width], base_frequency=[0.1])
    assert words in scene.spectrum_in_words(seen, row_of(motion))


@pytest.mark.parametrize(("largest", "scale"), [(5.0, "linear"), (PEAK, "log")])
def test_axis_of_velocity_shows_steady_sliding(largest, scale):
    """Logarithmic where v = 1 could not be told from a stuck block; the end shows events."""
    figure, axes = plt.subplots()
    run = run_with(largest)
    assert not draw_signal(axes, run, 0.0, 300.0)
    assert axes.get_yscale() == scale
    dense = run_with(largest, count=200)
    assert draw_signal(axes, dense, 0.0, 2000.0)
    plt.close(figure)
    assert scene.end_shown(row_of("cycle"), 300.0) >= 100.0


def test_section_of_a_cycle_is_its_last_period():
    """Points of the approach are none of the cycle; a torus has all."""
    theta = np.array([[3.0, 2.0, 1.1, 1.0, 0.5, 1.0, 0.5, np.nan]])
    points = {"section_theta": (("point", "kept"), theta), "section_u": (("point", "kept"), theta)}
    figure, (cycle, torus) = plt.subplots(1, 2)
    scene.draw_section(cycle, xr.Dataset(points), row_of("cycle", period=2.0))
    scene.draw_section(torus, xr.Dataset(points), row_of("torus"))
    assert [len(axes.lines[0].get_xdata()) for axes in (cycle, torus)] == [2, 7]
    plt.close(figure)


def test_lines_of_stick_slip_are_told_apart():
    """Of a thousand lines of equal height the axis shows the first 40."""
    frequency = 0.01 * np.arange(10_001)
    seen = spectrum(x1=1.0).assign_coords(frequency=frequency, base_frequency=[0.1])
    seen["power"] = ("frequency", np.where(np.arange(10_001) % 10 == 0, 1.0, 1e-9))
    assert scene.frequency_shown(seen) == pytest.approx(4.05)
