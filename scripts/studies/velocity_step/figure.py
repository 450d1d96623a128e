"""The drawing of friction after a velocity step (Figure 8), and the numbers of its caption."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing.style import FAINT, INK
from scripts.drawing.wording import short
from scripts.studies.velocity_step.table import columns_of, effects_of

ARROW = {"arrowstyle": "<->", "shrinkA": 0, "shrinkB": 0}


def draw(response: list[dict]) -> Figure:
    """Imposed velocity above, friction below, over slip in units of Dc."""
    figure, (top, bottom) = plt.subplots(
        2, 1, figsize=(5.2, 3.9), sharex=True, height_ratios=[1, 2.4]
    )
    columns = columns_of(response)
    v0, dv = columns["v0"][0], columns["delta_v"][0]
    slip, mu = columns["slip"] / columns["dc"], columns["mu"]
    top.plot(slip, columns["velocity"] * 1e6, color="C0")
    top.set(ylabel="imposed $v$ (µm/s)", ylim=(0, 1.25e6 * (v0 + dv)))
    steps = np.flatnonzero(np.diff(columns["velocity"])) + 1
    top.text(slip[0] + 0.2, 1.3e6 * v0, "$v_0$", va="bottom")
    top.text(slip[steps[0]] + 0.2, 1.03e6 * (v0 + dv), r"$v_0 + \Delta v$", va="bottom")

    bottom.plot(slip, mu, color="C1")
    mark_effects(bottom, slip, mu, steps)
    mark_dc(bottom, slip, mu, steps)
    bottom.set(xlabel="slip / $D_c$", ylabel=r"friction coefficient $\mu$")
    bottom.set_xlim(slip[0], slip[-1])
    bottom.margins(y=0.1)
    return figure


def mark_effects(axes: Axes, slip: np.ndarray, mu: np.ndarray, steps: np.ndarray) -> None:
    """The jump (direct effect) and the slow return (evolution effect) of each step, as arrows."""
    dots = {"color": FAINT, "lw": 0.6, "ls": ":"}
    ends = [*steps[1:], mu.size]
    for step, end in zip(steps, ends, strict=True):
        before, peak, after = mu[step - 1], mu[step], mu[end - 1]
        jump, fall = slip[step], slip[end - 1] - 2.2
        axes.plot([jump - 1.2, jump], [before, before], **dots)
        axes.plot([jump - 0.6, jump], [peak, peak], **dots)
        axes.plot([jump, fall + 0.3], [peak, peak], **dots)
        for name, x, start, stop in (
            ("direct", jump - 0.35, before, peak),
            ("evolution", fall, peak, after),
        ):
            axes.annotate("", (x, start), (x, stop), arrowprops={**ARROW, "color": INK, "lw": 0.7})
            middle = (x - 0.15, (start + stop) / 2)
            axes.text(*middle, f"{name}\neffect", ha="right", va="center", fontsize=7)


def mark_dc(axes: Axes, slip: np.ndarray, mu: np.ndarray, steps: np.ndarray) -> None:
    """Slip of one Dc after the up-step."""
    start = slip[steps[0]]
    y = mu.min() + 0.04 * (mu.max() - mu.min())
    arrow = {**ARROW, "color": "C0", "lw": 0.9}
    axes.annotate("", (start, y), (start + 1, y), arrowprops=arrow)
    for x, top in ((start + 1, np.interp(start + 1, slip, mu)), (start, mu[steps[0] - 1])):
        axes.plot([x, x], [y, top], color="C0", lw=0.5, ls=":")
    axes.annotate(
        "$D_c$",
        (start + 0.5, y),
        xytext=(0, 4),
        textcoords="offset points",
        color="C0",
        ha="center",
    )


def numbers(response: list[dict]) -> dict:
    """Sizes of both effects, friction before the step, and velocities in micrometres a second."""
    columns = columns_of(response)
    direct, evolution = effects_of(columns)
    v0 = columns["v0"][0]
    return {
        "direct": short(direct),
        "evolution": short(evolution),
        "before": short(columns["mu"][0], 4),
        "mu0": short(columns["mu0"][0]),
        "least": short(1e6 * v0),
        "most": short(1e6 * (v0 + columns["delta_v"][0])),
    }
