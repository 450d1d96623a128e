"""The figure of a rule; functions of figures get what their arguments name."""

import inspect
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from types import ModuleType

import xarray as xr

from scripts.drawing.style import logged, save
from scripts.files.inputs import read
from scripts.files.tsv import read_table


def contents_of(paths: str | Path | list) -> xr.Dataset | list:
    """A data set, the rows of a table, or a list of these, by the endings of the paths."""
    if not isinstance(paths, str | Path):
        return [contents_of(path) for path in paths]
    return read(paths) if Path(paths).suffix == ".nc" else read_table(paths)


def call(function: Callable, inputs: Mapping, params: Mapping):
    """Call a function with what its arguments name: contents of inputs, or params."""
    names = inspect.signature(function).parameters
    return function(
        **{name: contents_of(inputs[name]) if name in inputs else params[name] for name in names}
    )


def drawing_of(module: str) -> ModuleType:
    """The module of this name in the package of studies, which draws."""
    return import_module(f"scripts.studies.{module}")


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        inputs, params = dict(snakemake.input.items()), dict(snakemake.params.items())
        save(call(drawing_of(params["module"]).draw, inputs, params), snakemake.output)
