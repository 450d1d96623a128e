"""Where results come from: programs, compiler and packages."""

from collections import Counter
from importlib import metadata

from scripts.files.inputs import read

PACKAGES = [
    *("snakemake", "ruamel.yaml", "jsonschema", "f90nml", "numpy", "xarray", "netCDF4"),
    *("matplotlib", "jinja2", "MarkupSafe", "docutils"),
]
"""Python packages that results or the page go through."""


def packages() -> dict[str, str]:
    """Version of each package."""
    return {name: metadata.version(name) for name in PACKAGES}


def programs(files: list[str]) -> list[dict]:
    """Versions and compilers that the files say they were made with."""
    made = Counter()
    for path in files:
        attributes = read(path).attrs
        made[attributes["program_version"], attributes["compiler"]] += 1
    return [
        {"version": version, "compiler": compiler, "files": count}
        for (version, compiler), count in sorted(made.items())
    ]
