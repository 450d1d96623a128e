"""The figure of the cycles followed, from small made-up files."""

import numpy as np
import pytest
import xarray as xr
from figure_contents import assert_on_page, title_of, words_in
from made_up_results import followed_cycles
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing.special_points import STYLES
from scripts.drawing.style import STYLE
from scripts.figures import cycles
from scripts.results import paths

STABLE, ONE, TWO, MANY = (style["color"] for style in cycles.LINES)


@pytest.fixture(autouse=True)
def _style():
    """That of all figures, and none is left open."""
    with plt.style.context(STYLE):
        yield
    plt.close("all")


def a_sweep(*maxima: float) -> xr.Dataset:
    """A sweep with two places kept, the second without a maximum but one."""
    kept = np.array([maxima, [maxima[0], np.nan]])
    return xr.Dataset({"tau": ("point", [0.2, 0.4]), "maximum": (("point", "kept"), kept)})


@pytest.fixture
def drawn() -> Figure:
    """Two lines, one along tau with two sweeps, one along epsilon without."""
    lines = {"in_tau": followed_cycles("tau"), "in_epsilon": followed_cycles("epsilon")}
    sweeps = {"in_tau": [("up", a_sweep(1.5, 1.25)), ("down", a_sweep(3.5, 3.25))]}
    scene = {"tau": 0.3, "epsilon": 0.5, "xi": 0.8, "gamma": 0.8}
    scenes = {"on_it": scene, "elsewhere": {**scene, "xi": 0.5}}
    figure = cycles.draw(lines, {"in_epsilon": [], **sweeps}, scenes)
    figure.canvas.draw()
    return figure


def labelled(axes: Axes, label: str) -> list[Line2D]:
    """What is drawn under a name of the legend."""
    return [line for line in axes.lines if line.get_label() == label]


def test_figure_is_on_its_page(drawn):
    """Nothing cut off."""
    assert_on_page(drawn)


def test_each_line_has_a_panel(drawn):
    """Its title has what is fixed and the counts, its axes name what varies, with units."""
    in_tau, in_epsilon = drawn.axes
    assert r"$\varepsilon = 0.5$, $\xi = 0.8$, $\gamma = 0.8$: 2 branches, 4 special points" in (
        title_of(in_tau)
    )
    assert r"$\tau = 10$, $\xi = 0.8$" in title_of(in_epsilon)
    assert in_tau.get_xlabel() == r"delay $\tau$ (units of $L/v_0$)"
    assert in_epsilon.get_xlabel() == r"sensitivity of the velocity relaxation $\varepsilon$"
    assert {axes.get_ylabel() for axes in drawn.axes} == {"maxima of $v$ (units of $v_0$)"}


def test_branches_change_their_line_at_special_points(drawn):
    """Each part ends at the point where its number of unstable multipliers changes."""
    parts = [
        (line.get_color(), [tuple(point) for point in line.get_xydata()])
        for line in drawn.axes[0].lines
        if line.get_label() in {style["label"] for style in cycles.LINES}
    ]
    assert parts == [
        (TWO, [(0.1, 1.1), (0.3, 1.5), (0.4, 2.0), (0.45, 2.2)]),
        (MANY, [(0.45, 2.2), (0.4, 2.5), (0.35, 2.8), (0.3, 3.0)]),
        (ONE, [(0.3, 3.0), (0.2, 3.5)]),
        (STABLE, [(0.6, 2.0), (0.7, 2.1)]),
        (ONE, [(0.7, 2.1), (0.8, 2.0), (0.8, 2.5), (0.7, 2.6)]),
        (STABLE, [(0.7, 2.6), (0.6, 2.5), (0.6, 2.0)]),
    ]


def test_a_change_without_a_point_is_drawn_between_orbits():
    """A point that the search did not find moves no other point."""
    found = followed_cycles().isel(special=[0])
    x, y, unstable = cycles.branch_of(found, 1, "tau")
    assert x.tolist() == [0.1, 0.3, 0.4, 0.45, 0.4, 0.35, 0.2]
    assert y.tolist() == [1.1, 1.5, 2.0, 2.2, 2.5, 2.8, 3.5]
    assert unstable.tolist() == [2, 2, 2, 3, 3, 3]


def test_a_branch_of_one_orbit_has_no_line():
    """The other branch is drawn as before."""
    found = followed_cycles().isel(orbit=[5, 6, 7, 8, 9])
    (axes,) = cycles.draw({"one": found}, {"one": []}, {}).axes
    assert labelled(axes, "2 unstable multipliers") == []
    assert len(labelled(axes, "stable cycle")) == 2


def test_stable_cycles_are_thick(drawn):
    """At least twice as thick as the unstable ones, which lie on top."""
    (stable, *_), (unstable, *_) = (
        labelled(drawn.axes[0], label) for label in ("stable cycle", "1 unstable multiplier")
    )
    assert stable.get_linewidth() > 2 * unstable.get_linewidth()
    (dots,) = labelled(drawn.axes[0], "sweep up")
    assert stable.get_zorder() < dots.get_zorder() < unstable.get_zorder()


def test_special_points_have_markers_by_kind(drawn):
    """At their places; Hopf points stand on steady sliding."""
    expected = {
        "fold": ("fold", [(0.45, 2.2)]),
        "torus bifurcation": ("torus", [(0.3, 3.0)]),
        "period doubling": ("period_doubling", [(0.7, 2.1), (0.7, 2.6)]),
    }
    for axes in drawn.axes:
        for label, (kind, places) in expected.items():
            (points,) = labelled(axes, label)
            assert points.get_marker() == STYLES[kind].marker
            assert [tuple(point) for point in points.get_xydata()] == places
        (hopf,) = labelled(axes, "Hopf point")
        assert [tuple(point) for point in hopf.get_xydata()] == [(0.1, 1.0)]


def test_marks_of_a_branch_that_is_smaller_than_they_are_left_out():
    """They would hide it and stand alone; the line is drawn, and so are other marks."""
    lines = followed_cycles("tau")
    closed, points = lines.branch.values == 2, lines.special_branch.values == 2
    for name, there in (("tau", closed), ("special_tau", points)):
        lines[name][there] = 0.7 + 1e-3 * (lines[name][there] - 0.7)
    (axes,) = cycles.draw({"one": lines}, {"one": []}, {}).axes
    assert labelled(axes, "period doubling") == []
    assert len(labelled(axes, "fold")) == len(labelled(axes, "torus bifurcation")) == 1
    assert len(labelled(axes, "stable cycle")) == 2


def test_sweeps_are_dots_at_all_maxima(drawn):
    """Those of the second are smaller; a line without a route has none."""
    in_tau, in_epsilon = drawn.axes
    (up,), (down,) = (labelled(in_tau, f"sweep {run}") for run in ("up", "down"))
    assert [tuple(p) for p in up.get_xydata()] == [(0.2, 1.5), (0.2, 1.25), (0.4, 1.5)]
    assert [tuple(p) for p in down.get_xydata()] == [(0.2, 3.5), (0.2, 3.25), (0.4, 3.5)]
    assert up.get_markersize() > down.get_markersize()
    assert labelled(in_epsilon, "sweep up") == labelled(in_epsilon, "sweep down") == []


def test_legend_names_what_is_drawn(drawn):
    """In a fixed order, each once; kinds that are nowhere are not named."""
    (legend,) = drawn.legends
    assert [text.get_text() for text in legend.get_texts()] == [
        *("stable cycle", "1 unstable multiplier", "2 unstable multipliers"),
        *("3 or more unstable multipliers", "sweep up", "sweep down"),
        *("steady sliding", "Hopf point", "fold", "period doubling", "torus bifurcation"),
    ]
    alone = cycles.draw({"one": followed_cycles().isel(special=[], hopf=[])}, {"one": []}, {})
    words = words_in(alone)
    for name in ("sweep", "Hopf point", "fold", "torus bifurcation"):
        assert name not in words
    assert "2 branches, 0 special points" in words


def test_scenes_on_a_line_are_named(drawn):
    """Those with the values of the fixed parameters."""
    assert [[text.get_text() for text in axes.texts] for axes in drawn.axes] == [["on it"], []]


def test_sweeps_are_those_of_routes_on_the_same_line(config):
    """The same parameter and the same fixed values; the name does not matter."""
    at = {"along": "tau", "epsilon": 0.7, "xi": 0.5, "gamma": 0.8}
    config["cycles"]["lines"] = {
        "mine": at,
        "beside": {**at, "xi": 0.6},
        "across": {"along": "epsilon", "tau": 7.0, "xi": 0.5, "gamma": 0.8},
    }
    folder = "<results>/attractors/routes"
    assert paths.sweeps_on_lines(config) == {
        "mine": [f"{folder}/chaos_in_tau/up.nc", f"{folder}/chaos_in_tau/down.nc"],
        "beside": [],
        "across": [f"{folder}/chaos_in_epsilon/up.nc", f"{folder}/chaos_in_epsilon/down.nc"],
    }


def test_atlas_needs_cycles_of_its_planes(config):
    """A line at another gamma or xi lies in no plane."""
    at = {"along": "tau", "epsilon": 0.7, "xi": 0.5, "gamma": 0.8}
    config["cycles"]["lines"] = {
        "mine": at,
        "elsewhere": {**at, "gamma": 0.9},
        "beside": {**at, "xi": 0.6},
        "across": {"along": "xi", "tau": 7.0, "epsilon": 0.7, "gamma": 0.8},
    }
    assert paths.cycles_in_atlas(config) == ["<results>/cycles/mine.nc"]
