"""Python packages that results or the page go through."""

import os
import sys
from importlib import metadata
from pathlib import Path

PACKAGES = [
    "snakemake",
    "ruamel.yaml",
    "jsonschema",
    "f90nml",
    "numpy",
    "xarray",
    "netCDF4",
    "matplotlib",
    "jinja2",
    "MarkupSafe",
    "docutils",
]


class PackageError(ValueError):
    """Packages that are not installed, or not as they are expected."""


def versions() -> dict[str, str]:
    """Version of each package."""
    return {name: metadata.version(name) for name in PACKAGES}


def refuse_missing() -> None:
    """Raise PackageError where Python lacks some of them."""
    installed = {each.name.lower() for each in metadata.distributions() if each.name}
    missing = [name for name in PACKAGES if name.lower() not in installed]
    if missing:
        raise PackageError(
            f"{sys.executable} lacks {', '.join(missing)}; run ./reproduce, which sets up what is"
            " missing; if it did so before, run . .venv/bin/activate"
        )


def let_jobs_import(folder: str | Path) -> None:
    """Put the project's folder first where Python looks for packages in the scripts of jobs."""
    before = os.environ.get("PYTHONPATH")
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(folder), before]))
