"""The atlas in the workflow: only its own rules, one job a part, and no part twice."""

import re
from pathlib import Path

import pytest
import xarray as xr
from conftest import SMOKE, Programs, rules_in

from scripts.files.tsv import read_table, write_table
from scripts.namelists.attractor_surveys import atlas_groups
from scripts.namelists.write_namelist import write_groups
from scripts.tables import attractor_tables

PARTS = "results/attractors/atlas"


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


def made_parts(programs: Programs, config: dict, parts: int) -> list[Path]:
    """A plane of the atlas, divided into so many parts."""
    config["atlas"]["parts"] = parts
    paths = []
    for part in range(1, parts + 1):
        write_groups(programs.folder / "input.nml", atlas_groups(config, "xi_05", part))
        paths.append(programs.folder / f"{parts}_{part}.nc")
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


def test_number_of_threads_does_not_matter(programs, tiny, monkeypatch):
    """The files are the same bytes."""
    contents = []
    for threads in ("1", "2"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        (path,) = made_parts(programs, tiny, 1)
        contents.append(path.read_bytes())
    assert contents[0] == contents[1]
