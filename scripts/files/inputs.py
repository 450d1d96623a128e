"""NetCDF files that scripts read."""

from pathlib import Path

import xarray as xr

from scripts.files.outputs import FileError


def with_law_in_words(data: xr.Dataset) -> xr.Dataset:
    """The data with the values of the law's own parameters beside its name."""
    own = data.attrs.get("law_parameters", "").split()
    if own:
        values = ", ".join(f"{name} = {data.attrs[f'law_{name}']:g}" for name in own)
        data.attrs["law"] += f" ({values})"
    return data


def read(path: str | Path) -> xr.Dataset:
    """All of a NetCDF file. Raises FileError; a damaged file is removed and so made again."""
    try:
        return with_law_in_words(xr.load_dataset(path, engine="netcdf4"))
    except (OSError, RuntimeError) as problem:
        reason = getattr(problem, "strerror", problem)
        # the numbers of NetCDF's own errors are negative; a wrong checksum has none
        if getattr(problem, "errno", -1) < 0:
            Path(path).unlink()
            reason = f"{reason}; it was damaged and is removed"
        raise FileError(
            f"{path}: cannot be read: {reason}; run the same command again"
        ) from problem
