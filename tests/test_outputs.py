"""Files of scripts are whole or absent, and what goes wrong is told in one line."""

import pytest
import xarray as xr
from inputs import read
from outputs import FileError, logged, written
from tables import write_table


def test_file_is_there_when_complete(tmp_path):
    """And not before; what an earlier run left unfinished is no hindrance."""
    path = tmp_path / "table.tsv"
    (tmp_path / "table.tsv.part").write_text("left by a run that was killed")
    with written(path) as unfinished:
        unfinished.write_text("whole")
        assert not path.exists()
    assert [file.name for file in tmp_path.iterdir()] == ["table.tsv"]
    assert path.read_text() == "whole"


def test_failure_leaves_the_older_file_and_nothing_else(tmp_path):
    """Also where the writing itself is interrupted."""
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


def test_full_disk_is_told(tmp_path):
    """The device that is always full stands in."""
    path = tmp_path / "table.tsv"
    (tmp_path / "table.tsv.part").symlink_to("/dev/full")
    with pytest.raises(FileError, match=r"table.tsv: cannot write: No space left .*; see that its"):
        write_table(path, [{"a": 1}])
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("size", [0, 100, -1000, -1])
def test_truncated_netcdf_is_told(tmp_path, size):
    """Empty, cut in its head, and short of its end."""
    path = tmp_path / "data.nc"
    xr.Dataset({"v": ("time", [float(i) for i in range(1000)])}).to_netcdf(path)
    whole = path.read_bytes()
    path.write_bytes(whole[: size % len(whole)])
    with pytest.raises(FileError, match=r"data.nc: cannot be read: .*; remove it and run again"):
        read(path)


def test_problem_with_a_file_ends_a_script_in_one_line(tmp_path):
    """Its details are in the log."""
    with pytest.raises(SystemExit) as end, logged(tmp_path / "log"):
        read(tmp_path / "nowhere.nc")
    assert str(end.value.code).startswith(f"error: {tmp_path}/nowhere.nc: cannot be read: No such")
    assert "\n" not in end.value.code
    assert "Traceback" in (tmp_path / "log").read_text()


@pytest.mark.parametrize("log", ["nowhere/log", "."])
def test_log_that_cannot_be_written_is_told(tmp_path, log):
    """The script does not begin."""
    with pytest.raises(SystemExit, match=r"error: .*; see that its folder"), logged(tmp_path / log):
        raise AssertionError
