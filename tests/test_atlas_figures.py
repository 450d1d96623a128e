"""Figures of the atlas and of cycles, from small made-up results."""

import copy
import math

import numpy as np
import pytest
from figure_contents import title_of, words_in
from made_up_results import attractor_row, followed_cycles
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection, QuadMesh
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing import class_map
from scripts.drawing.special_points import STYLES
from scripts.drawing.style import STYLE
from scripts.figures import atlas, cycles
from scripts.results import paths
from scripts.tables.motion_rows import COLOURS

STABLE, ONE, TWO, MANY = (style["color"] for style in cycles.LINES)


@pytest.fixture(autouse=True)
def _style():
    """That of all figures, and none is left open."""
    with plt.style.context(STYLE):
        yield
    plt.close("all")


def a_row(met: str, epsilon: float, tau: float = 7.0, xi: float = 0.5, **given) -> dict:
    place = {"epsilon": epsilon, "tau": tau, "xi": xi, "gamma": 0.8, "problem": math.nan}
    return attractor_row(met) | place | given


def grid_of(xi: float) -> list[dict]:
    """Three by four points with every class, one cycle of three loops and one failure."""
    classes = ["fixed point", "cycle", "cycle", "torus", "chaos", "undecided"] * 2
    classes[9] = "3-torus"
    places = [(e, t) for t in (0.0, 10.0, 20.0) for e in (0.0, 0.5, 1.0, 1.5)]
    rows = [a_row(met, e, t, xi) for met, (e, t) in zip(classes, places, strict=True)]
    rows[2]["period"] = 3.0
    rows[11] |= {"problem": "it stopped", "exponent_1": math.nan}
    return rows


def crosses_in(axes: Axes) -> list[list[float]]:
    return [line.get_xydata()[0].tolist() for line in axes.lines if line.get_marker() == "x"]


@pytest.fixture
def atlas_drawn() -> Figure:
    rows = grid_of(0.8) + grid_of(0.5)
    figure = atlas.draw(rows, [], [], {})
    figure.canvas.draw()
    return figure


def test_cells_have_the_colours_of_their_classes(atlas_drawn):
    (mesh,) = [item for item in atlas_drawn.axes[0].collections if isinstance(item, QuadMesh)]
    expected = [COLOURS[name] for name in ("fixed point", "cycle", "multi-loop cycle")]
    colours = mesh.get_facecolors().reshape(3, 4, 4)
    np.testing.assert_allclose(colours[0, :3], [to_rgba(colour) for colour in expected])
    np.testing.assert_allclose(mesh.get_coordinates()[0, :, 0], [0, 0.25, 0.75, 1.25, 1.5])
    np.testing.assert_allclose(mesh.get_coordinates()[:, 0, 1], [0, 5, 15, 20])


def test_undecided_cells_are_hatched_and_failures_crossed(atlas_drawn):
    """The failed one too is undecided; the legend names what is there and nothing else."""
    axes = atlas_drawn.axes[0]
    (hatched,) = [item for item in axes.collections if isinstance(item, PatchCollection)]
    corners = {tuple(path.vertices[0]) for path in hatched.get_paths()}
    assert corners == {(0.25, 5.0), (1.25, 15.0)}
    assert [crosses_in(axes) for axes in atlas_drawn.axes[:2]] == [[[1.5, 20.0]]] * 2
    words = words_in(atlas_drawn)
    assert all(kind in words for kind in COLOURS)
    assert "run failed" in words
    handles = class_map.legend_of([a_row("cycle", 0.1), a_row("torus", 0.2)])
    assert [handle.get_label() for handle in handles] == ["cycle", "torus"]


def test_points_not_computed_have_the_exponent_of_the_nearest_of_their_kind():
    rows = grid_of(0.5)
    rows[0]["exponent_1"] = -0.5
    for i, nearest in ((6, 0), (7, 1)):  # a fixed point above the first, a cycle above the second
        assert rows[i]["class"] == rows[nearest]["class"]
        rows[i] |= {"computed": "no", "exponent_1": math.nan}
    figure = atlas.draw(rows, [], [], {})
    assert "12 points, 10 computed, 1 undecided, 1 failed" in title_of(figure.axes[0])
    values = figure.axes[1].collections[0].get_array().ravel()
    assert (values[6], values[7]) == (-0.5, -0.01)


@pytest.fixture
def cycles_drawn() -> Figure:
    return cycles.draw([followed_cycles("tau"), followed_cycles("epsilon")], [], [[], []], {})


def labelled(axes: Axes, label: str) -> list[Line2D]:
    return [line for line in axes.lines if line.get_label() == label]


def test_branches_change_their_line_at_special_points(cycles_drawn):
    """Each part ends at the point where its number of unstable multipliers changes."""
    parts = [
        (line.get_color(), [tuple(point) for point in line.get_xydata()])
        for line in cycles_drawn.axes[0].lines
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


def test_special_points_have_markers_by_kind(cycles_drawn):
    expected = {
        "fold": ("fold", [[0.45, 2.2]]),
        "torus bifurcation": ("torus", [[0.3, 3.0]]),
        "period doubling": ("period_doubling", [[0.7, 2.1], [0.7, 2.6]]),
    }
    for axes in cycles_drawn.axes:
        for label, (kind, places) in expected.items():
            (points,) = labelled(axes, label)
            assert points.get_marker() == STYLES[kind][0]
            assert points.get_xydata().tolist() == places
        (hopf,) = labelled(axes, "Hopf point")
        assert hopf.get_xydata().tolist() == [[0.1, 1.0]]


def test_sweeps_and_planes_of_lines_are_found_by_their_parameters(filled_config):
    """Sweeps of routes with the same law, parameter and fixed values; planes of the same ones."""
    config = copy.deepcopy(filled_config)
    law = {"law": "slip_delayed_logarithm"}
    at = {"along": "tau", "epsilon": 0.7, "xi": 0.5, "gamma": 0.8, **law}
    config["cycles"]["lines"] = {
        "mine": at,
        "beside": {**at, "xi": 0.6},
        "faster": {**at, "gamma": 0.9},
        "ageing": {**at, "law": "ageing_delayed_velocity"},
        "across": {"along": "epsilon", "tau": 7.0, "xi": 0.5, "gamma": 0.8, **law},
        "in_xi": {"along": "xi", "tau": 7.0, "epsilon": 0.9, "gamma": 0.8, **law},
    }
    config["routes"]["lines"]["part"] = {**at, "window": [5.8, 6.1]}
    folder = "<results>/attractors/routes"
    assert paths.sweeps_on_lines(config) == {
        "mine": [f"{folder}/chaos_in_tau/up.nc", f"{folder}/chaos_in_tau/down.nc"],
        "beside": [],
        "faster": [],
        "ageing": [],
        "across": [f"{folder}/chaos_in_epsilon/up.nc", f"{folder}/chaos_in_epsilon/down.nc"],
        "in_xi": [],
    }
    expected = [f"<results>/cycles/{line}.nc" for line in ("mine", "across")]
    assert paths.cycles_in_atlas(config) == expected
