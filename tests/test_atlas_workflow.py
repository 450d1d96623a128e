"""The atlas in the workflow: only its own rules, one job a part, and no part twice."""

import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from conftest import SMOKE, Programs, rules_in
from figure_contents import title_of
from matplotlib import pyplot as plt

from scripts.figures import atlas
from scripts.files.tsv import read_table, write_table
from scripts.namelists.attractor_surveys import atlas_groups
from scripts.namelists.write_namelist import write_namelist
from scripts.page import play_data
from scripts.tables import attractor_tables

PARTS = "results/attractors/atlas"
CYCLE = 2
"""Its number among the classes."""


def parts_in(log: str) -> list[str]:
    """Parts that a run or a dry run computes."""
    return re.findall(rf"^ +output: {PARTS}/(\S+\.nc)$", log, flags=re.MULTILINE)


def test_atlas_resumes(scratch):
    """Where it ended before its last part only that part is computed, to the same bytes."""
    run = scratch.snakemake("atlas", *SMOKE)
    assert run.returncode == 0, run.stdout
    before = scratch.outputs()
    assert {"figures/atlas.pdf", "figures/atlas.png", "tables/atlas.tsv"} <= set(before)
    last = [f"{PARTS}/xi_08/0002.nc", "results/tables/atlas.tsv"]
    for name in (*last, "results/figures/atlas.pdf", "results/figures/atlas.png"):
        (scratch.folder / name).unlink()
    run = scratch.snakemake("atlas", *SMOKE)
    assert run.returncode == 0, run.stdout
    assert parts_in(run.stdout) == ["xi_08/0002.nc"]
    assert rules_in(run.stdout) == {"attractors_runs", "atlas_table", "atlas"}
    assert scratch.outputs() == before


def test_table_holds_all_points_of_each_plane(smoke, smoke_config):
    """Every point once, the ends of both windows among them."""
    rows = read_table(smoke.folder / "results/tables/atlas.tsv")
    atlas = smoke_config["atlas"]
    assert len({(row["xi"], row["gamma"]) for row in rows}) == len(atlas["planes"])
    for plane in atlas["planes"].values():
        at = plane["xi"], plane["gamma"]
        places = [(row["epsilon"], row["tau"]) for row in rows if (row["xi"], row["gamma"]) == at]
        assert len(places) == len(set(places)) == atlas["epsilon_count"] * atlas["tau_count"]
        for axis, window in enumerate((atlas["epsilon_window"], plane["tau_window"])):
            values = [place[axis] for place in places]
            assert [min(values), max(values)] == window


def made_parts(
    programs: Programs, config: dict, parts: int, refinements: int = 0, **counts: int
) -> list[Path]:
    """A plane of the atlas, divided into a number of parts."""
    config["atlas"] |= {"parts": parts, "refinements": refinements, **counts}
    paths = []
    for part in range(1, parts + 1):
        write_namelist(programs.folder / "input.nml", atlas_groups(config, "xi_05", part))
        paths.append(programs.folder / f"{parts}_{part}_{refinements}.nc")
        run = programs.run("attractors", "input.nml", paths[-1].name)
        assert run.returncode == 0, run.stderr
    return paths


@pytest.fixture
def tiny(smoke_config) -> dict:
    """The smoke config, to change its atlas."""
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


@pytest.mark.parametrize("refinements", [0, 1])
def test_number_of_threads_does_not_matter(programs, tiny, monkeypatch, refinements):
    """The files are the same bytes."""
    contents = []
    for threads in ("1", "2"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        (path,) = made_parts(programs, tiny, 1, refinements)
        contents.append(path.read_bytes())
    assert contents[0] == contents[1]


def kinds_of(run: xr.Dataset, shape: tuple[int, int]) -> np.ndarray:
    """Class and period of the points of a grid, as one number."""
    period = np.where(run["class"] == CYCLE, run.period, 0)
    return (run["class"].values + 10 * period).reshape(shape)


def test_refined_plane_computes_only_where_neighbours_differ(programs, tiny):
    """What is computed is as without refinements; every other point is like all its neighbours."""
    counts = {"epsilon_count": 11, "tau_count": 9}
    shape = 9, 11
    paths = [made_parts(programs, tiny, 1, refinements, **counts)[0] for refinements in (0, 1, 2)]
    whole, *refined = (xr.load_dataset(path) for path in paths)
    assert whole.computed.values.all()
    for refinements, run in enumerate(refined, start=1):
        computed = run.computed.values == 1
        assert run.attrs["refinements"] == refinements
        assert 0 < computed.sum() < computed.size
        xr.testing.assert_identical(
            run.isel(point=computed).drop_attrs(), whole.isel(point=computed).drop_attrs()
        )
        others = run.isel(point=~computed)
        assert np.isnan(others.lyapunov_exponent).all()
        assert np.isnan(others.time).all()
        kinds, grid = kinds_of(run, shape), computed.reshape(shape)
        assert grid[:: 2**refinements, :: 2**refinements].all()
        assert grid[-1, -1]
        for j, i in np.argwhere(~grid):
            around = [(j - 1, i), (j + 1, i), (j, i - 1), (j, i + 1)]
            inside = [at for at in around if 0 <= at[0] < shape[0] and 0 <= at[1] < shape[1]]
            assert {kinds[at] for at in inside} == {kinds[j, i]}
            assert kinds[j, i] > 0


def test_points_not_computed_reach_table_figure_and_page(programs, tiny):
    """All of them, with class and without exponents; the page has words for the others."""
    (path,) = made_parts(programs, tiny, 1, refinements=2, epsilon_count=11, tau_count=9)
    table = programs.folder / "atlas.tsv"
    write_table(table, attractor_tables.atlas_rows(xr.load_dataset(path)))
    rows = read_table(table)
    taken = [row for row in rows if row["computed"] == "no"]
    assert 0 < len(taken) < len(rows) == 99
    assert all(row["class"] in ("fixed point", "cycle", "torus", "chaos") for row in taken)
    assert all(np.isnan(row[key]) for row in taken for key in ("exponent_1", "time", "reason"))
    figure = atlas.draw(rows, [], [], {})
    assert f"99 points, {99 - len(taken)} computed, " in title_of(figure.axes[0])
    known = np.array([row["class"] != "undecided" for row in rows])
    exponents = figure.axes[1].collections[0].get_array().filled(np.nan).ravel()
    assert np.isfinite(exponents[known]).all()
    plt.close(figure)
    (plane,) = play_data.planes(rows, [None] * len(rows), [0.0] * len(rows))
    in_order = sorted(rows, key=lambda row: (row["tau"], row["epsilon"]))
    assert list(plane["words"]) == [i for i, row in enumerate(in_order) if row not in taken]
