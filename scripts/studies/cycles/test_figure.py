"""The figure of cycles, and the sweeps on their lines, from small made-up results."""

import pytest
from figure_contents import title_of
from made_up_results import LINES, followed_cycles, of_other_model
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing.special_points import STYLES
from scripts.drawing.style import STYLE
from scripts.studies.cycles import figure as cycles
from scripts.studies.cycles.branches import branch_of
from scripts.studies.cycles.plan import sweeps_on_lines

STABLE, ONE, TWO, MANY = (style["color"] for style in cycles.LINES)


@pytest.fixture(autouse=True)
def _style():
    """That of all figures, and none is left open."""
    with plt.style.context(STYLE):
        yield
    plt.close("all")


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
    x, y, unstable = branch_of(found, 1)
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


def test_cycles_of_a_model_that_is_not_the_block():
    """Neither steady sliding nor Hopf points at v = 1 are drawn."""
    (axes,) = cycles.draw([of_other_model(followed_cycles("epsilon"))], [], [[]], {}).axes
    labels = {str(line.get_label()) for line in axes.lines}
    assert not labels & {"steady sliding", "Hopf point"}
    assert {"fold", "torus bifurcation", "period doubling"} <= labels
    assert (axes.get_xlabel(), axes.get_ylabel()) == (r"$\beta$", "maxima of $y$")
    words = r"$\tau = 10$, model mackey glass (n = 10): 2 branches, 4 special points"
    assert title_of(axes).endswith(words)


def test_sweeps_on_lines_are_found_by_their_parameters(own_config):
    """Those of routes with the same law, parameter and fixed values."""
    config = own_config
    config["cycles"]["lines"] = LINES
    config["routes"]["lines"]["part"] = {**LINES["mine"], "window": [5.8, 6.1]}
    folder = "<results>/attractors/routes"
    mine, *others, across, in_xi = sweeps_on_lines(config)
    assert mine == [f"{folder}/chaos_in_tau/up.nc", f"{folder}/chaos_in_tau/down.nc"]
    assert across == [f"{folder}/chaos_in_epsilon/up.nc", f"{folder}/chaos_in_epsilon/down.nc"]
    assert [*others, in_xi] == [[]] * 4
