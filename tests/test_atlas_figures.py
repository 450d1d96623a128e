"""Figures of the atlas, of the true torus and of routes, from small made-up tables."""

import math

import numpy as np
import pytest
import xarray as xr
from config_refusals import line_about, refusal
from figure_contents import assert_on_page, points_in, title_of, words_in
from made_up_results import attractor_row, followed_cycles, hopf_curve
from matplotlib import pyplot as plt
from matplotlib.collections import PatchCollection, QuadMesh
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from scripts.drawing import class_map
from scripts.drawing.special_points import STYLES
from scripts.drawing.spectrum_rows import BASE, COMBINATION, HARMONIC, SECOND_BASE
from scripts.drawing.style import STYLE
from scripts.figures import atlas, routes, true_torus
from scripts.tables.motion_rows import COLOURS

PLACES = {
    "first": {"epsilon": 0.35, "tau": 10.0, "xi": 0.8, "gamma": 0.8},
    "at_zero": {"epsilon": 0.3, "tau": 0.0, "xi": 0.8, "gamma": 0.8},
    "first_neighbour": {"epsilon": 0.5, "tau": 10.0, "xi": 0.8, "gamma": 0.8},
    "elsewhere": {"epsilon": 0.7, "tau": 7.0, "xi": 0.5, "gamma": 0.8},
}


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


@pytest.fixture
def drawn() -> Figure:
    """The atlas of two planes."""
    rows = grid_of(0.8) + grid_of(0.5)
    figure = atlas.draw(rows, [curves_at(0.5), curves_at(0.8)], [], PLACES)
    figure.canvas.draw()
    return figure


def test_atlas_is_on_its_page(drawn):
    """Both planes."""
    assert_on_page(drawn)


def test_atlas_has_a_row_for_each_plane(drawn):
    """Smaller xi first, with counts; beside each its exponents."""
    titles = [title_of(axes) for axes in drawn.axes[:4]]
    assert r"$\xi = 0.5$" in titles[0]
    assert r"$\xi = 0.8$" in titles[2]
    assert "12 points, 1 undecided, 1 failed" in titles[0]
    assert all("largest Lyapunov exponent" in title for title in titles[1::2])
    assert r"\lambda_1" in words_in(drawn)


def test_planes_may_have_delays_of_their_own():
    """Each map ends where its points end."""
    later = [row | {"gamma": 1e8, "tau": row["tau"] + 1} for row in grid_of(0.5)]
    figure = atlas.draw(grid_of(0.5) + later, [], [], {})
    assert [axes.get_ylim() for axes in figure.axes[:4]] == [(0, 20)] * 2 + [(1, 21)] * 2


def test_cells_have_the_colours_of_their_classes(drawn):
    """Around the points, cut at the window."""
    (mesh,) = [item for item in drawn.axes[0].collections if isinstance(item, QuadMesh)]
    expected = [COLOURS[name] for name in ("fixed point", "cycle", "multi-loop cycle")]
    colours = mesh.get_facecolors().reshape(3, 4, 4)
    np.testing.assert_allclose(colours[0, :3], [to_rgba(colour) for colour in expected])
    np.testing.assert_allclose(mesh.get_coordinates()[0, :, 0], [0, 0.25, 0.75, 1.25, 1.5])
    np.testing.assert_allclose(mesh.get_coordinates()[:, 0, 1], [0, 5, 15, 20])


def test_undecided_cells_are_hatched_and_failures_crossed(drawn):
    """The failed one too is undecided; the legend names all that is there."""
    axes = drawn.axes[0]
    (hatched,) = [item for item in axes.collections if isinstance(item, PatchCollection)]
    corners = {tuple(path.vertices[0]) for path in hatched.get_paths()}
    assert corners == {(0.25, 5.0), (1.25, 15.0)}
    for panel in (axes, drawn.axes[1]):
        crosses = [line for line in panel.lines if line.get_marker() == "x"]
        assert [(line.get_xdata()[0], line.get_ydata()[0]) for line in crosses] == [(1.5, 20.0)]
    words = words_in(drawn)
    assert all(kind in words for kind in COLOURS)
    assert "run failed" in words


def test_legend_names_only_what_is_there():
    """No failure, no chaos."""
    handles = class_map.legend_of([a_row("cycle", 0.1), a_row("torus", 0.2)])
    assert [handle.get_label() for handle in handles] == ["cycle", "torus"]


def test_exponents_have_one_colour_scale(drawn):
    """White at zero, symmetric, blank where there is none."""
    meshes = [drawn.axes[i].collections[0] for i in (1, 3)]
    for mesh in meshes:
        assert (mesh.norm.vmin, mesh.norm.vmax) == (-atlas.LARGEST, atlas.LARGEST)
        middle = mesh.cmap(mesh.norm(0.0))
        assert min(middle[:3]) > 0.9
        values = np.ma.filled(mesh.get_array(), np.nan).ravel()
        assert np.isnan(values[11])
        np.testing.assert_allclose(values[:11], -0.01)


def test_points_not_computed_have_the_exponent_of_the_nearest_of_their_kind():
    """And their own class; the title counts both."""
    rows = grid_of(0.5)
    rows[0]["exponent_1"] = -0.5
    for i, nearest in ((6, 0), (7, 1)):  # a fixed point above the first, a cycle above the second
        assert rows[i]["class"] == rows[nearest]["class"]
    for i in (6, 7):
        rows[i] |= {"computed": "no", "exponent_1": math.nan}
    figure = atlas.draw(rows, [], [], {})
    assert "12 points, 10 computed, 1 undecided, 1 failed" in title_of(figure.axes[0])
    values = figure.axes[1].collections[0].get_array().ravel()
    assert (values[6], values[7]) == (-0.5, -0.01)


def test_scenes_stand_in_their_own_plane(drawn):
    """With a name in the map of classes only; curves are dashed where subcritical."""
    there = [{(x, y) for x, y, _ in points_in(axes)} for axes in drawn.axes[:4]]
    assert there[0] == there[1] == {(0.7, 7.0)}
    assert there[2] == there[3] == {(0.35, 10.0), (0.3, 0.0), (0.5, 10.0)}
    names = [{text.get_text() for text in axes.texts} for axes in drawn.axes[:4]]
    assert names == [{"elsewhere"}, set(), {"first", "at zero", "first neighbour"}, set()]
    styles = {line.get_linestyle() for line in drawn.axes[2].lines if line.get_marker() == "None"}
    assert styles == {"-", "--"}


def curves_over(axes) -> list[tuple[str, list[tuple[float, float]]]]:
    """Colours and points of the curves of cycles."""
    colours = {style.colour for style in STYLES.values()}
    lines = [line for line in axes.lines if line.get_color() in colours]
    return [(line.get_color(), [tuple(point) for point in line.get_xydata()]) for line in lines]


def test_curves_of_cycles_lie_over_the_classes_of_their_plane():
    """A line for each, by kind, not over the exponents; the legend names the kinds drawn."""
    cycles = [followed_cycles(xi=0.8), followed_cycles(xi=0.8, gamma=1e8)]
    figure = atlas.draw(grid_of(0.5) + grid_of(0.8), [curves_at(0.8)], cycles, {})
    assert_on_page(figure)
    assert [curves_over(axes) for axes in figure.axes[:4]] == [
        *([], []),
        [
            (STYLES["fold"].colour, [(0.2, 1.0), (0.4, 2.0), (0.4, 3.0), (0.2, 4.0)]),
            (STYLES["torus"].colour, [(0.6, 12.0), (1.0, 13.0)]),
        ],
        [],
    ]
    (legend,) = figure.legends
    named = {line.get_label(): line.get_color() for line in legend.get_lines()}
    assert named["fold of a cycle"] == STYLES["fold"].colour
    assert named["torus bifurcation of a cycle"] == STYLES["torus"].colour
    assert "period doubling of a cycle" not in named


def test_cells_are_seen_beside_curves_of_cycles():
    """The curves are thin and leave the window as it is."""
    cycles = followed_cycles(xi=0.8)
    cycles = cycles.assign(curve_tau=2 * cycles.curve_tau)
    plain, drawn = (atlas.draw(grid_of(0.8), [], lines, {}).axes[0] for lines in ([], [cycles]))
    assert (drawn.get_xlim(), drawn.get_ylim()) == (plain.get_xlim(), plain.get_ylim())
    assert {line.get_linewidth() for line in drawn.lines if line.get_marker() == "None"} == {0.9}


def test_an_atlas_without_curves_of_cycles_names_none(drawn):
    """Nothing is drawn, nothing named."""
    assert all(curves_over(axes) == [] for axes in drawn.axes[:4])
    assert "of a cycle" not in words_in(drawn)


def test_names_of_scenes_keep_clear_of_each_other(drawn):
    """The one with a neighbour at its right stands above its dot."""
    texts = {text.get_text(): text for text in drawn.axes[2].texts}
    boxes = [texts[name].get_window_extent() for name in ("first", "first neighbour", "at zero")]
    assert not any(one.overlaps(other) for one in boxes for other in boxes if one is not other)


@pytest.fixture
def routes_drawn() -> Figure:
    """Two routes with two runs each: one along epsilon, one along tau, which has a scene on it."""
    rows, runs = [], {}
    for name, along in (("one", "epsilon"), ("other", "tau")):
        places = [0.1, 0.2, 0.3, 0.4]
        for run, classes in {
            "near": ["cycle", "undecided", "torus", "chaos"],
            "up": ["cycle", "torus", "torus", "chaos"],
        }.items():
            ends = {"epsilon": 0.5, "tau": 7.0}
            rows += [
                a_row(met, **{**ends, along: place}) | {"route": name, "run": run}
                for met, place in zip(classes, places, strict=True)
            ]
            maxima = np.array([[1.0, np.nan], [2.0, 2.5], [3.0, 3.5], [4.0, 4.5]])
            data = {along: ("point", places), "maximum": (("point", "kept"), maxima)}
            runs[name, run] = xr.Dataset(data)
    rows[3] |= {"problem": "it stopped", "class": "undecided"}
    scene = {"tau": 0.2, "epsilon": 0.5, "xi": 0.5, "gamma": 0.8}
    return routes.draw(rows, runs, {"on_it": scene, "elsewhere": {**scene, "xi": 0.8}})


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
    places = [0.1, 0.2]
    rows = [
        a_row("chaos", place, exponent_1=0.02, error_1=1e-3) | {"route": "one", "run": "near"}
        for place in places
    ]
    maxima = (("point", "kept"), [[0.05, 1.0], [8.0, 2.0]])
    runs = {("one", "near"): xr.Dataset({"epsilon": ("point", places), "maximum": maxima})}
    above, _, below = routes.draw(rows, runs, {}).axes
    assert (above.get_yscale(), below.get_yscale()) == ("log", "linear")
    assert above.get_ylim()[0] < 0.05 < 8.0 < 0.9 * above.get_ylim()[1]


def test_scenes_on_a_route_are_named(routes_drawn):
    """Those with the values of the other parameters."""
    texts = [[text.get_text() for text in axes.texts] for axes in routes_drawn.axes]
    assert texts == [[], [], [], ["on it"], [], []]


def test_route_along_the_history():
    """All dots are within the axes; a fixed point is at v = 1, without its transient maxima."""
    rows, runs = [], {}
    for run, met in (("near", "fixed point"), ("slip", "cycle")):
        places = [0.5, 1.5, 2.5]
        rows += [a_row(met, 0.5, 7.0) | {"theta": 0.0, "u": 0.0, "v": v} for v in places]
        maxima = (("point", "kept"), [[2.0, 2.001]] * 3)
        runs["in_v", run] = xr.Dataset({"history_v": ("point", places), "maximum": maxima})
        rows[-3:] = [row | {"route": "in_v", "run": run} for row in rows[-3:]]
    figure = routes.draw(rows, runs, PLACES)
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


def test_failed_points_of_a_route_are_crossed(routes_drawn):
    """In the strip of their run."""
    crosses = [line for line in routes_drawn.axes[1].lines if line.get_marker() == "x"]
    assert [(line.get_xdata()[0], line.get_ydata()[0]) for line in crosses] == [(0.4, 0)]


def a_scene(name: str, met: str) -> true_torus.Scene:
    """A made-up scene: one base or two."""
    angle = 2 * np.pi * 0.6180339887 * np.arange(50)
    size = 1.0 if met == "torus" else 0.0
    time = np.arange(0.0, 200.0, 0.1)
    trajectory = xr.Dataset(
        {"v": ("t", 1 + 0.5 * np.cos(time))},
        {"t": time},
        {"tau": 10.0, "epsilon": 0.5, "xi": 0.8, "gamma": 0.8},
    )
    attractors = xr.Dataset(
        {
            "maximum": (("point", "kept"), [3 + size * np.cos(angle), angle]),
            "section_theta": (("point", "kept"), [1 + size * np.cos(angle), angle]),
            "section_u": (("point", "kept"), [2 + size * np.sin(angle), angle]),
            "sign_bound": (("point", "exponent"), np.full((2, 6), 0.003)),
        },
    )
    frequency = np.linspace(0, 1, 401)
    two = met == "torus"
    spectrum = xr.Dataset(
        {
            "power": ("frequency", 1e-9 + np.exp(-(((frequency - 0.1) / 0.01) ** 2))),
            "peak_frequency": ("peak", [0.1, 0.26, 0.36]),
            "peak_power": ("peak", [1.0, 0.1, 0.01]),
            "peak_kind": ("peak", [BASE, SECOND_BASE if two else HARMONIC, COMBINATION]),
            "peak_multiple": ("peak", [1, 0 if two else 2, 1]),
            "peak_second_multiple": ("peak", [0, 1 if two else 0, 1]),
            "base_frequency": ("base", [0.1, 0.26] if two else [0.1]),
        },
        {"frequency": frequency},
        {"spectrum_kind": "quasiperiodic" if two else "periodic"},
    )
    errors = {"exponent_1": 1e-6, "error_1": 0.0, "exponent_2": 2e-3 if two else -0.04}
    row = attractor_row(met, name, **errors)
    return true_torus.Scene(
        trajectory=trajectory, attractors=attractors, spectrum=spectrum, row=row
    )


def test_true_torus_is_drawn_beside_the_papers():
    """Titles from the table; one section for both, so that a point looks like a point."""
    scenes = {"a": a_scene("torus", "cycle"), "b": a_scene("true_torus", "torus")}
    figure = true_torus.draw(scenes, 50.0, 0.5)
    assert_on_page(figure)
    of_a, _, of_b, _, section = figure.axes
    assert "scene torus: cycle, one zero exponent\n" in title_of(of_a)
    assert "scene true torus: torus, two zero exponents\n" in title_of(of_b)
    words = words_in(figure)
    assert "periodic, $f_1$ = 0.1000 and its harmonics" in words
    assert "quasiperiodic, $f_1$ = 0.1000 and $f_2$ = 0.2600" in words
    assert all(label in words for label in ("$f_1$", "$f_2$", "$f_1 + f_2$"))
    assert of_b.get_xlim() == pytest.approx((149.9, 199.9))
    point, curve = section.lines
    assert (np.ptp(point.get_xdata()), np.ptp(curve.get_xdata()) > 1.9) == (0, True)
    assert point.get_markersize() > curve.get_markersize()
    assert [text.get_text() for text in section.get_legend().get_texts()] == ["scene a", "scene b"]


def test_section_of_a_torus_closes():
    """50 points with a rotation number of the golden mean leave no gap of a 20th of the turn."""
    figure = true_torus.draw({"b": a_scene("true_torus", "torus")}, 50.0, 0.5)
    x, y = figure.axes[-1].lines[0].get_xydata().T
    # the next maximum is that of an angle later, so that both give the angle
    turn = 2 * np.pi * 0.6180339887
    angles = np.arctan2((np.cos(turn) * (x - 3) - (y - 3)) / np.sin(turn), x - 3)
    angles = np.sort(angles)
    assert max(np.diff(angles, append=angles[0] + 2 * np.pi)) < 2 * np.pi / 20


@pytest.mark.parametrize(
    ("value", "error", "words"),
    [
        (-0.014042, 3e-5, r"(−1.404 ± 0.003)$\times 10^{-2}$"),
        (1.2e-5, 2.1e-5, r"(1.2 ± 2.1)$\times 10^{-5}$"),
        (-1e-9, 6.5e-7, r"(0.0 ± 6.5)$\times 10^{-7}$"),
        (-1.77753, 0.0, "−1.78 ± 0.00"),
        (0.0, 0.0, "0"),
    ],
)
def test_numbers_have_the_digits_that_their_error_lets_count(value, error, words):
    """Of the same power of ten."""
    assert true_torus.with_error(value, error) == words


def test_scene_of_the_true_torus_needs_attractors(config):
    """The line names the row."""
    del config["scenes"]["torus"]["attractors"]
    line = line_about(refusal(config), "scene")
    assert line.startswith("config figures true_torus rows a: scene = 'torus'; expected ")


@pytest.mark.parametrize("survey", ["attractors", "routes"])
def test_figures_need_points_that_are_kept(config, survey):
    """The line names the key."""
    config[survey]["observation"]["kept"] = 0
    line = line_about(refusal(config), "kept")
    assert line == f"config {survey} observation: kept = 0; expected a whole number >= 1"
