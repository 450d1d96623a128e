"""Files of scripts appear only when complete, and a failure is reported in one line."""

import errno
import os
from unittest.mock import Mock

import numpy as np
import pytest
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import FileError, logged, written


def test_file_is_there_when_complete(tmp_path):
    """The file appears at the end; unfinished files of earlier runs are removed."""
    path = tmp_path / "table.tsv"
    (tmp_path / "table.tsv.123-456.part").write_text("left by a run that was killed")
    (tmp_path / "a.table.tsv.123-456.part").write_text("of another file")
    with written(path) as unfinished:
        unfinished.write_text("whole")
        assert not path.exists()
    assert sorted(file.name for file in tmp_path.iterdir()) == [
        "a.table.tsv.123-456.part",
        "table.tsv",
    ]
    assert path.read_text() == "whole"


def test_file_is_on_the_disk_before_it_has_its_name(tmp_path, monkeypatch):
    """And its folder thereafter: a loss of power leaves no empty file under a final name."""
    path = tmp_path / "table.tsv"
    synced = []

    def fsync(descriptor: int) -> None:
        synced.append((os.readlink(f"/proc/self/fd/{descriptor}"), path.exists()))

    monkeypatch.setattr(os, "fsync", fsync)
    with written(path) as unfinished:
        unfinished.write_text("whole")
    assert synced == [(str(unfinished), False), (str(tmp_path), True)]


@pytest.mark.parametrize("first_to_end", ["older", "newer"])
def test_last_of_two_writers_wins(tmp_path, first_to_end):
    """The older one gives way, in words, whichever of the two ends first."""
    path = tmp_path / "table.tsv"
    older, newer = written(path), written(path)
    older.__enter__().write_text("older")
    newer.__enter__().write_text("newer")
    if first_to_end == "newer":
        newer.__exit__(None, None, None)
    with pytest.raises(
        FileError, match=r"table.tsv: another run has started to write this file; only the last"
    ):
        older.__exit__(None, None, None)
    if first_to_end == "older":
        newer.__exit__(None, None, None)
    assert path.read_text() == "newer"
    assert [file.name for file in tmp_path.iterdir()] == ["table.tsv"]


def test_failure_leaves_the_older_file_and_nothing_else(tmp_path):
    path = tmp_path / "table.tsv"
    path.write_text("older")

    def half_written():
        with written(path) as unfinished:
            unfinished.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        half_written()
    assert [file.name for file in tmp_path.iterdir()] == ["table.tsv"]
    assert path.read_text() == "older"


def test_full_disk_is_reported(tmp_path):
    """The device that is always full stands in."""
    path = tmp_path / "table.tsv"

    def write_to_full_disk():
        with written(path) as unfinished:
            unfinished.symlink_to("/dev/full")
            unfinished.write_text("a")

    with pytest.raises(
        FileError, match=r"table.tsv: cannot write: No space left .*; check that its"
    ):
        write_to_full_disk()
    assert list(tmp_path.iterdir()) == []


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
    """The traceback is in the log."""
    with pytest.raises(SystemExit) as end, logged(tmp_path / "log"):
        read(tmp_path / "nowhere.nc")
    assert str(end.value.code).startswith(f"error: {tmp_path}/nowhere.nc: cannot be read: No such")
    assert "\n" not in end.value.code
    assert "Traceback" in (tmp_path / "log").read_text()


@pytest.mark.parametrize("log", ["nowhere/log", "."])
def test_log_that_cannot_be_written_is_refused(tmp_path, log):
    with (
        pytest.raises(SystemExit, match=r"error: .*; check that its folder"),
        logged(tmp_path / log),
    ):
        raise AssertionError
