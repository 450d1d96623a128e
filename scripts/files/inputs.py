"""What scripts read."""

from pathlib import Path

import xarray as xr

from scripts.files.outputs import FileError


def read(path: str | Path) -> xr.Dataset:
    """All of a NetCDF file."""
    try:
        return xr.load_dataset(path, engine="netcdf4")
    except (OSError, RuntimeError) as problem:
        # netCDF4 raises the latter where a checksum does not match
        reason = getattr(problem, "strerror", problem)
        raise FileError(
            f"{path}: cannot be read: {reason}; remove it; the next run makes it again"
        ) from problem
