"""Drawing from made-up data: data in, axes out."""

import hopf_plane
import numpy as np
import pytest
import spectrum_rows
import trajectory_rows
import xarray as xr
from drawing import logged, save
from figure_contents import points_in, title_of, words_in
from matplotlib import pyplot as plt
from matplotlib.figure import Figure


@pytest.fixture(autouse=True)
def _closed_figures():
    """No test leaves a figure open for the next one."""
    yield
    plt.close("all")


def a_trajectory(v: np.ndarray, u: np.ndarray) -> xr.Dataset:
    """A made-up trajectory with a time step of 0.1."""
    time = {"time": 0.1 * np.arange(v.size)}
    attributes = {"tau": 3.0, "epsilon": 0.25, "xi": 0.5, "gamma": 0.75, "t_transient": 50.0}
    return xr.Dataset({"u": ("time", u), "v": ("time", v)}, time, attributes)


@pytest.fixture
def spiral_and_circle() -> Figure:
    """Rows of a point and of a cycle."""
    t = 0.1 * np.arange(1001)
    size = np.exp(-t / 4)
    rows = {
        "a": a_trajectory(1 + size * np.cos(t), size * np.sin(t)),
        "b": a_trajectory(1 + 0.5 * np.cos(t), 0.5 * np.sin(t)),
    }
    shown = {"rows": {"a": {"time_shown": 40.0}, "b": {"time_shown": 1e9}}}
    shown |= {"end_shown": 20.0, "attractor_shown": 10.0}
    return trajectory_rows.draw(rows, {"a": "first", "b": "second"}, shown)


def test_velocity_is_shown_over_the_asked_times(spiral_and_circle):
    """From the start, at most to the end, and up to the end."""
    axes = spiral_and_circle.axes
    assert [axes[i].get_xlim() for i in (0, 3)] == [(0, 40), (0, 100)]
    assert [axes[i].get_xlim() for i in (1, 4)] == [(80, 100), (80, 100)]
    (line,) = axes[1].lines
    np.testing.assert_allclose(line.get_xdata()[[0, -1]], [80, 100])
    np.testing.assert_allclose(
        axes[4].lines[0].get_ydata(), 1 + 0.5 * np.cos(0.1 * np.arange(800, 1001))
    )


def test_portrait_parts_transient_and_attractor(spiral_and_circle):
    """The transient up to t_transient, the attractor over the last time shown."""
    transient, attractor, steady = spiral_and_circle.axes[5].lines
    t = 0.1 * np.arange(1001)
    np.testing.assert_allclose(transient.get_xdata(), 0.5 * np.sin(t[:501]))
    np.testing.assert_allclose(attractor.get_xdata(), 0.5 * np.sin(t[900:]))
    np.testing.assert_allclose(attractor.get_ydata(), 1 + 0.5 * np.cos(t[900:]))
    assert (list(steady.get_xdata()), list(steady.get_ydata())) == ([0], [1])
    assert transient.get_color() != attractor.get_color()


def test_attractor_that_is_a_point_gets_a_dot(spiral_and_circle):
    """A spiral does, a cycle does not."""
    assert len(points_in(spiral_and_circle.axes[2])) == 1
    assert len(points_in(spiral_and_circle.axes[5])) == 0


def test_titles_hold_parameters_and_words(spiral_and_circle):
    """As given."""
    title = title_of(spiral_and_circle.axes[3])
    assert r"$\tau = 3$, $\varepsilon = 0.25$, $\xi = 0.5$, $\gamma = 0.75$" in title
    assert title.endswith("second")


def a_spectrum(signal: str, *peaks: tuple[float, float, int, int]) -> xr.Dataset:
    """A made-up spectrum with peaks of frequency, power, kind and multiple."""
    frequency = np.linspace(0, 5, 501)
    columns = np.reshape(peaks, (-1, 4)).T
    names = ["peak_frequency", "peak_power", "peak_kind", "peak_multiple"]
    return xr.Dataset(
        {
            "power": ("frequency", 1e-3 + 0 * frequency),
            **{name: ("peak", column) for name, column in zip(names, columns, strict=True)},
        },
        {"frequency": frequency},
        {"scene": "made_up", "line_share": 0.75, "signal": signal},
    )


BASE, HARMONIC, OTHER = (0.1, 9.0, 0, 1), (0.2, 5.0, 1, 2), (0.27, 1.0, 2, 0)


def test_peaks_are_named_by_kind():
    """Base, harmonic with its multiple, other in another colour, each with its frequency."""
    rows = {"a": a_spectrum("not periodic", BASE, HARMONIC, OTHER)}
    figure = spectrum_rows.draw(rows, {"a": "word"}, 0.5)
    labels = {text.get_text(): text.get_color() for text in figure.axes[0].texts}
    base, harmonic, other = labels
    assert base.startswith("base $f_1$")
    assert base.endswith("0.1000")
    assert harmonic.startswith(r"$2\,f_1$")
    assert harmonic.endswith("0.2000")
    assert other.startswith("other")
    assert other.endswith("0.2700")
    assert labels[base] == labels[harmonic] != labels[other]
    assert {(x, y) for x, y, _ in points_in(figure.axes[0])} == {
        p[:2] for p in (BASE, HARMONIC, OTHER)
    }


def test_peaks_beside_a_higher_one_get_a_dot_only():
    """Labels would lie on each other; peaks beyond the axis get nothing."""
    beside, beyond = (0.101, 2.0, 2, 0), (0.6, 3.0, 1, 6)
    rows = {"a": a_spectrum("not periodic", BASE, beside, beyond)}
    figure = spectrum_rows.draw(rows, {"a": "word"}, 0.5)
    assert len(figure.axes[0].texts) == 1
    assert {x for x, *_ in points_in(figure.axes[0])} == {0.1, 0.101}


def test_spectrum_without_peaks_is_drawn():
    """Nothing to name, nothing to fall over."""
    figure = spectrum_rows.draw({"a": a_spectrum("not periodic")}, {"a": "word"}, 0.5)
    assert len(figure.axes[0].texts) == 0
    assert "word" in title_of(figure.axes[0])


def test_what_a_spectrum_shows_is_said_beside_the_paper():
    """A limit cycle by its frequency, anything else by the power off its lines."""
    cycle = spectrum_rows.seen(a_spectrum("periodic", BASE, HARMONIC), "two peaks")
    assert "0.1000" in cycle
    assert "harmonics" in cycle
    assert "“two peaks”" in cycle
    other = spectrum_rows.seen(a_spectrum("not periodic", BASE, HARMONIC, OTHER), "noise")
    assert "1 further peak" in other
    assert "25 %" in other
    assert "“noise”" in other


def a_plane(ordinate: str, fixed: str) -> xr.Dataset:
    """A made-up plane: one piece that turns subcritical, and one of branch 1."""
    epsilon = np.array([0.2, 0.3, 0.4, 0.5, 1.0, 1.0])
    height = np.array([1.0, 2.0, 3.0, 4.0, 2.0, 4.0])
    columns = {
        "epsilon": epsilon,
        ordinate: height,
        "branch": np.array([0, 0, 0, 0, 1, 1]),
        "piece": np.array([1, 1, 1, 1, 2, 2]),
        "l1": np.array([-0.1, -0.2, 0.1, 0.2, -0.1, -0.1]),
    }
    data = {name: ("point", column) for name, column in columns.items()}
    data["special_kind"] = ("special", np.array([b"double_hopf      "]))
    data["special_epsilon"] = ("special", [0.35])
    data[f"special_{ordinate}"] = ("special", [2.5])
    data["map_epsilon"] = ("map_epsilon", [0.25, 0.75])
    data["map_ordinate"] = ("map_ordinate", [1.0, 3.0])
    data["map_unstable_pairs"] = (("map_ordinate", "map_epsilon"), [[0.0, 1.0], [1.0, 2.0]])
    return xr.Dataset(data, attrs={"ordinate": ordinate, fixed: 0.5, "gamma": 0.8})


@pytest.mark.parametrize(("ordinate", "fixed"), [("tau", "xi"), ("xi", "tau")])
def test_curves_are_dashed_where_subcritical(ordinate, fixed):
    """Solid and dashed parts of one colour meet; another branch has another colour."""
    figure = hopf_plane.draw(a_plane(ordinate, fixed), {})
    solid, dashed, other, double = figure.axes[0].lines
    assert double.get_xydata().tolist() == [[0.35, 2.5]]
    assert "double Hopf point" in words_in(figure)
    assert "generalised Hopf point" not in words_in(figure)
    assert solid.get_linestyle() == other.get_linestyle() == "-"
    assert dashed.get_linestyle() != "-"
    assert solid.get_color() == dashed.get_color() != other.get_color()
    assert solid.get_xydata()[-1] == pytest.approx(dashed.get_xydata()[0])
    assert solid.get_xydata()[0] == pytest.approx([0.2, 1.0])
    assert dashed.get_xydata()[-1] == pytest.approx([0.5, 4.0])


@pytest.mark.parametrize(
    ("scene", "lies_in"),
    [
        ({"xi": 0.5, "gamma": 0.8}, True),
        ({"xi": 0.8, "gamma": 0.8}, False),
        ({"xi": 0.5, "gamma": 0.9}, False),
    ],
)
def test_scene_is_filled_where_it_lies_in_the_plane(scene, lies_in):
    """The fixed parameter and gamma decide; the legend says so."""
    places = {"my_scene": {"tau": 2.0, "epsilon": 0.4, **scene}}
    figure = hopf_plane.draw(a_plane("tau", "xi"), places)
    ((x, y, filling),) = points_in(figure.axes[0])
    assert (x, y) == (0.4, 2.0)
    assert (filling != "white") is lies_in
    assert ("scene in this plane" in words_in(figure)) is lies_in
    assert ("scene at another" in words_in(figure)) is not lies_in
    assert "my scene" in words_in(figure)


def test_scenes_at_one_place_share_a_label():
    """Two names, one after the other."""
    place = {"tau": 2.0, "epsilon": 0.4, "xi": 0.5, "gamma": 0.8}
    figure = hopf_plane.draw(a_plane("tau", "xi"), {"one": place, "two": place})
    assert "one, two" in words_in(figure)


def test_saved_figures_have_the_same_bytes_each_time(tmp_path):
    """And no date in them."""
    for name in ("first", "second"):
        with logged(tmp_path / "log"):
            figure, axes = plt.subplots()
            axes.plot([0, 1], [0, 1], label="$x$", rasterized=True)
            figure.legend()
            save(figure, tmp_path / f"{name}.pdf", tmp_path / f"{name}.png")
            assert not plt.get_fignums()
    for ending in ("pdf", "png"):
        first = (tmp_path / f"first.{ending}").read_bytes()
        assert first == (tmp_path / f"second.{ending}").read_bytes()
        assert b"Date" not in first
    assert (tmp_path / "first.pdf").read_bytes().startswith(b"%PDF")
    assert (tmp_path / "first.png").read_bytes().startswith(b"\x89PNG")


def test_style_holds_inside_logged_only(tmp_path):
    """The font size of the style."""
    outside = plt.rcParams["font.size"]
    with logged(tmp_path / "log"):
        assert plt.rcParams["font.size"] == 8
        assert plt.rcParams["pdf.fonttype"] == 42
    assert plt.rcParams["font.size"] == outside != 8


def test_failure_of_a_script_is_in_its_log(tmp_path):
    """And is still a failure."""
    with pytest.raises(KeyError), logged(tmp_path / "log"):
        {}["missing"]
    assert "KeyError: 'missing'" in (tmp_path / "log").read_text()
