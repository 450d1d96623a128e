"""The figure of the atlas, from small made-up results."""

import math

import numpy as np
import pytest
from figure_contents import title_of, words_in
from made_up_results import LINES, attractor_row
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection, QuadMesh
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from scripts.drawing import class_map
from scripts.drawing.style import STYLE
from scripts.studies.atlas import figure as atlas
from scripts.studies.atlas.plan import inputs
from scripts.tables.motion_rows import COLOURS


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


def test_curves_and_cycles_in_planes_are_found_by_their_parameters(own_config):
    """Those with the same law and fixed values as a plane."""
    own_config["cycles"]["lines"] = LINES
    expected = [f"<results>/cycles/{line}.nc" for line in ("mine", "across")]
    assert inputs(own_config)["cycles"] == expected
