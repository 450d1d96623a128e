"""Whether blocks that move alike stay alike: growth of disturbances over the stiffness of modes."""

import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from scripts.drawing.style import INK
from scripts.figures.wording import with_error

MARKS = ["o", "s", "^", "D", "v", "P"]


def inputs(config: dict) -> dict:
    """Growth along the motion of each scene."""
    return {
        "growth": [f"<results>/synchrony/{scene}.nc" for scene in config["synchrony"]["scenes"]]
    }


def draw(growth: list[xr.Dataset]) -> Figure:
    """The largest exponent over s, a line for each scene, with its zeros."""
    figure, (whole, near) = plt.subplots(1, 2, figsize=(6.7, 3.2), sharex=True)
    for axes in (whole, near):
        for number, one in enumerate(growth):
            axes.errorbar(
                one.s,
                one.exponent,
                3 * one.error,
                marker=MARKS[number % len(MARKS)],
                ms=2.5,
                lw=0.8,
                elinewidth=0.6,
                color=f"C{number}",
                label=one.attrs["scene"].replace("_", " "),
            )
            axes.plot(one.zero_s, 0 * one.zero_s, ls="", marker="|", ms=9, color=f"C{number}")
        axes.axhline(0, color=INK, lw=0.5)
        axes.set_xscale("log")
        axes.set_xlabel(r"stiffness of the mode $s = 1 + \kappa \mu$")
    most = max(float(one.exponent.max()) for one in growth)
    near.set_ylim(-1.2 * most, 1.4 * most)
    near.set_title("$\\bf{b}$  the same near 0")
    whole.set_title("$\\bf{a}$")
    whole.set_ylabel("largest exponent\nof disturbances")
    handles, labels = whole.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4)
    return figure


def numbers(growth: list[xr.Dataset]) -> dict:
    """Where each scene's exponent is zero, and what a chain does between."""
    return {
        "scenes": [
            {"name": one.attrs["scene"].replace("_", " "), "zeros": zeros_in_words(one)}
            for one in growth
        ]
    }


def zeros_in_words(one: xr.Dataset) -> str:
    """The zeros with their errors, and whether modes beyond are stable."""
    if one.sizes["zero"] == 0:
        largest = float(one.exponent.isel(s=slice(1, None)).max())
        return "no zero: " + ("some modes grow" if largest > 0 else "no mode grows")
    rises = one.zero_rises.values.astype(bool)
    return "; ".join(
        f"zero at s = {with_error(float(s), float(bar))}, beyond it disturbances"
        f" {'grow' if up else 'decay'}"
        for s, bar, up in zip(one.zero_s, one.zero_error, rises, strict=True)
    )
