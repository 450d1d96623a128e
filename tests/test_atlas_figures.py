"""Figures of the atlas, of routes and of cycles, from small made-up results."""

import math

import numpy as np
import pytest
import xarray as xr
from figure_contents import assert_on_page, points_in, title_of, words_in
from made_up_results import attractor_row, followed_cycles, hopf_curve
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection, QuadMesh
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing import class_map
from scripts.drawing.special_points import STYLES
from scripts.drawing.style import STYLE
from scripts.figures import atlas, cycles, routes
from scripts.results import paths
from scripts.tables.motion_rows import COLOURS

PLACES = {
    "first": {"epsilon": 0.35, "tau": 10.0, "xi": 0.8, "gamma": 0.8},
    "at_zero": {"epsilon": 0.3, "tau": 0.0, "xi": 0.8, "gamma": 0.8},
    "first_neighbour": {"epsilon": 0.5, "tau": 10.0, "xi": 0.8, "gamma": 0.8},
    "elsewhere": {"epsilon": 0.7, "tau": 7.0, "xi": 0.5, "gamma": 0.8},
}
STABLE, ONE, TWO, MANY = (style["color"] for style in cycles.LINES)


@pytest.fixture(autouse=True)
def _style():
    """That of all figures, and none is left open."""
    with plt.style.context(STYLE):
        yield
    plt.close("all")


def a_row(met: str, epsilon: float, tau: float = 7.0, xi: float = 0.5, **given) -> dict:
    """A row of the atlas or a route."""
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


def curves_at(xi: float) -> xr.Dataset:
    """A Hopf curve that changes its kind."""
    curve = hopf_curve(xi=xi)
    size = curve.sizes["point"]
    l1 = np.where(np.arange(size) < size // 2, -0.1, 0.1)
    return curve.assign(piece=("point", np.zeros(size, int)), l1=("point", l1))


def crosses_in(axes: Axes) -> list[list[float]]:
    """Places of failed runs."""
    return [line.get_xydata()[0].tolist() for line in axes.lines if line.get_marker() == "x"]


@pytest.fixture
def atlas_drawn() -> Figure:
    """The atlas of two planes."""
    rows = grid_of(0.8) + grid_of(0.5)
    figure = atlas.draw(rows, [curves_at(0.5), curves_at(0.8)], [], PLACES)
    figure.canvas.draw()
    return figure


def test_atlas_has_a_row_for_each_plane(atlas_drawn):
    """Smaller xi first, with counts; beside each its exponents."""
    assert_on_page(atlas_drawn)
    titles = [title_of(axes) for axes in atlas_drawn.axes[:4]]
    assert r"$\xi = 0.5$" in titles[0]
    assert r"$\xi = 0.8$" in titles[2]
    assert "12 points, 1 undecided, 1 failed" in titles[0]
    assert all("largest Lyapunov exponent" in title for title in titles[1::2])


def test_cells_have_the_colours_of_their_classes(atlas_drawn):
    """Around the points, cut at the window."""
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


def test_exponents_have_one_colour_scale(atlas_drawn):
    """White at zero, symmetric, blank where there is none."""
    for mesh in (atlas_drawn.axes[i].collections[0] for i in (1, 3)):
        assert (mesh.norm.vmin, mesh.norm.vmax) == (-atlas.LARGEST, atlas.LARGEST)
        assert min(mesh.cmap(mesh.norm(0.0))[:3]) > 0.9
        values = np.ma.filled(mesh.get_array(), np.nan).ravel()
        np.testing.assert_allclose(values, [-0.01] * 11 + [np.nan])


def test_points_not_computed_have_the_exponent_of_the_nearest_of_their_kind():
    """And their own class; the title counts both."""
    rows = grid_of(0.5)
    rows[0]["exponent_1"] = -0.5
    for i, nearest in ((6, 0), (7, 1)):  # a fixed point above the first, a cycle above the second
        assert rows[i]["class"] == rows[nearest]["class"]
        rows[i] |= {"computed": "no", "exponent_1": math.nan}
    figure = atlas.draw(rows, [], [], {})
    assert "12 points, 10 computed, 1 undecided, 1 failed" in title_of(figure.axes[0])
    values = figure.axes[1].collections[0].get_array().ravel()
    assert (values[6], values[7]) == (-0.5, -0.01)


def test_scenes_stand_in_their_own_plane(atlas_drawn):
    """Named in the map of classes only, names apart; curves are dashed where subcritical."""
    axes = atlas_drawn.axes[:4]
    there = [{(x, y) for x, y, _ in points_in(panel)} for panel in axes]
    assert there[0] == there[1] == {(0.7, 7.0)}
    assert there[2] == there[3] == {(0.35, 10.0), (0.3, 0.0), (0.5, 10.0)}
    names = [{text.get_text() for text in panel.texts} for panel in axes]
    assert names == [{"elsewhere"}, set(), {"first", "at zero", "first neighbour"}, set()]
    boxes = [text.get_window_extent() for text in axes[2].texts]
    assert not any(one.overlaps(other) for one in boxes for other in boxes if one is not other)
    styles = {line.get_linestyle() for line in axes[2].lines if line.get_marker() == "None"}
    assert styles == {"-", "--"}


def curves_over(axes: Axes) -> list[tuple[str, list[list[float]]]]:
    """Colours and points of the curves of cycles."""
    colours = {colour for _, colour in STYLES.values()}
    lines = [line for line in axes.lines if line.get_color() in colours]
    return [(line.get_color(), line.get_xydata().tolist()) for line in lines]


def test_curves_of_cycles_lie_over_the_classes_of_their_plane(atlas_drawn):
    """A line for each, by kind, not over the exponents; the legend names the kinds drawn."""
    followed = [followed_cycles(xi=0.8), followed_cycles(xi=0.8, gamma=1e8)]
    figure = atlas.draw(grid_of(0.5) + grid_of(0.8), [curves_at(0.8)], followed, {})
    assert_on_page(figure)
    assert [curves_over(axes) for axes in figure.axes[:4]] == [
        *([], []),
        [
            (STYLES["fold"][1], [[0.2, 1.0], [0.4, 2.0], [0.4, 3.0], [0.2, 4.0]]),
            (STYLES["torus"][1], [[0.6, 12.0], [1.0, 13.0]]),
        ],
        [],
    ]
    (legend,) = figure.legends
    named = {line.get_label(): line.get_color() for line in legend.get_lines()}
    assert named["fold of a cycle"] == STYLES["fold"][1]
    assert named["torus bifurcation of a cycle"] == STYLES["torus"][1]
    assert "period doubling of a cycle" not in named
    assert "of a cycle" not in words_in(atlas_drawn)


def test_cells_are_seen_beside_curves_of_cycles():
    """The curves are thin and leave the window as it is."""
    followed = followed_cycles(xi=0.8)
    followed = followed.assign(curve_tau=2 * followed.curve_tau)
    plain, drawn = (atlas.draw(grid_of(0.8), [], lines, {}).axes[0] for lines in ([], [followed]))
    assert (drawn.get_xlim(), drawn.get_ylim()) == (plain.get_xlim(), plain.get_ylim())
    assert {line.get_linewidth() for line in drawn.lines if line.get_marker() == "None"} == {0.9}


def a_route(along: str, places: list[float], maxima: list, **classes: list[str]):
    """The table and the runs of a route, given the classes of each run."""
    rows = [
        a_row(met, **{"epsilon": 0.5, "tau": 7.0, "theta": 0.0, "u": 0.0, "v": 1.0, along: place})
        | {"run": run}
        for run, of_run in classes.items()
        for met, place in zip(of_run, places, strict=True)
    ]
    varied = along if along in ("epsilon", "tau") else f"history_{along}"
    data = {varied: ("point", places), "maximum": (("point", "kept"), np.array(maxima))}
    return rows, [xr.Dataset(data) for _ in classes]


@pytest.fixture
def routes_drawn() -> Figure:
    """Two routes with two runs each: one along epsilon, one along tau, which has a scene on it."""
    maxima = [[1.0, np.nan], [2.0, 2.5], [3.0, 3.5], [4.0, 4.5]]
    near = ["cycle", "undecided", "torus", "chaos"]
    up = ["cycle", "torus", "torus", "chaos"]
    made = [
        a_route(along, [0.1, 0.2, 0.3, 0.4], maxima, near=near, up=up)
        for along in ("epsilon", "tau")
    ]
    made[0][0][3] |= {"problem": "it stopped", "class": "undecided"}
    scene = {"tau": 0.2, "epsilon": 0.5, "xi": 0.5, "gamma": 0.8}
    scenes = {"on_it": scene, "elsewhere": {**scene, "xi": 0.8}}
    tables, runs = zip(*made, strict=True)
    return routes.draw(list(tables), [*runs[0], *runs[1]], scenes)


def test_routes_show_maxima_classes_and_exponents(routes_drawn):
    """A panel each, one below the other, named by the parameter that varies."""
    assert_on_page(routes_drawn)
    above, strips, below = routes_drawn.axes[:3]
    shown = np.array([point for line in above.lines for point in line.get_xydata()])
    np.testing.assert_allclose(np.unique(shown[:, 1]), [1, 2, 2.5, 3, 3.5, 4, 4.5])
    title = title_of(above)
    assert r"$\tau = 7$, $\xi = 0.5$, $\gamma = 0.8$: 8 points, 1 undecided, 1 failed" in title
    assert below.get_xlabel() == r"sensitivity of the velocity relaxation $\varepsilon$"
    assert routes_drawn.axes[5].get_xlabel() == r"delay $\tau$ (units of $L/v_0$)"
    assert [text.get_text() for text in strips.get_yticklabels()] == ["near", "up"]
    meshes = [item for item in strips.collections if isinstance(item, QuadMesh)]
    expected = [COLOURS[name] for name in ("cycle", "torus", "torus", "chaos")]
    colours = meshes[1].get_facecolors().reshape(-1, 4)
    np.testing.assert_allclose(colours, [to_rgba(colour) for colour in expected])
    assert crosses_in(strips) == [[0.4, 0]]
    assert len(below.containers) == 2


def test_runs_of_a_route_do_not_cover_each_other(routes_drawn):
    """Dots stand at their places; those of the later run are smaller and on top."""
    for axes in (routes_drawn.axes[0], routes_drawn.axes[2]):
        near, up = (line for line in axes.lines if line.get_marker() == "o")
        assert set(near.get_xdata()) == set(up.get_xdata()) == {0.1, 0.2, 0.3, 0.4}
        assert near.get_markersize() > up.get_markersize()
        assert axes.lines.index(near) < axes.lines.index(up)


def test_axes_of_a_route_are_read_right(routes_drawn):
    """Exponents have a linear axis; maxima a logarithmic one where they span more than 100."""
    assert {routes_drawn.axes[i].get_yscale() for i in (0, 2)} == {"linear"}
    rows, runs = a_route("epsilon", [0.1, 0.2], [[0.05, 1.0], [8.0, 2.0]], near=["chaos"] * 2)
    above, _, below = routes.draw([rows], runs, {}).axes
    assert (above.get_yscale(), below.get_yscale()) == ("log", "linear")
    assert above.get_ylim()[0] < 0.05 < 8.0 < 0.9 * above.get_ylim()[1]


def test_route_along_the_history():
    """All dots are within the axes; a fixed point is at v = 1, without its transient maxima."""
    classes = {"near": ["fixed point"] * 3, "slip": ["cycle"] * 3}
    rows, runs = a_route("v", [0.5, 1.5, 2.5], [[2.0, 2.001]] * 3, **classes)
    figure = routes.draw([rows], runs, PLACES)
    assert_on_page(figure)
    above = figure.axes[0]
    assert title_of(above).startswith(r"$\tau = 7$, $\varepsilon = 0.5$")
    near, slip = (line.get_xydata() for line in above.lines)
    np.testing.assert_allclose(near, [[0.5, 1], [1.5, 1], [2.5, 1]])
    assert {y for _, y in slip} == {2.0, 2.001}
    (left, right), (bottom, top) = above.get_xlim(), above.get_ylim()
    for points in (near, slip):
        assert np.all((points > [left, bottom]) & (points < [right, 0.9 * top]))
    assert figure.axes[2].get_xlabel() == "velocity before the start $v$"


def a_sweep(*maxima: float) -> xr.Dataset:
    """A sweep with two places kept, the second without a maximum but one."""
    kept = np.array([maxima, [maxima[0], np.nan]])
    return xr.Dataset({"tau": ("point", [0.2, 0.4]), "maximum": (("point", "kept"), kept)})


@pytest.fixture
def cycles_drawn() -> Figure:
    """Two lines, one along tau with two sweeps, one along epsilon without."""
    lines = [followed_cycles("tau"), followed_cycles("epsilon")]
    sweeps = [a_sweep(1.5, 1.25), a_sweep(3.5, 3.25)]
    scene = {"tau": 0.3, "epsilon": 0.5, "xi": 0.8, "gamma": 0.8}
    scenes = {"on_it": scene, "elsewhere": {**scene, "xi": 0.5}}
    figure = cycles.draw(lines, sweeps, [["up", "down"], []], scenes)
    figure.canvas.draw()
    return figure


def labelled(axes: Axes, label: str) -> list[Line2D]:
    """What is drawn under a name of the legend."""
    return [line for line in axes.lines if line.get_label() == label]


def test_each_line_of_cycles_has_a_panel(cycles_drawn):
    """Its title has what is fixed and the counts, its axes name what varies, with units."""
    assert_on_page(cycles_drawn)
    in_tau, in_epsilon = cycles_drawn.axes
    assert r"$\varepsilon = 0.5$, $\xi = 0.8$, $\gamma = 0.8$: 2 branches, 4 special points" in (
        title_of(in_tau)
    )
    assert r"$\tau = 10$, $\xi = 0.8$" in title_of(in_epsilon)
    assert in_tau.get_xlabel() == r"delay $\tau$ (units of $L/v_0$)"
    assert in_epsilon.get_xlabel() == r"sensitivity of the velocity relaxation $\varepsilon$"
    assert {axes.get_ylabel() for axes in cycles_drawn.axes} == {"maxima of $v$ (units of $v_0$)"}


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


def test_a_branch_of_one_orbit_has_no_line():
    """The other branch is drawn as before."""
    found = followed_cycles().isel(orbit=[5, 6, 7, 8, 9])
    (axes,) = cycles.draw([found], [], [[]], {}).axes
    assert labelled(axes, "2 unstable multipliers") == []
    assert len(labelled(axes, "stable cycle")) == 2


def test_special_points_have_markers_by_kind(cycles_drawn):
    """At their places; Hopf points stand on steady sliding."""
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


def test_marks_of_a_branch_that_is_smaller_than_they_are_left_out():
    """They would hide it and stand alone; the line is drawn, and so are other marks."""
    lines = followed_cycles("tau")
    closed, points = lines.branch.values == 2, lines.special_branch.values == 2
    for name, there in (("tau", closed), ("special_tau", points)):
        lines[name][there] = 0.7 + 1e-3 * (lines[name][there] - 0.7)
    (axes,) = cycles.draw([lines], [], [[]], {}).axes
    assert labelled(axes, "period doubling") == []
    assert len(labelled(axes, "fold")) == len(labelled(axes, "torus bifurcation")) == 1
    assert len(labelled(axes, "stable cycle")) == 2


def test_sweeps_are_dots_at_all_maxima(cycles_drawn):
    """Above thick stable cycles, below unstable ones; those of the second sweep are smaller."""
    in_tau, in_epsilon = cycles_drawn.axes
    (up,), (down,) = (labelled(in_tau, f"sweep {run}") for run in ("up", "down"))
    assert up.get_xydata().tolist() == [[0.2, 1.5], [0.2, 1.25], [0.4, 1.5]]
    assert down.get_xydata().tolist() == [[0.2, 3.5], [0.2, 3.25], [0.4, 3.5]]
    assert up.get_markersize() > down.get_markersize()
    assert labelled(in_epsilon, "sweep up") == labelled(in_epsilon, "sweep down") == []
    (stable, *_), (unstable, *_) = (
        labelled(in_tau, label) for label in ("stable cycle", "1 unstable multiplier")
    )
    assert stable.get_linewidth() > 2 * unstable.get_linewidth()
    assert stable.get_zorder() < up.get_zorder() < unstable.get_zorder()


def test_legend_of_cycles_names_what_is_drawn(cycles_drawn):
    """In a fixed order, each once; kinds that are nowhere are not named."""
    (legend,) = cycles_drawn.legends
    assert [text.get_text() for text in legend.get_texts()] == [
        *("stable cycle", "1 unstable multiplier", "2 unstable multipliers"),
        *("3 or more unstable multipliers", "sweep up", "sweep down"),
        *("steady sliding", "Hopf point", "fold", "period doubling", "torus bifurcation"),
    ]
    words = words_in(cycles.draw([followed_cycles().isel(special=[], hopf=[])], [], [[]], {}))
    assert not any(name in words for name in ("sweep", "Hopf point", "fold", "torus bifurcation"))
    assert "2 branches, 0 special points" in words


def test_scenes_on_a_line_are_named(routes_drawn, cycles_drawn):
    """Those with the values of the fixed parameters."""
    names = [
        [[text.get_text() for text in axes.texts] for axes in figure.axes]
        for figure in (routes_drawn, cycles_drawn)
    ]
    assert names == [[[], [], [], ["on it"], [], []], [["on it"], []]]


def test_sweeps_and_planes_of_lines_are_found_by_their_parameters(config):
    """Sweeps of routes with the same parameter and fixed values; planes of the same gamma, xi."""
    at = {"along": "tau", "epsilon": 0.7, "xi": 0.5, "gamma": 0.8}
    config["cycles"]["lines"] = {
        "mine": at,
        "beside": {**at, "xi": 0.6},
        "faster": {**at, "gamma": 0.9},
        "across": {"along": "epsilon", "tau": 7.0, "xi": 0.5, "gamma": 0.8},
        "in_xi": {"along": "xi", "tau": 7.0, "epsilon": 0.9, "gamma": 0.8},
    }
    folder = "<results>/attractors/routes"
    assert paths.sweeps_on_lines(config) == {
        "mine": [f"{folder}/chaos_in_tau/up.nc", f"{folder}/chaos_in_tau/down.nc"],
        "beside": [],
        "faster": [],
        "across": [f"{folder}/chaos_in_epsilon/up.nc", f"{folder}/chaos_in_epsilon/down.nc"],
        "in_xi": [],
    }
    expected = [f"<results>/cycles/{line}.nc" for line in ("mine", "across")]
    assert paths.cycles_in_atlas(config) == expected
