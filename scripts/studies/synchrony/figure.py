"""The drawing of growth of disturbances of modes, and the numbers of its caption."""

import math

import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from scripts.drawing.style import INK
from scripts.drawing.wording import joined

KAPPAS = (0.1, 1.0, 10.0)
"""Spring constants between neighbours at which the largest chains are named."""
MOST_ACCURATE = 1e-6
"""An error below this is not named."""
MARKS = ["o", "s", "^", "D", "v", "P"]


def draw(growth: list[xr.Dataset]) -> Figure:
    """The largest exponent over s, with its zeros: points, joined by the curve of multipliers."""
    figure, (whole, near) = plt.subplots(1, 2, figsize=(6.7, 3.2), sharex=True)
    for axes in (whole, near):
        for number, one in enumerate(growth):
            by_multipliers = has_multipliers(one)
            axes.errorbar(
                one.s,
                one.exponent,
                3 * one.error,
                marker=MARKS[number % len(MARKS)],
                ms=2.5,
                lw=0 if by_multipliers else 0.8,
                elinewidth=0.6,
                color=f"C{number}",
                label=one.attrs["scene"].replace("_", " "),
            )
            if by_multipliers:
                axes.plot(one.floquet_s, one.floquet_exponent, lw=0.5, zorder=1, color=f"C{number}")
            zeros = one.floquet_zero_s if by_multipliers else one.zero_s
            axes.plot(zeros, 0 * zeros, ls="", marker="|", ms=9, color=f"C{number}")
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
    """Where each scene's exponent is zero, and how many blocks move as one."""
    return {
        "scenes": [
            {
                "name": one.attrs["scene"].replace("_", " "),
                "zeros": zeros_in_words(one),
                "alike": alike_in_words(one),
            }
            for one in growth
        ]
    }


def zeros_in_words(one: xr.Dataset) -> str:
    """The zeros with their errors, and whether modes beyond are stable."""
    if not has_multipliers(one):
        return listed(one, "", "") or without_zero(one)
    exact = listed(one, "floquet_", " by multipliers") or without_zero(one)
    return f"{exact}; {listed(one, '', ' by exponents') or 'no zero between the points'}"


def listed(one: xr.Dataset, kind: str, how: str) -> str:
    """The zeros of one kind."""
    columns = [one[f"{kind}zero_{name}"].values.tolist() for name in ("s", "error", "rises")]
    return "; ".join(
        f"zero at s = {with_its_digits(s, error)}{how}, beyond it disturbances"
        f" {'grow' if up else 'decay'}"
        for s, error, up in zip(*columns, strict=True)
    )


def without_zero(one: xr.Dataset) -> str:
    """What modes do where no exponent is zero."""
    return "no zero: " + ("all modes grow" if growing_ranges(one) else "no mode grows")


def with_its_digits(value: float, error: float) -> str:
    """A value with the digits that its error leaves, up to six."""
    if error < MOST_ACCURATE:
        return f"{value:.6f}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def alike_in_words(one: xr.Dataset) -> str:
    """The numbers of blocks of the largest chains that move as one."""
    ranges = growing_ranges(one)
    found = [(largest_alike(ranges, kappa), kappa) for kappa in KAPPAS]
    return joined(
        [
            f"{'any' if most is None else 'none' if most == 1 else most}"
            f" at :math:`\\kappa = {kappa:g}`"
            for most, kappa in found
        ]
    )


def has_multipliers(one: xr.Dataset) -> bool:
    """Whether the motion is a cycle of which Floquet multipliers were found."""
    return one.sizes["floquet_s"] > 0


def growing_ranges(one: xr.Dataset) -> list[tuple[float, float]]:
    """Ranges of s in which disturbances grow, by multipliers where there are any.

    Beyond the largest s that was tried all is as there.
    """
    kind = "floquet_" if has_multipliers(one) else ""
    zeros = one[f"{kind}zero_s"].values.tolist()
    rises = one[f"{kind}zero_rises"].values.astype(bool).tolist()
    grows = [not rises[0] if zeros else float(one[f"{kind}exponent"][-1]) > 0, *rises]
    ends = [1.0, *zeros, math.inf]
    return [(ends[i], ends[i + 1]) for i, up in enumerate(grows) if up]


def largest_alike(ranges: list[tuple[float, float]], kappa: float) -> int | None:
    """The largest number of blocks with free ends of which no mode has s in a range; None: any.

    Mode m has s = 1 + 4 kappa sin^2(x/2) at x = pi m/N. If the distance pi/N is less than the
    width of a range in x, the range has a mode.
    """

    def place(s: float) -> float:
        return 2 * math.asin(math.sqrt(min((s - 1) / (4 * kappa), 1)))

    widest = max((place(high) - place(low) for low, high in ranges), default=0.0)
    if widest == 0:
        return None
    for blocks in range(math.floor(math.pi / widest) + 1, 1, -1):
        angles = [math.pi * mode / blocks for mode in range(1, blocks)]
        modes = [1 + kappa * round(4 * math.sin(angle / 2) ** 2, 12) for angle in angles]
        if not any(low < s < high for s in modes for low, high in ranges):
            return blocks
    return 1
