"""The drawing of plans/scene.py, and the numbers of its caption."""

import warnings

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing import parameters
from scripts.drawing.spectra import label_peaks, lines_in_words
from scripts.drawing.style import FAINT
from scripts.drawing.trajectories import MOST_MISSED, draw_portrait, draw_velocity, share_missed
from scripts.figures.figure_4 import end_in_words
from scripts.figures.wording import as_formulas, place_in_words, short, with_error
from scripts.tables.attractor_tables import rows_of
from scripts.tables.motion_rows import UNDECIDED, class_in_words, has_problem, kind_of

PERIODS = 12
"""Periods of the first fundamental frequency that v(t) shows at the end."""
SHARE = 0.1
"""Share of the run that it shows where there is no fundamental frequency."""
ATTRACTOR = 3000.0
"""Last time after the transient that the portrait shows."""
POWER = 0.999
"""Share of the power below the end of the frequency axis, which is half as far again."""
HARMONICS = 7
"""Harmonics of the first fundamental frequency that the axis shows at least."""
LEAST_SCALE = 1e-3
"""Exponents closer to zero than this are drawn on a linear scale."""
LEAST_SPREAD = 0.05
"""Half of the axes of the section, as a share of the size of its points."""
LETTER = 0.0135
"""How wide a letter is, as a share of the widest axis."""
DOTS = {"ls": "", "marker": "o", "color": "C1", "ms": 2.5, "mew": 0}


def draw(
    trajectory: xr.Dataset, spectrum: xr.Dataset, attractors: xr.Dataset, roots: xr.Dataset
) -> Figure:
    """v(t) from the start and at the end; portrait, section and exponents; spectrum."""
    missed = share_missed(trajectory)
    if missed > MOST_MISSED:
        warnings.warn(f"maxima of v are about {missed:.0%} higher than their samples", stacklevel=2)
    figure = plt.figure(figsize=(6.7, 6.6))
    above, middle, below = figure.subfigures(3, 1, height_ratios=[1.1, 1.2, 1.1])
    start, end = above.subplots(1, 2, sharey=True)
    portrait, section, exponents = middle.subplots(1, 3)
    powers = below.subplots()
    last = float(trajectory.t[-1])
    envelope = draw_velocity(start, trajectory, 0.0, last)
    # as lines, long runs would make the page slow
    for line in start.lines:
        line.set_rasterized(True)
    draw_velocity(end, trajectory, max(0.0, last - end_shown(spectrum, last)), last)
    end.set(ylabel="")
    draw_portrait(portrait, trajectory, ATTRACTOR)
    draw_section(section, attractors)
    draw_exponents(exponents, attractors)
    draw_spectrum(powers, spectrum)
    titles = {
        "whole run" + " (envelope)" * envelope: start,
        "end of the run": end,
        "phase portrait": portrait,
        "section": section,
        "Lyapunov exponents": exponents,
        f"spectrum: {lines_in_words(spectrum)}": powers,
    }
    for letter, (title, axes) in zip("abcdef", titles.items(), strict=True):
        axes.set_title(f"$\\bf{{{letter}}}$  {title}")
    name = trajectory.attrs["scene"].replace("_", " ")
    above.suptitle(
        f"scene {name} ({parameters.in_words(trajectory.attrs)}): {class_and_signs(attractors)}\n"
        f"steady sliding: {roots_in_words(roots)}",
        fontsize=8,
    )
    return figure


def end_shown(spectrum: xr.Dataset, last: float) -> float:
    """Length of the second time axis."""
    bases = spectrum.base_frequency.values
    return PERIODS / float(bases[0]) if bases.size else SHARE * last


def frequency_shown(spectrum: xr.Dataset) -> float:
    """End of the frequency axis: most of the power is below it."""
    frequency, power = spectrum.frequency.values[1:], spectrum.power.values[1:]
    total = np.cumsum(power)
    if total[-1] <= 0:
        return float(frequency[-1])
    end = 1.5 * float(frequency[np.searchsorted(total, POWER * total[-1])])
    bases = spectrum.base_frequency.values
    least = (HARMONICS + 0.5) * float(bases[0]) if bases.size else 0.0
    return min(max(end, least), float(frequency[-1]))


def draw_section(axes: Axes, attractors: xr.Dataset) -> None:
    """Points where v rises through 1, from the scene's own history."""
    own = attractors.isel(point=0)
    theta, u = own.section_theta.values, own.section_u.values
    there = np.isfinite(theta) & np.isfinite(u) & ((theta != 0) | (u != 0))
    axes.plot(theta[there], u[there], **DOTS)
    if there.any():
        widen(axes.set_xlim, theta[there])
        widen(axes.set_ylim, u[there])
    else:
        axes.set(xticks=[], yticks=[])
        axes.text(0.5, 0.5, "none", transform=axes.transAxes, ha="center", va="center")
    axes.set(xlabel=r"$\theta$ where $v$ rises through 1", ylabel="$u$ there")


def widen(set_limits, values: np.ndarray) -> None:
    """An axis on which points that differ by much less than their size are seen as one."""
    middle, size = 0.5 * (values.min() + values.max()), np.abs(values).max()
    half = max(0.55 * np.ptp(values), LEAST_SPREAD * size)
    set_limits(middle - half, middle + half)


def draw_exponents(axes: Axes, attractors: xr.Dataset) -> None:
    """The largest exponents with their standard errors."""
    own = attractors.isel(point=0)
    values, errors = own.lyapunov_exponent.values, own.lyapunov_error.values
    numbers = np.arange(1, values.size + 1)
    axes.axhline(0, color=FAINT, lw=0.6, zorder=0)
    axes.errorbar(numbers, values, errors, fmt="o", ms=3, capsize=2, lw=0.8, color="C0")
    axes.set_yscale("symlog", linthresh=LEAST_SCALE)
    axes.set(xticks=numbers, xlim=(0.5, values.size + 0.5), xlabel="number $i$")
    axes.set_ylabel(r"exponent $\lambda_i$")


def draw_spectrum(axes: Axes, spectrum: xr.Dataset) -> None:
    """The power spectral density of v with its peaks named."""
    end = frequency_shown(spectrum)
    shown = spectrum.sel(frequency=slice(spectrum.frequency[1], end))
    top = float(shown.power.max())
    axes.set(xlim=(0, end), xlabel="frequency (cycles per unit of time)")
    axes.set_ylabel("power spectral\ndensity of $v$")
    if top > 0:
        axes.semilogy(shown.frequency, shown.power, color="C0", lw=0.7)
        axes.set_ylim(max(0.3 * float(shown.power.min()), 3e-11 * top), 100 * top)
        label_peaks(axes, spectrum, end, LETTER)


def class_and_signs(attractors: xr.Dataset) -> str:
    """Class of the motion from the scene's own history, and the signs of its exponents."""
    row = rows_of(attractors)[0]
    if row["problem"]:
        return f"no class: {row['problem']}"
    kind = kind_of(row)
    if kind == UNDECIDED:
        return f"class undecided ({row['reason']})"
    if kind != row["class"]:
        kind = f"cycle with {row['period']:g} loops"
    own = attractors.isel(point=0)
    values, bounds = own.lyapunov_exponent.values, own.sign_bound.values
    zero = np.abs(values) <= bounds
    counts = {"positive": int((~zero & (values > 0)).sum()), "zero": int(zero.sum())}
    signs = ", ".join(f"{count} {sign}" for sign, count in counts.items())
    return f"{kind}; exponents: {signs}" if np.isfinite(values).any() else kind


def roots_in_words(roots: xr.Dataset) -> str:
    """Whether steady sliding is stable, its unstable pairs, and its rightmost root."""
    pairs = int(roots.attrs["unstable_pairs"])
    state = "stable" if pairs == 0 else "unstable"
    words = f"{state} ({pairs} unstable pair{'' if pairs == 1 else 's'} of roots"
    if not roots.sizes["root"]:
        return f"{words}, all real parts below ${roots.attrs['root_bound']:g}$)"
    first = int(roots.root_real.values.argmax())
    real, imaginary = float(roots.root_real[first]), abs(float(roots.root_imag[first]))
    value = f"{real:.4g}" + (rf" \pm {imaginary:.4g}\,i" if imaginary else "")
    return rf"{words}, rightmost $\lambda = {value}$)"


def numbers(
    trajectory: xr.Dataset, spectrum: xr.Dataset, attractors: xr.Dataset, roots: xr.Dataset
) -> dict:
    """Class, end of v, exponents, spectrum and the roots of steady sliding."""
    row = rows_of(attractors)[0]
    last = float(trajectory.t[-1])
    v = trajectory.v.sel(t=slice(max(0.0, last - end_shown(spectrum, last)), None))
    order = range(1, attractors.sizes["exponent"] + 1)
    exponents = [with_error(row[f"exponent_{i}"], row[f"error_{i}"]) for i in order]
    missed = share_missed(trajectory)
    return {
        "place": place_in_words(trajectory.attrs),
        "motion": motion_in_words(row),
        "end": end_in_words(v, row),
        "missed": short(100 * missed, 2) if missed > MOST_MISSED else "",
        "exponents": [value for value in exponents if value != "not measured"],
        "lines": as_formulas(lines_in_words(spectrum)),
        "roots": as_formulas(roots_in_words(roots)),
    }


def motion_in_words(row: dict) -> str:
    """The class of a motion, or why it has none."""
    if has_problem(row):
        return f"without a class ({row['problem']})"
    if row["class"] == UNDECIDED:
        return f"of no class that can be decided ({row['reason']})"
    if row["class"] == "chaos":
        return "chaotic"
    several = f" with {row['period']:g} points in its section"
    return f"a {class_in_words(row)}" + several * (kind_of(row) != row["class"])
