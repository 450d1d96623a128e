"""The paper's figures on the smoke run: what each holds, and that it fits its page."""

import functools

import numpy as np
import pytest
import xarray as xr
from figure_contents import assert_on_page, hyphens_before_numbers, words_in
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text

from scripts.drawing.make_figure import call, contents_of, drawing_of
from scripts.drawing.style import STYLE, break_titles
from scripts.plans import studies
from scripts.plans.declare import MAIN

FIGURES = studies.paper_figures()
PLANES = {"figure_2": "tau_of_epsilon", "figure_3": "xi_of_epsilon"}


@pytest.fixture(scope="module")
def drawn(smoke, smoke_config):
    """Each figure of the smoke run by its name, drawn once."""

    def read(paths):
        if isinstance(paths, list):
            return [read(path) for path in paths]
        return contents_of(smoke.folder / paths.replace("<results>", "results"))

    @functools.cache
    def draw(name: str) -> Figure:
        one = FIGURES[name]
        inputs = {key: read(paths) for key, paths in one.inputs_of(smoke_config).items()}
        figure = call(drawing_of(one.drawing).draw, one.params_of(smoke_config) | inputs)
        break_titles(figure)
        figure.canvas.draw()
        plt.close(figure)
        return figure

    with plt.style.context(STYLE):
        yield draw


def has_labels(axes: Axes) -> bool:
    """Whether it says what its two axes are, itself or through those it shares."""
    below = any(other.get_xlabel() for other in axes.get_shared_x_axes().get_siblings(axes))
    beside = any(other.get_ylabel() for other in axes.get_shared_y_axes().get_siblings(axes))
    return below or beside if axes.get_label() == "<colorbar>" else below and beside


@pytest.mark.parametrize("name", FIGURES)
def test_figure_can_be_read(drawn, name):
    """All is on its page. Every `$` has its partner, no key stands for a symbol, and minus signs
    are no hyphens. Axes of the paper's figures have labels."""
    figure = drawn(name)
    if FIGURES[name].category == MAIN and name != "figure_1":
        assert [axes for axes in figure.axes if not has_labels(axes)] == []
    assert_on_page(figure)
    for text in figure.findobj(Text):
        assert text.get_text().count("$") % 2 == 0
        assert "_" not in "".join(text.get_text().split("$")[::2])
    assert hyphens_before_numbers(figure) == []


@pytest.mark.parametrize(("name", "plane"), PLANES.items())
def test_curves_have_all_branches_and_kinds_of_bifurcations(drawn, smoke, name, plane):
    """A label for each branch; dashes and marks over the number of unstable roots."""
    figure = drawn(name)
    words = words_in(figure)
    curves = xr.load_dataset(smoke.folder / "results" / "hopf" / f"{plane}.nc")
    kinds = ("supercritical", "subcritical", "generalised Hopf point", "double Hopf point")
    for word in (*kinds, "unstable roots", *(f"$k$ = {k}" for k in np.unique(curves.branch))):
        assert word in words
    assert {"-", "--"} <= {line.get_linestyle() for line in figure.axes[0].lines}
