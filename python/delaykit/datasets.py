"""Runs and results as xarray.Datasets."""

import numpy as np
import xarray as xr

from delaykit.version import __version__


def dataset_of_run(run) -> xr.Dataset:
    """A run: each state over time, of a chain over block and time."""
    model = run.model
    states, blocks = model.states, model.blocks
    values = run.y.reshape(blocks, len(states), len(run.t))
    shown = {state: values[:, i] for i, state in enumerate(states)}
    shown |= {name: np.exp(shown[state]) for name, state in model.auxiliary.items()}
    meanings = {**model.definition["states"], **{k: f"exp({v})" for k, v in model.auxiliary.items()}}
    dims = ("block", "t") if blocks > 1 else ("t",)
    attributes = {
        "model": model.definition["name"],
        "model_equations": "; ".join(f"{k}' = {v}" for k, v in model.definition["equations"].items()),
        **dict(zip(model.definition["parameters"], run.numbers.tolist(), strict=True)),
        **run.options,
        **run.counts,
        "status": run.status,
        "source": f"delaykit {__version__}",
    }
    return xr.Dataset(
        {
            name: (dims, array if blocks > 1 else array[0], {"long_name": meanings[name]})
            for name, array in shown.items()
        },
        {"t": ("t", run.t, {"long_name": "time"})},
        attributes,
    )
