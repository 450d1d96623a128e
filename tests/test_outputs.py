"""Files of scripts appear only when complete, a failure is reported in one line; tables."""

import errno
import math
import os

import numpy as np
import pytest
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import FileError, logged, written
from scripts.files.tsv import read_table, write_table
from scripts.tables.accuracy import Reference, distances, errors_of, largest


def test_file_is_there_when_complete(tmp_path, monkeypatch):
    """It has its name once it is on the disk, where it outlasts a loss of power; unfinished files
    of earlier runs are removed."""
    path, synced = tmp_path / "table [1].tsv", []

    def fsync(descriptor: int) -> None:
        synced.append((os.readlink(f"/proc/self/fd/{descriptor}"), path.exists()))

    monkeypatch.setattr(os, "fsync", fsync)
    (tmp_path / f"{path.name}.123.part").write_text("left by a run that was killed")
    (tmp_path / f"a.{path.name}.123.part").write_text("of another file")
    with written(path) as unfinished:
        unfinished.write_text("whole")
    assert synced == [(str(unfinished), False)]
    names = {file.name for file in tmp_path.iterdir()}
    assert names == {path.name, f"a.{path.name}.123.part"}
    assert path.read_text() == "whole"


def test_last_of_two_writers_wins(tmp_path):
    """The older one gives way, in words."""
    path = tmp_path / "table.tsv"
    older, newer = written(path), written(path)
    older.__enter__().write_text("older")
    newer.__enter__().write_text("newer")
    with pytest.raises(FileError, match=r"table.tsv: cannot write: another run has started to"):
        older.__exit__(None, None, None)
    newer.__exit__(None, None, None)
    assert path.read_text() == "newer"
    assert [file.name for file in tmp_path.iterdir()] == ["table.tsv"]


@pytest.mark.parametrize(
    ("problem", "raised", "words"),
    [
        (KeyboardInterrupt(), KeyboardInterrupt, None),
        (
            OSError(errno.ENOSPC, "No space left on device"),
            FileError,
            "table.tsv: cannot write: No space left on device; check that its",
        ),
    ],
)
def test_failure_leaves_the_older_file_and_nothing_else(tmp_path, problem, raised, words):
    path = tmp_path / "table.tsv"
    path.write_text("older")

    def half_written() -> None:
        with written(path) as unfinished:
            unfinished.write_text("half")
            raise problem

    with pytest.raises(raised, match=words):
        half_written()
    assert [file.name for file in tmp_path.iterdir()] == ["table.tsv"]
    assert path.read_text() == "older"


@pytest.mark.parametrize("size", [0, -1000, None])
def test_damaged_netcdf_is_removed(tmp_path, size):
    """Cut at a size, or one bit of a value wrong; so the same command makes it again."""
    path = tmp_path / "data.nc"
    values = xr.Dataset({"v": ("time", [1.25] * 1000)})
    values.to_netcdf(path, engine="netcdf4", encoding={"v": {"fletcher32": True}})
    content = bytearray(path.read_bytes())
    if size is None:
        content[content.index(np.float64(1.25).tobytes() * 9)] ^= 1
    else:
        del content[size % len(content) :]
    path.write_bytes(content)
    with pytest.raises(FileError, match=r"data.nc: cannot be read: .* damaged and is removed; run"):
        read(path)
    assert not path.exists()


def test_problem_with_a_file_ends_a_script_in_one_line(tmp_path):
    """The traceback is in the log; a log that cannot be written is a problem, too."""
    with pytest.raises(SystemExit) as end, logged(tmp_path / "log"):
        read(tmp_path / "nowhere.nc")
    assert str(end.value.code).startswith(f"error: {tmp_path}/nowhere.nc: cannot be read: No such")
    assert "\n" not in end.value.code
    assert "Traceback" in (tmp_path / "log").read_text()
    with pytest.raises(SystemExit, match=r"error: .*; check that its folder"), logged(tmp_path):
        raise AssertionError


def test_table_is_read_as_written(tmp_path):
    rows = [{"a": "word", "b": 1.5e-9, "c": math.nan}, {"a": "two words", "b": 3.0, "c": math.inf}]
    write_table(tmp_path / "table.tsv", rows)
    assert (tmp_path / "table.tsv").read_text() == "a\tb\tc\nword\t1.5e-09\t\ntwo words\t3\tinf\n"
    read = read_table(tmp_path / "table.tsv")
    assert read[0]["b"] == 1.5e-9
    assert math.isnan(read[0]["c"])
    assert read[1] == rows[1]


def test_errors_are_relative_above_one():
    """The largest over theta, u, ln v; the first sample of a run, its history, does not count."""
    state, known = np.array([[0.2], [50.0], [0.0]]), np.array([[0.1], [40.0], [0.0]])
    assert distances(state, known) == pytest.approx([0.25])
    assert largest(np.array([9.0, 1.0, np.nan, 2.0])) == 2.0
    assert math.isnan(largest(np.array([0.0, np.nan])))


def test_samples_at_other_times_are_refused():
    """Two states at different times cannot be compared."""
    state, time = np.zeros((3, 2)), np.arange(2.0)
    reference = Reference(status="ok", time=time, state=state, uncertainty=time, amplification=time)
    run = {"case": "made up", "setting": 1e-13, "t_end": 1.0, "time": 0.9 * time, "state": state}
    with pytest.raises(ValueError, match=r"case 'made up'.*different times"):
        errors_of(run, reference)
