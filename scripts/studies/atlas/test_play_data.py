"""Data of the view in which a reader moves the parameters: each point has its class and path."""

import base64
import json
import struct
from itertools import product

import numpy as np
import pytest
import xarray as xr
from made_up_page import atlas_run, attractor, turn

from scripts.files.tsv import read_table
from scripts.studies.atlas import play_data
from scripts.tables.motion_rows import COLOURS, kind_of

KINDS = list(COLOURS)


def read(text: str) -> dict:
    head, _, value = text.removesuffix(";\n").partition("const playData = ")
    assert head == '"use strict";\n'
    return json.loads(value)


def unpacked(text: str, time: float) -> dict[int, np.ndarray]:
    """Paths by the number of their point, as `pack_path` describes its bytes."""
    data = base64.b64decode(text)
    found, at = {}, 0
    while at < len(data):
        number, size, *ranges = struct.unpack_from("<IIffff", data, at)
        steps, *levels = np.frombuffer(data, np.uint8, 3 * size, at + 24).reshape(size, 3).T
        least, most = np.reshape(ranges, (2, 2, 1)).swapaxes(0, 1)
        values = least + np.array(levels) / play_data.LEVELS * (most - least)
        found[number] = np.vstack([np.cumsum(steps.astype(int)) / play_data.STEPS * time, values])
        at += 24 + 3 * size
    return found


def play() -> str:
    """Two planes: classes change with epsilon; the last point of the first was not computed."""
    none = {f"exponent_{i}": np.nan for i in (1, 2, 3)}
    motions = [{"class": "fixed point"}, {"f1": 0.1}, {"period": 2.0, "f1": 0.05}]
    motions = [{"f1": np.nan, "f2": np.nan, **one} for one in (*motions, {"class": "chaos"})]
    rows = [
        attractor(epsilon, tau, xi=xi, **motion)
        for xi, tau in product((0.5, 0.8), (0.0, 5.0))
        for epsilon, motion in zip((0.1, 0.2, 0.3, 0.4), motions, strict=True)
    ]
    later = np.add(turn(30.0, 90.0), [[30.0], [0.0], [0.0]])
    longer = np.concatenate([turn(30.0, 40.0), later], axis=1)
    paths = 4 * [None, turn(10.0, 3.0), turn(20.0, 5.0), longer]
    rows[7] |= {"computed": "no", **none}
    paths[7] = None
    return play_data.write_script(rows, [atlas_run(*paths[:3]), atlas_run(*paths[3:])], {})


@pytest.fixture(scope="module")
def made_up() -> dict:
    return read(play())


def test_paths_are_those_of_their_points(made_up):
    """To half a step of time and half a level of u and ln v; points at rest have none."""
    first, _ = made_up["planes"]
    paths = unpacked(first["paths"], first["time"])
    assert list(paths) == [1, 2, 3, 5, 6]
    for number, given in ((1, turn(10.0, 3.0)), (6, turn(20.0, 5.0))):
        found = paths[number]
        assert found.shape == given.shape
        np.testing.assert_allclose(found[0], given[0], atol=0.51 * 60 / play_data.STEPS)
        for column in (1, 2):
            level = np.ptp(given[column]) / play_data.LEVELS
            np.testing.assert_allclose(found[column], given[column], atol=0.51 * level)


def test_path_with_a_long_gap_has_points_between():
    """A gap of 40 of 60 units of time, where a byte holds 15; the line is the same."""
    path = np.array([[0.0, 1.2, 41.4, 60.0], [0.0, 2.0, -6.0, 4.0], [0.0, 1.0, -3.0, 2.0]])
    packed = base64.b64encode(play_data.pack_path(7, path, 60.0)).decode()
    ((number, found),) = unpacked(packed, 60.0).items()
    assert number == 7
    assert found.shape[1] > 4
    for column in (1, 2):
        expected = np.interp(found[0], path[0], path[column])
        np.testing.assert_allclose(found[column], expected, atol=0.05)
    assert set(np.round(path[0], 6)) <= set(np.round(found[0], 6))


def test_point_that_was_not_computed_shows_the_nearest_of_its_class(made_up):
    first, second = made_up["planes"]
    assert first["shown"] == [0, 1, 2, 3, 4, 5, 6, 3]
    assert "7" not in first["words"]
    assert second["shown"] == list(range(8))


def test_cycle_that_was_not_computed_shows_one_of_its_period():
    rows = [
        attractor(0.1 * i, 0.0, period=period, f1=0.1, f2=np.nan)
        for i, period in enumerate((4.0, 2.0, 4.0))
    ]
    rows[2]["computed"] = "no"
    (plane,) = read(play_data.write_script(rows, [atlas_run(None, None, None)], {}))["planes"]
    assert plane["shown"] == [0, 1, 0]


def test_smoke_run_has_each_point_of_its_atlas(smoke):
    """Classes are those of the table, paths those of the NetCDF files."""
    results = smoke.folder / "results"
    found = read((results / "page" / "play-data.js").read_text())
    rows = read_table(results / "tables" / "atlas.tsv")
    drawn = 0
    for plane in found["planes"]:
        at = plane["xi"], plane["gamma"]
        of_plane = [row for row in rows if (row["xi"], row["gamma"]) == at]
        ordered = sorted(of_plane, key=lambda row: (row["tau"], row["epsilon"]))
        assert [KINDS[int(kind)] for kind in plane["kinds"]] == list(map(kind_of, ordered))
        assert plane["time"] == 20.0
        drawn += len(unpacked(plane["paths"], plane["time"]))
    files = sorted((results / "attractors" / "atlas").glob("*/*.nc"))
    assert drawn == sum(int((xr.load_dataset(path).path_length > 0).sum()) for path in files)
    assert drawn > 0
