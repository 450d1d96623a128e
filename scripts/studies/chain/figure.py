"""The drawing of chains, and the numbers of its caption."""

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, NullFormatter

from scripts.drawing import parameters
from scripts.drawing.roots import roots_in_words
from scripts.drawing.wording import as_formulas, place_in_words, short
from scripts.studies.chain.table import (
    ALIKE,
    first_mode,
    moves_alike,
    powers_of,
    rests,
    strongest_mode,
)

SHOWN = 150.0
"""Time at the end that the maps show."""
DECADE = 10.0
"""Mean squares that span less have labels between powers of ten."""
FLAT = 1e-6
"""ln v that is as near to 0 has no colour."""


def draw(chains: list[xr.Dataset], roots: list[xr.Dataset]) -> Figure:
    """Rows a, b, ...: ln v at the end, the spread over the blocks, the power of the modes."""
    figure, grid = plt.subplots(
        len(chains),
        3,
        figsize=(6.7, 0.3 + 2.0 * len(chains)),
        width_ratios=[1.7, 1, 1],
        squeeze=False,
    )
    for number, (chain, panels) in enumerate(zip(chains, grid, strict=True)):
        name = chain.attrs["scene"].replace("_", " ")
        words = parameters.in_words(chain.attrs)
        panels[0].set_title(
            f"$\\bf{{{chr(ord('a') + number)}}}$  {name}: {chain.attrs['blocks']} blocks,"
            f" $\\kappa = {parameters.number(chain.attrs['kappa'])}$,"
            f" ends: {chain.attrs['ends']}\n{words}"
        )
        draw_map(figure, panels[0], chain)
        draw_spread(panels[1], chain)
        draw_modes(panels[2], chain)
    for axes in grid[-1, :2]:
        axes.set_xlabel("time (units of $L/v_0$)")
    grid[-1, 2].set_xlabel("number of the mode")
    return figure


def draw_map(figure: Figure, axes: Axes, chain: xr.Dataset) -> None:
    """ln v over time and block at the end of the run."""
    last = chain.sel(t=slice(float(chain.t[-1]) - SHOWN, None))
    values = np.log(last.v.values.T)
    # v may span many powers of ten below 1, and few above
    ends = {"vmin": min(float(values.min()), -FLAT), "vmax": max(float(values.max()), FLAT)}
    shades = axes.pcolormesh(
        last.t.values,
        1 + np.arange(values.shape[0]),
        values,
        cmap="RdBu_r",
        norm=TwoSlopeNorm(vcenter=0.0, **ends),
        shading="nearest",
        rasterized=True,
    )
    axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    axes.set_ylabel("block")
    figure.colorbar(shades, ax=axes, label=r"$\ln v$", pad=0.02)


def draw_spread(axes: Axes, chain: xr.Dataset) -> None:
    """The standard deviation of ln v over the blocks."""
    spread = np.log(chain.v).std("block").values
    axes.semilogy(chain.t, np.maximum(spread, ALIKE), lw=0.3, rasterized=True)
    axes.set_ylabel(r"spread of $\ln v$")


def draw_modes(axes: Axes, chain: xr.Dataset) -> None:
    """The mean square of each mode of ln v after the transient."""
    powers = powers_of(chain)
    axes.semilogy(first_mode(chain) + np.arange(powers.size), powers, "o-", ms=2.5, lw=0.7)
    axes.xaxis.set_major_locator(MaxNLocator(5, integer=True))
    if powers.max() > DECADE * powers.min():
        axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_ylabel("mean square")


def motion_in_words(chain: xr.Dataset) -> str:
    """Whether the blocks move alike, and else the mode that moves most beside their mean."""
    if rests(chain):
        return "all blocks come to rest"
    if moves_alike(chain):
        return "all blocks move alike"
    mode, share = strongest_mode(chain)
    return (
        f"blocks move differently, mode {mode} most; {short(100 * share, 2)} % of the mean square"
        " is in modes beside the mean"
    )


def numbers(chains: list[xr.Dataset], roots: list[xr.Dataset]) -> dict:
    """What each chain does, and whether it is stable at rest."""
    return {
        "chains": [
            {
                "name": chain.attrs["scene"].replace("_", " "),
                "blocks": int(chain.attrs["blocks"]),
                "place": place_in_words(chain.attrs),
                "motion": motion_in_words(chain),
                "roots": as_formulas(roots_in_words(of_modes)),
            }
            for chain, of_modes in zip(chains, roots, strict=True)
        ],
        "shown": SHOWN,
    }
