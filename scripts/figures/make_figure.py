"""Calls of the functions of figures, with the results and settings that their arguments name."""

import inspect
from collections.abc import Callable, Mapping
from pathlib import Path

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


def make_figure(draw: Callable, job) -> None:
    """Draw and save the figure of a rule; `job` is the object `snakemake` of the script."""
    with logged(job.log[0]):
        save(call(draw, dict(job.input.items()), dict(job.params.items())), job.output)
