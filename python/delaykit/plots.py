# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of results by matplotlib, an optional part of the package."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from delaykit.errors import DelaykitError, ModelError

MARKERS = "osD^v<>PX*"


def plot(found: xr.Dataset, ax=None):
    """Draw exponents, Hopf curves, cycles, a scan, a spectrum, a section, or a run of a network.

    ax: axes of matplotlib; a new figure unless given. Returns the axes. A run of few states has
    plots of its own: `run.y.plot()`.
    """
    known = {
        "running_average": exponents,
        "map_unstable_roots": hopf,
        "multiplier_real": cycles,
        "reason": scan,
        "density": spectrum,
        "time_between": section,
    }
    draw = next((draw for name, draw in known.items() if name in found), None)
    if draw is None and any(one.dims[1:] == ("t",) for one in found.values()):
        draw = nodes
    if draw is None:
        raise ModelError(
            "plot: expected results of exponents, hopf, cycle, scan, spectrum or section, or a run "
            "of a network; a variable of another run draws itself, as run.y.plot()"
        )
    if ax is None:
        try:
            from matplotlib import pyplot
        except ImportError:
            raise DelaykitError("plot: needs matplotlib; pip install matplotlib") from None
        ax = pyplot.subplots(layout="constrained")[1]
    draw(found, ax)
    return ax


def exponents(found: xr.Dataset, ax) -> None:
    """Running averages, and the values at the end with two standard errors."""
    end = float(found.t[-1])
    for i, (value, error) in enumerate(zip(found.value.values, found.error.values, strict=True)):
        color = f"C{i}"
        ax.plot(found.t, found.running_average.isel(exponent=i), color=color)
        ax.errorbar(
            end, value, 2 * error, color=color, marker="o", markersize=4, capsize=3,
            label=f"{value:.2g} ± {error:.1g}" if error else f"{value:.2g}",
        )  # fmt: skip
    ax.axhline(0, color="0.7", linewidth=0.8, zorder=0)
    # the first averages are over a few intervals
    late = found.running_average.where(found.t > found.t[0] + 0.1 * (found.t[-1] - found.t[0]))
    low, high = float(late.min()), float(late.max())
    ax.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))
    ax.set(xlabel="time", ylabel="Lyapunov exponent, average up to a time")
    legend(ax, "at the end")


def hopf(found: xr.Dataset, ax) -> None:
    """Curves by the sign of l1, special points, and the number of unstable roots between them."""
    from matplotlib.colors import BoundaryNorm
    from matplotlib.ticker import MaxNLocator

    x, y = found.attrs["abscissa"], found.attrs["ordinate"]
    roots = found.map_unstable_roots
    most = int(roots.max())
    norm = BoundaryNorm(np.arange(-0.5, most + 1.5), 256) if most else None
    shown = ax.pcolormesh(
        found.map_abscissa, found.map_ordinate, roots, cmap="Greys", norm=norm, alpha=0.5
    )
    if most:
        ax.figure.colorbar(shown, ax=ax, label="unstable roots", ticks=MaxNLocator(6, integer=True))
    signs = np.nan_to_num(np.sign(found.l1.values)).astype(int)
    words = {-1: ("C0", "supercritical"), 1: ("C3", "subcritical"), 0: ("0.3", "l1 unknown")}
    for part in stretches(found.piece.values, signs):
        color, word = words[signs[part.start]]
        ax.plot(found[x][part], found[y][part], color=color, label=word)
    special(found, ax, x, y)
    ax.set(xlabel=x, ylabel=y)
    legend(ax)


def cycles(found: xr.Dataset, ax) -> None:
    """The greatest signal of cycles, stable solid and unstable dashed, and special points."""
    x, y = found.attrs["along"], f"{found.attrs['signal']}_most"
    stable = found.unstable.values == 0
    for part in stretches(found.branch.values, stable):
        number = int(found.branch[part.start])
        style, word = ("-", "stable") if stable[part.start] else ("--", "unstable")
        ax.plot(found[x][part], found[y][part], style, color=f"C{number - 1}")
        ax.plot([], [], style, color="0.3", label=word)
    special(found, ax, x, y)
    ax.set(xlabel=x, ylabel=found[y].attrs["long_name"])
    legend(ax)


def scan(found: xr.Dataset, ax) -> None:
    """What was measured over the parameter, in dots."""
    name = found.attrs["measure"]
    values = found[name]
    if values.ndim != 2:
        raise ModelError(
            f"plot: a scan over {', '.join(map(str, found.reason.dims))}; expected one parameter, "
            "the others selected with .isel(...) or .sel(...)"
        )
    x, each = values.dims
    lines = ax.plot(found[x], values, ".", markersize=2, color=None if each == "state" else "C0")
    ax.set(xlabel=x, ylabel=values.attrs["long_name"])
    if each in values.coords:
        ax.legend(lines, values[each].values, framealpha=0.85, fontsize="small")


def spectrum(found: xr.Dataset, ax) -> None:
    """The density, and its peaks."""
    ax.semilogy(found.frequency[1:], found.density[1:], linewidth=0.8)
    ax.plot(found.peak_frequency, found.peak_density, "v", color="C3", markersize=4, label="peaks")
    ax.set(xlabel="frequency (turns in a unit of time)", ylabel=found.density.attrs["long_name"])
    legend(ax)


def section(found: xr.Dataset, ax) -> None:
    """The map of times between passages: each over the one before."""
    between = found.time_between.values[1:]
    ax.plot(between[:-1], between[1:], ".", markersize=3)
    ax.axline((between.mean(), between.mean()), slope=1, color="0.7", linewidth=0.8, zorder=0)
    ax.set(xlabel="time between passages", ylabel="the next time between passages")


def nodes(found: xr.Dataset, ax) -> None:
    """The first state of all nodes over time, in colours."""
    name, values = next((name, one) for name, one in found.items() if one.dims[1:] == ("t",))
    places = np.arange(len(values))
    shown = ax.pcolormesh(found.t, places, values, shading="nearest", rasterized=True)
    ax.figure.colorbar(shown, ax=ax, label=values.attrs.get("long_name", name))
    ax.set(xlabel="time", ylabel=str(values.dims[0]))


def special(found: xr.Dataset, ax, x: str, y: str) -> None:
    """Special points, a marker for each kind."""
    kinds = found.special_kind.values
    for marker, kind in zip(MARKERS, dict.fromkeys(kinds.tolist()), strict=False):
        chosen = np.flatnonzero(kinds == kind)
        at, value = found[f"special_{x}"][chosen], found[f"special_{y}"][chosen]
        word = kind.replace("_", " ").replace("hopf", "Hopf")
        ax.plot(at, value, marker, color="k", markersize=5, label=word)


def stretches(group: np.ndarray, flag: np.ndarray) -> Iterator[slice]:
    """Where a group and a flag stay the same, with the next point if that is of the group."""
    first = 0
    for i in range(1, len(group) + 1):
        if i < len(group) and group[i] == group[first] and flag[i] == flag[first]:
            continue
        yield slice(first, i + (i < len(group) and group[i] == group[first]))
        first = i


def legend(ax, title: str | None = None) -> None:
    """A legend without repetition."""
    handles, labels = ax.get_legend_handles_labels()
    if each := dict(zip(labels, handles, strict=True)):
        ax.legend(each.values(), each.keys(), title=title, framealpha=0.85, fontsize="small")
