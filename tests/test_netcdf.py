"""NetCDF files of the results follow the CF conventions, and can be read without further work."""

import subprocess

import pytest
import xarray as xr

from conftest import ROOT
from scripts.plans import studies

CHECKER = ROOT / "tests" / "formats" / ".venv" / "bin" / "compliance-checker"
KINDS = {run.output.partition("/{")[0] for run in studies.runs() if run.output.endswith(".nc")}
"""Folders with NetCDF files, each with those of one run."""


@pytest.fixture(scope="module")
def files(smoke) -> dict[str, str]:
    """The largest file of each kind, as path from the results."""
    results = smoke.folder / "results"
    found: dict[str, str] = {}
    for path in sorted(results.rglob("*.nc"), key=lambda path: path.stat().st_size):
        name = path.relative_to(results).as_posix()
        (kind,) = (kind for kind in KINDS if name.startswith(f"{kind}/"))
        found[kind] = name
    return found


@pytest.mark.skipif(
    not CHECKER.exists(),
    reason="`tools/setup/setup.sh tests/formats` sets it up, and so does ./test",
)
def test_files_follow_the_cf_conventions(smoke, files):
    """All recommendations, too, by the checker of IOOS and the table of standard names it ships."""
    assert set(files) == KINDS
    command = [CHECKER, "--test=cf:1.8", "--criteria=strict", *files.values()]
    run = subprocess.run(
        command, cwd=smoke.folder / "results", capture_output=True, text=True, timeout=300
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert run.stdout.count("All tests passed!") == len(files), run.stdout


def test_readers_agree(smoke, files):
    """netCDF4 and h5netcdf, by xarray: units of one letter are texts, and times are numbers."""
    for name in files.values():
        path = smoke.folder / "results" / name
        found, other = (xr.load_dataset(path, engine=e) for e in ("netcdf4", "h5netcdf"))
        xr.testing.assert_identical(found, other)
        values = other.variables.values()
        assert {type(one.attrs.get("units", "")) for one in values} == {str}
        assert {"m", "M"}.isdisjoint(one.dtype.kind for one in values)


def test_files_name_their_origin(smoke, files):
    for name in files.values():
        attributes = xr.open_dataset(smoke.folder / "results" / name).attrs
        assert attributes["Conventions"] == "CF-1.8"
        command = attributes["source"].split()[1]
        assert (ROOT / "fortran" / "src" / "commands" / f"{command}_command.f90").exists()
        assert attributes["source"].endswith(attributes["program_version"])
        assert "Time-delay in spring-block model" in attributes["references"]
        assert "20" not in attributes["history"]
