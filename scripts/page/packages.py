"""Python packages that results or the page go through."""

from importlib import metadata

PACKAGES = [
    *("snakemake", "ruamel.yaml", "jsonschema", "f90nml", "numpy", "xarray", "netCDF4"),
    *("matplotlib", "jinja2", "MarkupSafe", "docutils"),
]


def versions() -> dict[str, str]:
    """Version of each package."""
    return {name: metadata.version(name) for name in PACKAGES}
