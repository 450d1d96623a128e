"""NetCDF files that scripts read."""

from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from scripts.files.outputs import FileError

# takes half a second to load, and planning knows functions of data by name alone
if TYPE_CHECKING:
    import xarray

Dataset: TypeAlias = "xarray.Dataset"
DataArray: TypeAlias = "xarray.DataArray"


def read(path: str | Path) -> Dataset:
    """All of a NetCDF file. Raises FileError; a damaged file is removed and so made again."""
    import xarray as xr

    try:
        return xr.load_dataset(path, engine="netcdf4")
    except (OSError, RuntimeError) as problem:
        reason = getattr(problem, "strerror", problem)
        # the numbers of NetCDF's own errors are negative; a wrong checksum has none
        if getattr(problem, "errno", -1) < 0:
            Path(path).unlink()
            reason = f"{reason}; it was damaged and is removed"
        raise FileError(
            f"{path}: cannot be read: {reason}; run the same command again"
        ) from problem
