"""The atlas in the workflow: its parts and their namelists, its table, and no point twice.

The suites refined_grid and attractor_points show which points of a refined plane are computed.
"""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from figure_contents import title_of
from matplotlib import pyplot as plt

from conftest import Programs
from scripts.files.tsv import read_table, write_table
from scripts.namelists.laws import PAPER
from scripts.namelists.write_namelist import write_namelist
from scripts.studies.atlas import figure as drawing
from scripts.studies.atlas import play_data
from scripts.studies.atlas.parts import part_of
from scripts.studies.atlas.plan import groups
from scripts.tables import attractor_tables


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


def test_number_of_parts_does_not_matter(programs, tiny):
    """The tables of a plane in one part and in three are the same."""
    tables = []
    for parts in (1, 3):
        runs = [xr.load_dataset(path) for path in made_parts(programs, tiny, parts)]
        tables.append(programs.folder / f"{parts}.tsv")
        write_table(tables[-1], [row for run in runs for row in attractor_tables.rows_of(run)])
    assert len(read_table(tables[0])) == 16
    assert tables[0].read_bytes() == tables[1].read_bytes()


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
    figure = drawing.draw(rows, [], [], {})
    assert f"169 points, {169 - len(taken)} computed, " in title_of(figure.axes[0])
    known = np.array([row["class"] != "undecided" for row in rows])
    exponents = figure.axes[1].collections[0].get_array().filled(np.nan).ravel()
    assert np.isfinite(exponents[known]).all()
    plt.close(figure)
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


def test_parts_of_the_atlas_divide_its_delays(own_config):
    """All of epsilon in each part, both windows as a whole, at xi and gamma of the plane."""
    settings = own_config["atlas"]
    delays = []
    for part in range(1, settings["parts"] + 1):
        points = groups(own_config, "fault", str(part))["points"]
        columns, lines = points["axes"]
        assert (columns["along"], lines["along"]) == ("epsilon", "tau")
        assert columns["part"] == [1, settings["abscissa_count"]]
        assert columns["window"] == settings["abscissa_window"]
        assert lines["window"] == settings["planes"]["fault"]["ordinate_window"]
        assert points["refinements"] == settings["refinements"]
        model = {"name": PAPER, "parameters": ["xi", "gamma"], "values": [0.5, 1e8]}
        assert points["model"] == model
        delays += range(lines["part"][0], lines["part"][1] + 1)
    assert delays == list(range(1, settings["ordinate_count"] + 1))


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
