# SPDX-License-Identifier: BSD-3-Clause
"""Runs and results as xarray.Datasets."""

import numpy as np
import xarray as xr

from delaykit.version import __version__


def dataset_of_run(run) -> xr.Dataset:
    """A run: each state over time, of a chain over block and time; its events, if it has any."""
    model = run.model
    data = by_state(model, run.y.reshape(model.blocks, len(model.states), len(run.t)), "t")
    if run.t_events:
        numbers = np.repeat(np.arange(len(run.t_events)), [len(one) for one in run.t_events])
        order = np.argsort(np.concatenate(run.t_events), kind="stable")
        times, states = np.concatenate(run.t_events)[order], np.concatenate(run.y_events)[order]
        about = {"long_name": "number of the event, from 0"}
        data["event_number"] = ("event", numbers[order], about)
        data["event_t"] = ("event", times, {"long_name": "time of the event"})
        data |= by_state(model, rows_of(model, states), "event", "event_")
    return xr.Dataset(data, {"t": ("t", run.t, {"long_name": "time"})}, attributes_of(run))


def dataset_of_passages(run, after: float) -> xr.Dataset:
    """The states at the only event of a run, from a time on, and the times between."""
    late = run.t_events[0] >= after
    times = run.t_events[0][late]
    between = np.full(len(times), np.nan)
    between[1:] = np.diff(times)
    data = {
        "t": ("passage", times, {"long_name": "time"}),
        "time_between": ("passage", between, {"long_name": "time since the passage before"}),
    }
    states = rows_of(run.model, run.y_events[0][late])
    return xr.Dataset(data | by_state(run.model, states, "passage"), attrs=attributes_of(run))


def rows_of(model, states: np.ndarray) -> np.ndarray:
    """State vectors, shape (rows, n), as blocks, states and rows."""
    return states.T.reshape(model.blocks, len(model.states), len(states))


def by_state(model, values: np.ndarray, along: str, prefix: str = "") -> dict:
    """Variables of values of shape (blocks, states, along): each state, and its exponential."""
    shown = {state: values[:, i] for i, state in enumerate(model.states)}
    shown |= {name: np.exp(shown[state]) for name, state in model.auxiliary.items()}
    meanings = model.definition["states"] | {k: f"exp({v})" for k, v in model.auxiliary.items()}
    chain = model.blocks > 1 or model.network
    block = "node" if model.network else "block"
    return {
        prefix + name: (
            (block, along) if chain else (along,),
            array if chain else array[0],
            {"long_name": meanings[name]},
        )
        for name, array in shown.items()
    }


def attributes_of(run) -> dict:
    """The model with its parameters, and how it was integrated."""
    definition = run.model.definition
    switches = "; ".join(f"{term}: {count}" for term, count in run.switches.items())
    return {
        "model": definition["name"],
        "model_equations": "; ".join(f"{k}' = {v}" for k, v in definition["equations"].items()),
        **dict(zip(definition["parameters"], run.numbers.tolist(), strict=True)),
        **run.options,
        **run.counts,
        **({"switches": switches} if switches else {}),
        "status": run.status,
        "source": f"delaykit {__version__}",
    }
