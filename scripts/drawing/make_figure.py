"""The figure of a rule and the numbers of its caption; functions get what their arguments name."""

import inspect
import json
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from types import ModuleType

import xarray as xr

from scripts.drawing.style import logged, save
from scripts.files.inputs import read
from scripts.files.outputs import written
from scripts.files.tsv import read_table


def contents_of(paths: str | Path | list) -> xr.Dataset | list:
    """A data set, the rows of a table, or a list of these, by the endings of the paths."""
    if not isinstance(paths, str | Path):
        return [contents_of(path) for path in paths]
    return read(paths) if Path(paths).suffix == ".nc" else read_table(paths)


def call(function: Callable, given: Mapping):
    """Call a function with what its arguments name."""
    return function(**{name: given[name] for name in inspect.signature(function).parameters})


def drawing_of(module: str) -> ModuleType:
    """The module of this name in the package of studies, which draws."""
    return import_module(f"scripts.studies.{module}")


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        given = dict(snakemake.params.items())
        given |= {name: contents_of(paths) for name, paths in snakemake.input.items()}
        module = drawing_of(given["module"])
        save(call(module.draw, given), snakemake.output)
        numbers = call(getattr(module, "numbers", lambda: {}), given)
        with written(snakemake.output.numbers) as file:
            # those of NumPy as Python's own
            file.write_text(json.dumps(numbers, default=lambda one: one.tolist()), encoding="utf-8")
