"""The atlas in the workflow: its parts and their namelists, its table, and no point twice.

The suite attractor_points shows which points of a refined plane are computed.
"""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from figure_contents import title_of, words_in
from made_up_results import LINES, attractor_row
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection, QuadMesh
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from conftest import Programs
from scripts.drawing import class_map
from scripts.files.tsv import read_table, write_table
from scripts.requests.write_namelist import write_namelist
from scripts.studies.atlas import figure as atlas
from scripts.studies.atlas import play_data
from scripts.studies.atlas.plan import groups, inputs, part_of
from scripts.tables import attractor_tables
from scripts.tables.motion_rows import COLOURS

pytestmark = pytest.mark.usefixtures("styled")


def test_table_holds_all_points_of_each_plane(smoke, smoke_config):
    """Every point once, the ends of both windows among them."""
    rows = read_table(smoke.folder / "results/tables/atlas.tsv")
    atlas = smoke_config["atlas"]
    assert len({(row["xi"], row["gamma"]) for row in rows}) == len(atlas["planes"])
    for plane in atlas["planes"].values():
        at = plane["xi"], plane["gamma"]
        places = [(row["epsilon"], row["tau"]) for row in rows if (row["xi"], row["gamma"]) == at]
        assert len(places) == len(set(places)) == atlas["abscissa_count"] * atlas["ordinate_count"]
        for axis, window in enumerate((atlas["abscissa_window"], plane["ordinate_window"])):
            values = [place[axis] for place in places]
            assert [min(values), max(values)] == window


def made_parts(
    programs: Programs, config: dict, parts: int, refinements: int = 0, **counts: int
) -> list[Path]:
    """A plane of the atlas, divided into a number of parts."""
    config["atlas"] |= {"parts": parts, "refinements": refinements, **counts}
    paths = []
    for part in range(1, parts + 1):
        write_namelist(programs.folder / "input.nml", groups(config, "xi_05", str(part)))
        paths.append(programs.folder / f"{parts}_{part}_{refinements}.nc")
        run = programs.run("attractors", "input.nml", paths[-1].name)
        assert run.returncode == 0, run.stderr
    return paths


@pytest.fixture
def tiny(smoke_config) -> dict:
    return {**smoke_config, "atlas": {**smoke_config["atlas"]}}


def test_points_not_computed_reach_table_figure_and_page(programs, tiny):
    """All of them, with class and without exponents; the page has words for the others."""
    (path,) = made_parts(programs, tiny, 1, refinements=1, abscissa_count=13, ordinate_count=13)
    table = programs.folder / "atlas.tsv"
    write_table(table, attractor_tables.atlas_rows(xr.load_dataset(path)))
    rows = read_table(table)
    taken = [row for row in rows if row["computed"] == "no"]
    assert 0 < len(taken) < len(rows) == 169
    assert all(row["class"] in ("fixed point", "cycle", "torus", "chaos") for row in taken)
    assert all(np.isnan(row[key]) for row in taken for key in ("exponent_1", "time", "reason"))
    figure = atlas.draw(rows, [], [], {})
    assert f"169 points, {169 - len(taken)} computed, " in title_of(figure.axes[0])
    known = np.array([row["class"] != "undecided" for row in rows])
    exponents = figure.axes[1].collections[0].get_array().filled(np.nan).ravel()
    assert np.isfinite(exponents[known]).all()
    (plane,) = play_data.list_planes((row, None, 0.0) for row in rows)
    in_order = sorted(rows, key=lambda row: (row["tau"], row["epsilon"]))
    assert list(plane["words"]) == [i for i, row in enumerate(in_order) if row not in taken]


@pytest.mark.parametrize(
    ("count", "parts", "distance"),
    [*((1, 1, 1), (16, 4, 1), (7, 7, 1), (61, 8, 1), (51, 7, 2), (9, 9, 16), (1000, 31, 16))],
)
def test_parts_hold_every_row_once(count, parts, distance):
    """All parts but the last end with a line that is computed first; sizes are nearly the same."""
    ends = [part_of(count, parts, part, distance) for part in range(1, parts + 1)]
    rows = [row for first, last in ends for row in range(first, last + 1)]
    assert rows == list(range(1, count + 1))
    assert all((last - first) % distance == 0 for first, last in ends[:-1])
    sizes = [last - first + 1 for first, last in ends]
    assert max(sizes) - min(sizes) <= (1 if distance == 1 else 2 * distance - 1)


@pytest.mark.parametrize(
    ("columns", "lines", "refinements"),
    [(9, 7, 0), (1, 40, 0), (12, 40, 0), (13, 40, 1), (37, 25, 2), (200, 200, 2)],
)
def test_first_lines_of_a_small_atlas_are_not_too_far_apart(
    own_config, columns, lines, refinements
):
    """At least six distances in each direction, and never more refinements than asked for."""
    counts = {"abscissa_count": columns, "ordinate_count": lines}
    own_config["atlas"] |= {**counts, "parts": 1, "refinements": 2}
    points = groups(own_config, "fault", "1")["points"]
    assert points["refinements"] == refinements


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
