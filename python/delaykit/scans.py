# SPDX-License-Identifier: BSD-3-Clause
"""Scans: what is measured of runs, over arrays of parameters and all cores."""

import os
import threading
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from inspect import signature

import numpy as np
import xarray as xr
from tqdm import tqdm

from delaykit.arguments import Arguments, begin
from delaykit.errors import DelaykitError, ModelError, check_name
from delaykit.library import LIBRARY
from delaykit.runs import METHODS, integrate

STACK = 1 << 28
"""Bytes of the stack of a thread: compiled models have their work arrays there."""
PATIENCE = 0.2
"""Seconds between two looks for Ctrl-C."""
UNITS_OF_RUN, SHARE_LEFT_OUT = 400, 0.5
"""Length of a run in units of time where it is not given, and the share that is left out."""


def set_end(model, options: dict) -> None:
    """The end of a run where it is not given."""
    if options.get("t_end") is None:
        own = Arguments(model, options.get("parameters"))
        past = begin(own, options["history"], 0.0, None, (), np.ones(own.n), None).past
        options["t_end"] = UNITS_OF_RUN * own.unit_of_time(past)


def extrema(model, sign: int, options: dict) -> np.ndarray:
    """Values of a state at its maxima or minima after the transient."""
    state = options.pop("state", model.states[0])
    left_out = options.pop("t_transient", None)
    set_end(model, options)
    if left_out is None:
        left_out = SHARE_LEFT_OUT * options["t_end"]
    word = "falling" if sign > 0 else "rising"
    run = model.integrate(events=f"{state}' = 0 {word}", t_eval=(), **options)
    number = model.states.index(model.auxiliary.get(state, state))
    values = run.y_events[0][run.t_events[0] >= left_out, number]
    return np.exp(values) if state in model.auxiliary else values


def final(model, options: dict) -> np.ndarray:
    """The state at the end."""
    set_end(model, options)
    run = model.integrate(**{**options, "t_eval": [options["t_end"]]})
    return run.y[..., -1]


MEASURES: dict[str, tuple[str, Callable]] = {
    "maxima": ("extremum", lambda model, options: extrema(model, 1, options)),
    "minima": ("extremum", lambda model, options: extrema(model, -1, options)),
    "final": ("state", final),
}
"""By name, the dimension of what is measured, and how."""


def scan(
    model, measure="maxima", *, workers=None, progress=True, most=200, **options
) -> xr.Dataset:
    """Measure runs for all combinations of arrays of parameters.

    Parameters are given by name: numbers; arrays, each a dimension of its own name; or DataArrays,
    which broadcast by their dimensions. measure: one of MEASURES, or a function of the model that
    returns a number or a row of numbers. The other options are those of `run`; of maxima and
    minima also `state` and `t_transient`. Without a history each state is 1/2 before the start.
    most: numbers kept of each point.

    A point that fails is not a number, with its reason in `reason`.
    """
    arrays = {
        key: axis(key, options.pop(key))
        for key in list(options)
        if key in model.definition["parameters"]
    }
    known = [*list(signature(integrate).parameters)[1:], "state", "t_transient"]
    for key in options:
        check_name("option", key, [*model.definition["parameters"], *known])
    if not arrays:
        raise ModelError("scan: no parameter varies; expected arrays of parameters by name")
    if callable(measure):
        name, dimension, compute = getattr(measure, "__name__", "value"), "entry", None
    else:
        check_name("measure", measure, MEASURES)
        name, (dimension, compute) = measure, MEASURES[measure]
    options.setdefault("history", dict.fromkeys(model.states, 0.5))
    grids = xr.broadcast(*arrays.values())
    shape = grids[0].shape
    places = [
        {key: float(grid.values[index]) for key, grid in zip(arrays, grids, strict=True)}
        for index in np.ndindex(shape)
    ]

    def measured(values: dict) -> np.ndarray:
        here = model.with_parameters(**values)
        found = measure(here) if compute is None else compute(here, dict(options))
        return np.atleast_1d(np.asarray(found, float)).ravel()[:most]

    # compiled once, before there are threads
    model.reduced(METHODS.get(options.get("method"), "equations")).handle  # noqa: B018
    rows, reasons = in_threads(measured, places, workers, progress)
    width = max(map(len, rows), default=0)
    table = np.full((len(rows), max(width, 1)), np.nan)
    for i, row in enumerate(rows):
        table[i, : len(row)] = row
    dims = grids[0].dims
    about, names = {"long_name": name}, {}
    if dimension == "extremum":
        about = {"long_name": f"{name} of {options.get('state', model.states[0])}"}
    elif dimension == "state" and model.blocks == 1:
        about, names = {"long_name": "state at the end"}, {"state": list(model.states)}
    return xr.Dataset(
        {
            name: ((*dims, dimension), table.reshape(*shape, -1), about),
            "reason": (dims, np.array(reasons).reshape(shape)),
        },
        {key: array for key, array in arrays.items() if array.ndim} | names,
        {"model": model.definition["name"], "measure": name},
    )


def axis(key: str, values) -> xr.DataArray:
    """An array of a parameter."""
    if isinstance(values, xr.DataArray):
        array = values
    else:
        numbers = np.asarray(values)
        array = xr.DataArray(numbers, dims=(key,) if numbers.ndim == 1 else None)
    if not array.size:
        raise ModelError(f"parameter {key}: no values; expected one at least")
    if array.dtype.kind not in "iuf" or (not isinstance(values, xr.DataArray) and array.ndim > 1):
        raise ModelError(f"parameter {key}: {values!r}; expected a number or a row of numbers")
    if list(array.dims) == [key]:
        array = array.assign_coords({key: array.values.astype(float)})
    return array.astype(float)


def in_threads(compute: Callable, places: list, workers: int | None, progress: bool):
    """What is computed at each place, and why nothing was where it failed."""
    rows: list = [np.empty(0)] * len(places)
    reasons = [""] * len(places)
    before = threading.stack_size(STACK)
    LIBRARY.dk_stop(0)
    pool = ThreadPoolExecutor(workers or os.cpu_count())
    try:
        todo: dict[Future, int] = {pool.submit(compute, one): i for i, one in enumerate(places)}
        with tqdm(total=len(todo), disable=not progress) as bar:
            while todo:
                # woken now and then: Ctrl-C may come to another thread
                for done in wait(todo, PATIENCE, FIRST_COMPLETED).done:
                    number = todo.pop(done)
                    bar.update()
                    try:
                        rows[number] = done.result()
                    except (DelaykitError, ArithmeticError, LookupError, ValueError) as problem:
                        reasons[number] = str(problem) or type(problem).__name__
    except BaseException:
        LIBRARY.dk_stop(1)
        pool.shutdown(wait=True, cancel_futures=True)
        LIBRARY.dk_stop(0)
        raise
    finally:
        threading.stack_size(before)
    pool.shutdown()
    return rows, reasons
