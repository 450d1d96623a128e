"""The figure scripts on the smoke run: what each figure holds, and that it fits its page."""

import runpy
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from conftest import ROOT
from figure_contents import assert_on_page, hyphens_before_numbers, points_in, title_of, words_in
from matplotlib import pyplot as plt
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Rectangle
from matplotlib.text import Text

from scripts.drawing import style
from scripts.files.tsv import read_table
from scripts.results.paths import places_in_plane

NUMBERS = range(1, 9)
PLANES = {2: "tau_of_epsilon", 3: "xi_of_epsilon"}


def script_inputs(smoke, config: dict, number: int) -> SimpleNamespace:
    """What rule figure_<number> hands to its script."""
    settings = config["figures"].get(f"figure_{number}", {"rows": {}})
    shown = [row["scene"] for row in settings["rows"].values()]
    results = smoke.folder / "results"
    plane = PLANES.get(number)
    scenes = places_in_plane(config, plane) if plane else {}
    return SimpleNamespace(
        input=SimpleNamespace(
            curves=results / "hopf" / f"{plane}.nc",
            trajectories=[results / "trajectories" / f"{scene}.nc" for scene in shown],
            spectra=[results / "spectra" / f"{scene}.nc" for scene in shown],
            response=results / "friction" / "velocity_step.nc",
            table=results / "tables" / "attractors.tsv",
        ),
        params=SimpleNamespace(settings=settings, scenes=scenes),
    )


@pytest.fixture(scope="module")
def figures(smoke, smoke_config, tmp_path_factory) -> dict[int, Figure]:
    """What each script draws of the smoke run."""
    folder = tmp_path_factory.mktemp("figures")
    drawn = {}
    with pytest.MonkeyPatch.context() as patch:
        for number in NUMBERS:

            def keep(figure, output, number=number):
                figure.canvas.draw()
                drawn[number] = figure

            patch.setattr(style, "save", keep)
            inputs = script_inputs(smoke, smoke_config, number)
            inputs.log = [folder / f"{number}.log"]
            inputs.output = SimpleNamespace()
            script = ROOT / "scripts" / "figures" / f"figure_{number}.py"
            runpy.run_path(str(script), {"snakemake": inputs}, "__main__")
            assert inputs.log[0].read_text() == ""
    plt.close("all")
    return drawn


@pytest.fixture
def figure(figures, request) -> Figure:
    """One of them."""
    return figures[request.param]


def these(*numbers: int):
    """Run a test on these figures."""
    return pytest.mark.parametrize("figure", numbers, indirect=True)


@these(*NUMBERS)
def test_figure_fits_a_page(figure):
    """Printed at the size drawn: text, lines and legends end inside, letters can be read."""
    assert_on_page(figure)


@these(*NUMBERS[1:])
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


@these(*NUMBERS)
def test_no_formula_is_left_as_source(figure):
    """Every `$` has its partner, and no name of a key stands for a symbol."""
    for text in figure.findobj(Text):
        assert text.get_text().count("$") % 2 == 0
        assert "_" not in "".join(text.get_text().split("$")[::2])
    assert hyphens_before_numbers(figure) == []


@these(1)
def test_figure_1_labels_its_parts(figure):
    """A drawing: no axes, every part named."""
    (axes,) = figure.axes
    assert not axes.axison
    for part in ("block", "spring", "loader plate", "rough surface", "v_0", "friction"):
        assert part in words_in(figure)


@these(1)
def test_figure_1_pulls_the_block(figure):
    """The spring is in front of it, in the direction in which plate and block move."""
    (axes,) = figure.axes
    block, _ = (part for part in axes.patches if isinstance(part, Rectangle))
    _, arm, spring = axes.lines
    front = block.get_x() + block.get_width()
    assert spring.get_xdata()[[0, -1]] == pytest.approx([front, arm.get_xdata()[0]])
    assert front < arm.get_xdata()[0]
    arrows = (part for part in axes.patches if isinstance(part, FancyArrowPatch))
    of_plate, of_block, friction = (np.diff(arrow.get_path().vertices[:2, 0]) for arrow in arrows)
    assert friction < 0 < min(of_plate, of_block)


@pytest.mark.parametrize(("figure", "plane"), PLANES.items(), indirect=["figure"])
def test_curves_have_all_branches(figure, plane, smoke):
    """A label for each."""
    words = words_in(figure)
    curves = xr.load_dataset(smoke.folder / "results" / "hopf" / f"{plane}.nc")
    for branch in np.unique(curves.branch):
        assert f"$k$ = {branch}" in words


@these(2, 3)
def test_curves_say_what_kind_of_bifurcation(figure):
    """By their line, over the number of unstable pairs."""
    words = words_in(figure)
    for word in ("supercritical", "subcritical", "generalised Hopf point", "double Hopf point"):
        assert word in words
    assert "unstable pairs" in words
    assert {"-", "--"} <= {line.get_linestyle() for line in figure.axes[0].lines}


@pytest.mark.parametrize(("figure", "scenes"), [(2, {(0.7, 7.0)}), (3, set())], indirect=["figure"])
def test_scenes_stand_in_their_own_plane_only(figure, scenes):
    """Only chaos has xi = 0.5, and none has tau = 12: elsewhere they lie in a wrong region."""
    assert {(x, y) for x, y, _ in points_in(figure.axes[0])} == scenes
    words = words_in(figure)
    assert ("chaos" in words) == ("scene" in words) == bool(scenes)
    assert not any(name in words for name in ("torus", "fixed point", "oscillation"))


@these(4, 5)
def test_rows_show_velocity_twice_and_portrait(figure):
    """Two rows of three panels, lettered, with parameters."""
    assert len(figure.axes) == 6
    for row, letter in zip((figure.axes[:3], figure.axes[3:]), "ab", strict=True):
        assert [axes.get_xlabel() for axes in row[:2]] == ["time $t$", "time $t$"]
        assert row[0].get_ylabel() == "velocity $v$"
        assert (row[2].get_xlabel(), row[2].get_ylabel()) == ("displacement $u$", "velocity $v$")
        title = title_of(row[0])
        assert f"{{{letter}}}" in title
        assert title.endswith("\nfrom the start")
        assert [title_of(axes) for axes in row[1:]] == ["at the end", "phase portrait"]
        assert all(symbol in title for symbol in (r"\tau", r"\varepsilon", r"\xi", r"\gamma"))
    assert "transient" in words_in(figure)
    assert "attractor" in words_in(figure)


@pytest.mark.parametrize(
    ("figure", "row", "paper"),
    [
        (4, 0, "fixed point"),
        (4, 1, "oscillations"),
        (5, 0, "torus"),
        (5, 1, "chaos"),
        (6, 0, "single peak"),
        (6, 1, "two peaks"),
        (7, 0, "broadband noise"),
    ],
    indirect=["figure"],
)
def test_titles_quote_the_paper(figure, row, paper):
    """So that nobody takes its word for what is seen."""
    title = [title_of(axes) for axes in figure.axes if "\n" in title_of(axes)][row]
    assert f"the paper: “{paper}”; here: " in title


@pytest.mark.parametrize(
    ("figure", "scenes"),
    [(4, ["fixed_point", "oscillation"]), (5, ["torus", "chaos"])],
    indirect=["figure"],
)
def test_titles_say_what_is_seen(figure, scenes, smoke):
    """The class from the scene's own history."""
    rows = read_table(smoke.folder / "results/tables/attractors.tsv")
    for axes, scene in zip(figure.axes[::3], scenes, strict=True):
        (met,) = [r["class"] for r in rows if (r["scene"], r["history"]) == (scene, 1)]
        words = {"cycle": "limit cycle"}.get(met, met)
        assert f"; here: {words}\n" in title_of(axes)


@pytest.mark.parametrize(("figure", "rows"), [(6, 2), (7, 1)], indirect=["figure"])
def test_spectra_are_shown_on_both_scales(figure, rows):
    """The same frequencies and powers; all rows have the same logarithmic axes."""
    assert len(figure.axes) == 2 * rows
    logarithmic, linear = figure.axes[::2], figure.axes[1::2]
    assert {axes.get_yscale() for axes in logarithmic} == {"log"}
    assert {axes.get_yscale() for axes in linear} == {"linear"}
    assert len({axes.get_ylim() for axes in logarithmic}) == 1
    assert len({axes.get_xlim() for axes in figure.axes}) == 1
    assert figure.axes[0].get_xlim()[0] == 0
    assert all("power spectral density" in axes.get_ylabel() for axes in logarithmic)
    assert all("frequency" in axes.get_xlabel() for axes in figure.axes[-2:])
    for one, other in zip(logarithmic, linear, strict=True):
        np.testing.assert_array_equal(one.lines[0].get_xydata(), other.lines[0].get_xydata())


@these(8)
def test_figure_8_marks_both_effects_of_both_steps(figure):
    """Up-step and down-step, and Dc."""
    words = words_in(figure).replace("\n", " ")
    assert words.count("direct effect") == 2
    assert words.count("evolution effect") == 2
    assert "$D_c$" in words
    assert r"\Delta v" in words
