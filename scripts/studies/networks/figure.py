"""The drawing of a network's run, and the numbers of its caption."""

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from scripts.drawing import parameters
from scripts.drawing.wording import place_in_words, short

SHOWN = 2000
"""Samples at the end that are shown: of more than the figure has pixels waves would look slow."""


def states_of(run: xr.Dataset) -> list[xr.DataArray]:
    """The end of the run, without its transient: each state, shape (node, t)."""
    late = run.sel(t=slice(run.attrs["t_transient"], None)).isel(t=slice(-SHOWN, None))
    return [one.transpose("node", "t") for one in late.values() if one.dims[0] == "t"]


def draw(runs: list[xr.Dataset]) -> Figure:
    """Rows of states: their values over time and node, and the same less their mean."""
    (run,) = runs
    states = states_of(run)
    figure, grid = plt.subplots(
        len(states), 2, figsize=(6.7, 0.5 + 2.0 * len(states)), squeeze=False, sharex=True
    )
    for state, (values, others) in zip(states, grid, strict=True):
        symbol = parameters.symbol_of(str(state.name))
        draw_map(values, state, f"${symbol}$", cmap="viridis")
        apart = state - state.mean("node")
        most = float(np.abs(apart).max()) or 1.0
        label = f"${symbol}$ less its mean"
        draw_map(others, apart, label, cmap="RdBu_r", vmin=-most, vmax=most)
    for axes in grid[-1]:
        axes.set_xlabel("time $t$")
    name = run.attrs["scene"].replace("_", " ")
    words = parameters.in_words(run.attrs)
    figure.suptitle(f"scene {name}: {run.attrs['nodes']} nodes, {words}", fontsize=8)
    return figure


def draw_map(axes: Axes, values: xr.DataArray, label: str, **colours) -> None:
    """Values over time and node."""
    numbers = np.arange(values.sizes["node"])
    shades = axes.pcolormesh(
        values.t.values, numbers, values.values, shading="nearest", rasterized=True, **colours
    )
    axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    axes.set_ylabel("node")
    axes.figure.colorbar(shades, ax=axes, label=label, pad=0.02)


def numbers(runs: list[xr.Dataset]) -> dict:
    """Range of each state at the end, and how far nodes are apart."""
    (run,) = runs
    states = states_of(run)
    spreads = [one.std("node") for one in states]
    return {
        "nodes": int(run.attrs["nodes"]),
        "place": place_in_words(run.attrs),
        "shown": short(states[0].t[-1] - states[0].t[0]),
        "states": [
            {
                "name": one.name,
                "least": short(one.min()),
                "most": short(one.max()),
                "spread": short(spread.mean()),
                "end": short(spread[-1]),
            }
            for one, spread in zip(states, spreads, strict=True)
        ],
    }
