"""The drawing of the least epsilon over gamma, and the numbers of its caption."""

from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing import parameters
from scripts.drawing.style import FAINT, INK
from scripts.tables.ranges_of_gamma import FAULTS, PAPER

MOST = 1e6
"""End of the axis; beyond it nothing changes."""


def draw(table: list[dict]) -> Figure:
    """The least epsilon of the Hopf curves on the left, its distance from no delay on the right."""
    rows = [row for row in table if row["gamma"] <= 1.001 * MOST]
    gamma, without, least, depth, formula = (
        [row[key] for row in rows]
        for key in ("gamma", "without_delay", "least", "depth", "leading_order")
    )
    xi = rows[0]["xi"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.7, 2.9))
    left.axhline(xi, color=FAINT, ls="--", label=r"$k_c = (B - A)/L$: $\varepsilon = \xi$")
    left.fill_between(gamma, least, without, color="C1", alpha=0.3, lw=0)
    left.plot(gamma, without, color="C0", label="Hopf point without delay")
    left.plot(gamma, least, color="C1", label="least on all Hopf curves")
    left.set(ylabel=parameters.axis_of("epsilon"), ylim=(0, 1.4 * xi))
    left.text(30, 1.1 * xi, "unstable without delay")
    left.text(30, 0.6 * xi, "stable at every delay")
    band = gamma.index(PAPER)
    left.annotate(
        "unstable at\nsome delays",
        (PAPER, (without[band] + least[band]) / 2),
        (2.5, 0.35 * xi),
        arrowprops={"arrowstyle": "-", "color": INK, "lw": 0.7},
    )
    left.legend(loc="lower right")
    right.loglog(gamma, depth, color="C1", label="computed")
    right.loglog(gamma, formula, color=INK, ls=":", label=r"$\xi^3 (1 + \xi)/(2 \gamma^4)$")
    right.set(
        ylabel=r"$\varepsilon$ without delay $-$ least $\varepsilon$", ylim=(0.1 * depth[-1], 1e3)
    )
    right.legend(loc="lower left")
    for axes, words in (
        (left, f"$\\xi = {parameters.number(xi)}$"),
        (right, "height of the coloured band"),
    ):
        letter = "a" if axes is left else "b"
        axes.set_title(f"$\\bf{{{letter}}}$  {words}")
        mark(axes)
    return figure


def mark(axes: Axes) -> None:
    """The paper's gamma, and those of real faults."""
    axes.axvspan(FAULTS[0], MOST, color=FAINT, alpha=0.25, lw=0, zorder=0)
    axes.axvline(PAPER, color=FAINT, lw=0.8, zorder=0)
    place = {"transform": axes.get_xaxis_transform(), "va": "top", "fontsize": 8}
    axes.text(1.15 * PAPER, 0.98, "paper", **place)
    axes.text(1.3 * FAULTS[0], 0.98, "real faults", **place)
    axes.set(xscale="log", xlim=(0.1, MOST), xlabel=parameters.axis_of("gamma"))


def numbers(table: list[dict]) -> dict:
    """Rows at the paper's gamma and at the least one of real faults."""
    rows = {row["gamma"]: row for row in table}
    return {"at_paper": rows[PAPER], "at_faults": rows[FAULTS[0]]}
