"""Files of scripts appear only when complete, and a failure is reported in one line."""

import errno
import os
from unittest.mock import Mock

import numpy as np
import pytest
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import FileError, logged, written


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


@pytest.mark.parametrize("first_to_end", ["older", "newer"])
def test_last_of_two_writers_wins(tmp_path, first_to_end):
    """The older one gives way, in words, whichever of the two ends first."""
    path = tmp_path / "table.tsv"
    older, newer = written(path), written(path)
    older.__enter__().write_text("older")
    newer.__enter__().write_text("newer")
    if first_to_end == "newer":
        newer.__exit__(None, None, None)
    with pytest.raises(FileError, match=r"table.tsv: cannot write: another run has started to"):
        older.__exit__(None, None, None)
    if first_to_end == "older":
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


@pytest.mark.parametrize("size", [0, 100, -1000, -1, None])
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


def test_netcdf_that_is_closed_to_reading_stays(tmp_path, monkeypatch):
    """A file without permission to read may be complete."""
    path = tmp_path / "data.nc"
    path.touch()
    problem = PermissionError(errno.EACCES, "Permission denied")
    monkeypatch.setattr(xr, "load_dataset", Mock(side_effect=problem))
    with pytest.raises(FileError, match=r"data.nc: cannot be read: Permission denied; run the"):
        read(path)
    assert path.exists()


def test_problem_with_a_file_ends_a_script_in_one_line(tmp_path):
    """The traceback is in the log; a log that cannot be written is a problem, too."""
    with pytest.raises(SystemExit) as end, logged(tmp_path / "log"):
        read(tmp_path / "nowhere.nc")
    assert str(end.value.code).startswith(f"error: {tmp_path}/nowhere.nc: cannot be read: No such")
    assert "\n" not in end.value.code
    assert "Traceback" in (tmp_path / "log").read_text()
    with pytest.raises(SystemExit, match=r"error: .*; check that its folder"), logged(tmp_path):
        raise AssertionError
