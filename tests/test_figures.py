"""The paper's figures on the smoke run: what each holds, and that it fits its page."""

import functools

import numpy as np
import pytest
import xarray as xr
from figure_contents import assert_on_page, hyphens_before_numbers, points_in, title_of, words_in
from matplotlib import pyplot as plt
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Rectangle
from matplotlib.text import Text

from scripts.drawing.style import STYLE
from scripts.figures import registry
from scripts.figures.make_figure import call
from scripts.files.tsv import read_table

PLANES = {"figure_2": "tau_of_epsilon", "figure_3": "xi_of_epsilon"}


@pytest.fixture(scope="module")
def drawn(smoke, smoke_config):
    """Each figure of the smoke run by its name, drawn once."""

    def placed(paths):
        if isinstance(paths, list):
            return [placed(path) for path in paths]
        return str(smoke.folder / paths.replace("<results>", "results"))

    @functools.cache
    def draw(name: str) -> Figure:
        inputs = registry.inputs_of(name, smoke_config)
        inputs = {key: placed(paths) for key, paths in inputs.items()}
        params = registry.params_of(name, smoke_config)
        figure = call(registry.find(name).module.draw, inputs, params)
        figure.canvas.draw()
        plt.close(figure)
        return figure

    with plt.style.context(STYLE):
        yield draw


@pytest.fixture
def figure(drawn, request) -> Figure:
    """One of them."""
    return drawn(request.param)


def these(*names: str):
    """Run a test on these figures."""
    return pytest.mark.parametrize("figure", names, indirect=True)


# titles of the true torus are longer in smoke size; test_drawing.py has it on its page
@these(*(name for name in registry.FIGURES if name != "true_torus"))
def test_figure_fits_a_page(figure):
    """Printed at the size drawn: text, lines and legends end inside, letters can be read."""
    assert_on_page(figure)


@these(*registry.FIGURES[1:8])
def test_axes_are_labelled(figure):
    """Every axes with data says what its two axes are, itself or through those it shares."""
    for axes in figure.axes:
        if axes.get_label() == "<colorbar>":
            assert axes.get_ylabel()
            continue
        below = axes.get_shared_x_axes().get_siblings(axes)
        beside = axes.get_shared_y_axes().get_siblings(axes)
        assert any(other.get_xlabel() for other in below)
        assert any(other.get_ylabel() for other in beside)


@these(*registry.FIGURES)
def test_no_formula_is_left_as_source(figure):
    """Every `$` has its partner, no key stands for a symbol, and minus signs are no hyphens."""
    for text in figure.findobj(Text):
        assert text.get_text().count("$") % 2 == 0
        assert "_" not in "".join(text.get_text().split("$")[::2])
    assert hyphens_before_numbers(figure) == []


@these("figure_1")
def test_figure_1_pulls_the_block(figure):
    """The spring is in front of it, where plate and block move to; every part is named."""
    (axes,) = figure.axes
    assert not axes.axison
    for part in ("block", "spring", "loader plate", "rough surface", "v_0", "friction"):
        assert part in words_in(figure)
    block, _ = (part for part in axes.patches if isinstance(part, Rectangle))
    _, arm, spring = axes.lines
    front = block.get_x() + block.get_width()
    assert spring.get_xdata()[[0, -1]] == pytest.approx([front, arm.get_xdata()[0]])
    assert front < arm.get_xdata()[0]
    arrows = (part for part in axes.patches if isinstance(part, FancyArrowPatch))
    plate, block, friction = (np.diff(arrow.get_path().vertices[:2, 0]) for arrow in arrows)
    assert friction < 0 < min(plate, block)


@pytest.mark.parametrize(("figure", "plane"), PLANES.items(), indirect=["figure"])
def test_curves_have_all_branches_and_kinds_of_bifurcations(figure, plane, smoke):
    """A label for each branch; dashes and marks over the number of unstable pairs."""
    words = words_in(figure)
    curves = xr.load_dataset(smoke.folder / "results" / "hopf" / f"{plane}.nc")
    for branch in np.unique(curves.branch):
        assert f"$k$ = {branch}" in words
    for word in ("supercritical", "subcritical", "generalised Hopf point", "double Hopf point"):
        assert word in words
    assert "unstable pairs" in words
    assert {"-", "--"} <= {line.get_linestyle() for line in figure.axes[0].lines}


@pytest.mark.parametrize(
    ("figure", "scenes"),
    [("figure_2", {(0.7, 7.0)}), ("figure_3", set())],
    indirect=["figure"],
)
def test_scenes_stand_in_their_own_plane_only(figure, scenes):
    """Only chaos has xi = 0.5, and none has tau = 12: elsewhere they lie in a wrong region."""
    assert {(x, y) for x, y, _ in points_in(figure.axes[0])} == scenes
    words = words_in(figure)
    assert ("chaos" in words) == ("scene" in words) == bool(scenes)
    assert not any(name in words for name in ("torus", "fixed point", "oscillation"))


@these("figure_4", "figure_5")
def test_rows_show_velocity_twice_and_portrait(figure):
    """Two rows of three panels, lettered, with parameters."""
    assert len(figure.axes) == 6
    for row, letter in zip((figure.axes[:3], figure.axes[3:]), "ab", strict=True):
        assert [axes.get_xlabel() for axes in row[:2]] == ["time $t$", "time $t$"]
        assert row[0].get_ylabel() == "velocity $v$"
        assert (row[2].get_xlabel(), row[2].get_ylabel()) == ("displacement $u$", "velocity $v$")
        title = title_of(row[0])
        assert f"{{{letter}}}" in title
        assert "\nfrom the start" in title
        assert [title_of(axes) for axes in row[1:]] == ["at the end", "phase portrait"]
        assert all(symbol in title for symbol in (r"\tau", r"\varepsilon", r"\xi", r"\gamma"))
    assert {"transient", "attractor"} <= set(words_in(figure).split("\n"))


@pytest.mark.parametrize(
    ("figure", "words"),
    [
        ("figure_4", {"fixed_point": "fixed point", "oscillation": "oscillations"}),
        ("figure_5", {"torus": "torus", "chaos": "chaos"}),
        ("figure_6", {"oscillation": "single peak", "torus": "two peaks"}),
        ("figure_7", {"chaos": "broadband noise"}),
    ],
    indirect=["figure"],
)
def test_titles_hold_the_papers_words_and_the_class_found(figure, words, smoke):
    """Of trajectories the class from the scene's own history."""
    titles = [title_of(axes) for axes in figure.axes if "\n" in title_of(axes)]
    rows = read_table(smoke.folder / "results/tables/attractors.tsv")
    for title, (scene, paper) in zip(titles, words.items(), strict=True):
        assert f"the paper: “{paper}”; here: " in title
        (met,) = [r["class"] for r in rows if (r["scene"], r["history"]) == (scene, 1)]
        found = "limit cycle" if met == "cycle" else met
        assert "scene" in title or f"; here: {found}\n" in title


@these("figure_6", "figure_7")
def test_spectra_are_shown_on_both_scales(figure):
    """The same frequencies and powers; all rows have the same logarithmic axes."""
    logarithmic, linear = figure.axes[::2], figure.axes[1::2]
    assert {axes.get_yscale() for axes in logarithmic} == {"log"}
    assert {axes.get_yscale() for axes in linear} == {"linear"}
    assert len({axes.get_ylim() for axes in logarithmic}) == 1
    assert len({axes.get_xlim() for axes in figure.axes}) == 1
    assert figure.axes[0].get_xlim()[0] == 0
    for one, other in zip(logarithmic, linear, strict=True):
        np.testing.assert_array_equal(one.lines[0].get_xydata(), other.lines[0].get_xydata())


@these("figure_8")
def test_figure_8_marks_both_effects_of_both_steps(figure):
    """Up-step and down-step, and Dc."""
    words = words_in(figure).replace("\n", " ")
    assert words.count("direct effect") == 2
    assert words.count("evolution effect") == 2
    assert "$D_c$" in words
    assert r"\Delta v" in words
