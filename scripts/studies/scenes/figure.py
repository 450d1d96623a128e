"""The drawing of one scene, and the numbers of its caption."""

import math
import warnings

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.config.si import in_si, units_of
from scripts.drawing import parameters
from scripts.drawing.roots import roots_in_words
from scripts.drawing.si_axes import add_axis, add_time
from scripts.drawing.spectra import label_peaks, lines_in_words
from scripts.drawing.style import FAINT
from scripts.drawing.trajectories import (
    MOST_MISSED,
    draw_portrait,
    draw_signal,
    end_in_words,
    share_missed,
    signal_of,
)
from scripts.drawing.wording import as_formulas, place_in_words, short, with_error, words_of_state
from scripts.models.records import is_of_block
from scripts.tables.attractor_tables import SAME_MAXIMUM, rows_of
from scripts.tables.exponent_signs import SIGNS, count_in_words
from scripts.tables.motion_rows import UNDECIDED, class_in_words, has_problem, kind_of

RECURRENCES = 12
"""Rises of v through 1 that v(t) shows at the end."""
SHARE = 0.1
"""Share of the run that it shows where there are none."""
SPECTRA = {"cycle": "periodic", "torus": "quasiperiodic", "3-torus": "", "chaos": "continuum"}
"""What resolved spectra are, by the class of the motion."""
LINES = 4
"""Width of a line of the Hann window, in bins."""
ATTRACTOR = 3000.0
"""Last time after the transient that the portrait shows."""
POWER = 0.999
"""Share of the power below the end of the frequency axis, which is half as far again."""
HARMONICS = 7
"""Harmonics of the first fundamental frequency that the axis shows at least."""
MOST_HARMONICS = 40.5
"""The axis ends at this multiple of the first or highest line: more make a bar of stick-slip."""
MOST_MISSING = 2.0
"""By this factor a run may miss the largest v of a torus or of chaos."""
LEAST_SCALE = 1e-3
"""Exponents closer to zero than this are drawn on a linear scale."""
LEAST_SPREAD = 0.05
"""Half of the axes of the section, as a share of the size of its points."""
LETTER = 0.0135
"""How wide a letter is, as a share of the widest axis."""
DOTS = {"ls": "", "marker": "o", "color": "C1", "ms": 2.5, "mew": 0}


def draw(
    trajectory: xr.Dataset,
    spectrum: xr.Dataset,
    attractors: xr.Dataset,
    roots: xr.Dataset | None,
    si: dict,
) -> Figure:
    """v(t) from the start and at the end; portrait, section and exponents; spectrum."""
    missed = share_missed(trajectory)
    if missed > MOST_MISSED:
        warnings.warn(f"maxima of v are about {missed:.0%} higher than their samples", stacklevel=2)
    figure = plt.figure(figsize=(6.7, 7.4 if si else 6.6))
    above, middle, below = figure.subfigures(3, 1, height_ratios=[1.1, 1.2, 1.1])
    start, end = above.subplots(1, 2, sharey=True)
    portrait, section, exponents = middle.subplots(1, 3)
    row = rows_of(attractors)[0]
    powers = below.subplots()
    last = float(trajectory.t[-1])
    envelope = draw_signal(start, trajectory, 0.0, last)
    # as lines, long runs would make the page slow
    for line in start.lines:
        line.set_rasterized(True)
    draw_signal(end, trajectory, max(0.0, last - end_shown(row, last)), last)
    end.set(ylabel="")
    draw_portrait(portrait, trajectory, ATTRACTOR)
    draw_section(section, attractors, row)
    if si:
        units = units_of(in_si(si))
        add_time(start, units["s"])
        add_time(end, units["s"])
        add_axis(end, units["m/s"], "", "m/s")
        add_axis(portrait, units["m/s"], "", "m/s")
        add_axis(portrait, units["m"], "displacement", "m")
    draw_exponents(exponents, attractors)
    draw_spectrum(powers, spectrum)
    titles = {
        "whole run" + " (envelope)" * envelope: start,
        "end of the run": end,
        "phase portrait": portrait,
        "section": section,
        "Lyapunov exponents": exponents,
        f"spectrum: {spectrum_in_words(spectrum, row)}": powers,
    }
    for letter, (title, axes) in zip("abcdef", titles.items(), strict=True):
        axes.set_title(f"$\\bf{{{letter}}}$  {title}")
    name = trajectory.attrs["scene"].replace("_", " ")
    above.suptitle(
        f"scene {name} ({parameters.in_words(trajectory.attrs)}): {class_and_signs(row)}\n"
        f"{words_of_state(row)}: {roots_in_words(roots)}",
        fontsize=8,
    )
    return figure


def end_shown(row: dict, last: float) -> float:
    """Length of the second time axis."""
    between = row["recurrence_time"]
    return SHARE * last if math.isnan(between) else RECURRENCES * between


def unsettled(trajectory: xr.Dataset, row: dict) -> str:
    """The largest v drawn, of a cycle in a first period, if it is not that of the attractor."""
    end = float(trajectory.t[-1])
    start = max(trajectory.attrs["t_transient"], end - ATTRACTOR)
    cycle, rest = row["class"] == "cycle", row["class"] == "fixed point"
    shown = signal_of(trajectory).sel(
        t=slice(start, min(end, start + 1 / row["f1"]) if cycle else end)
    )
    largest, most = float(shown.max()), 1.0 if rest else row["largest_maximum"]
    if min(largest, most) <= 0 or (rest and not is_of_block(row)):
        return ""
    factor = 1 + SAME_MAXIMUM if cycle or rest else MOST_MISSING
    return short(largest) if abs(math.log(largest / most)) > math.log(factor) else ""


def spectrum_in_words(spectrum: xr.Dataset, row: dict) -> str:
    """What the spectrum shows, if it is resolved: the class rests on longer runs."""
    kind, motion = spectrum.attrs["spectrum_kind"], row["class"]
    if motion == "fixed point":
        return f"what is left of the approach to {words_of_state(row)}"
    wide = LINES * float(spectrum.frequency[1]) * row["recurrence_time"] > 1
    unlike = kind not in ("undecided", SPECTRA.get(motion, kind))
    return "not resolved, the run is too short" if wide or unlike else lines_in_words(spectrum)


def frequency_shown(spectrum: xr.Dataset) -> float:
    """End of the frequency axis: most of the power is below it."""
    frequency, power = spectrum.frequency.values[1:], spectrum.power.values[1:]
    total = np.cumsum(power)
    if total[-1] <= 0:
        return float(frequency[-1])
    end = 1.5 * float(frequency[np.searchsorted(total, POWER * total[-1])])
    bases = spectrum.base_frequency.values
    least = (HARMONICS + 0.5) * float(bases[0]) if bases.size else 0.0
    # more lines would run together to a bar
    highest = spectrum.peak_frequency.values[spectrum.peak_power.values.argsort()[-1:]]
    most = MOST_HARMONICS * float(min([*bases[:1], *highest], default=np.inf))
    return min(max(end, least), most, float(frequency[-1]))


def draw_section(axes: Axes, attractors: xr.Dataset, row: dict) -> None:
    """Points where v rises through 1, from the scene's own history; of a cycle its last period."""
    own = attractors.isel(point=0)
    names = [str(name) for name in own.data_vars if str(name).startswith("section_")]
    theta, u = (own[name].values for name in names)
    there = np.flatnonzero(np.isfinite(theta) & np.isfinite(u) & ((theta != 0) | (u != 0)))
    if row["class"] == "cycle" and row["period"] > 0:
        there = there[-int(row["period"]) :]
    axes.plot(theta[there], u[there], **DOTS)
    if there.size:
        widen(axes.set_xlim, theta[there])
        widen(axes.set_ylim, u[there])
    else:
        axes.set(xticks=[], yticks=[])
        axes.text(0.5, 0.5, "none", transform=axes.transAxes, ha="center", va="center")
    x, y = (coordinate_in_words(name) for name in names)
    if is_of_block(row):
        x, y = f"{x} where $v$ rises through 1", f"{y} there"
    axes.set(xlabel=x, ylabel=y)


def coordinate_in_words(name: str) -> str:
    """A coordinate of the section: a state, or the time and the peak since the point before."""
    words = {"section_time": "time between", "section_peak": "peak between"}
    return words.get(name, f"${parameters.symbol_of(name.removeprefix('section_'))}$")


def section_in_words(attractors: xr.Dataset) -> str:
    """What the section shows, for the caption."""
    names = [str(name) for name in attractors.data_vars if str(name).startswith("section_")]
    words = as_formulas(" and ".join(map(coordinate_in_words, names)))
    return words.replace("between", "from point to point")


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
    axes.set_ylabel(f"power spectral\ndensity of ${spectrum.attrs['signal']}$")
    if top > 0:
        axes.semilogy(shown.frequency, shown.power, color="C0", lw=0.7)
        axes.set_ylim(max(0.3 * float(shown.power.min()), 3e-11 * top), 100 * top)
        label_peaks(axes, spectrum, end, LETTER)


def class_and_signs(row: dict) -> str:
    """Class of the motion from the scene's own history, and the signs of its exponents."""
    if row["problem"]:
        return f"no class: {row['problem']}"
    kind = kind_of(row)
    if kind == UNDECIDED:
        return f"class undecided ({row['reason']})"
    if kind != row["class"]:
        kind = f"cycle with {row['period']:g} loops"
    signs = {word: row.get(f"{word}_exponents") for word in SIGNS.values()}
    return kind if math.isnan(signs["zero"]) else f"{kind}; exponents: {count_in_words(signs)}"


def numbers(
    trajectory: xr.Dataset,
    spectrum: xr.Dataset,
    attractors: xr.Dataset,
    roots: xr.Dataset | None,
    si: dict,
) -> dict:
    """Class, end of v, exponents, spectrum and the roots of steady sliding."""
    row = rows_of(attractors)[0]
    last = float(trajectory.t[-1])
    v = signal_of(trajectory).sel(t=slice(max(0.0, last - end_shown(row, last)), None))
    order = range(1, attractors.sizes["exponent"] + 1)
    exponents = [with_error(row[f"exponent_{i}"], row[f"error_{i}"]) for i in order]
    missed = share_missed(trajectory)
    return {
        "place": place_in_words(trajectory.attrs),
        "motion": motion_in_words(row),
        "end": end_in_words(v, row),
        "unsettled": unsettled(trajectory, row),
        "missed": short(100 * missed, 2) if missed > MOST_MISSED else "",
        "exponents": [value for value in exponents if value != "not measured"],
        "lines": as_formulas(spectrum_in_words(spectrum, row)),
        "roots": as_formulas(roots_in_words(roots)),
        "state": words_of_state(row),
        "signal": v.name,
        "section": section_in_words(attractors),
        "si": trajectory.attrs["scene"] if si else "",
    }


def motion_in_words(row: dict) -> str:
    """The class of a motion, or why it has none."""
    if has_problem(row):
        return f"without a class ({row['problem']}): (d) and (e) are empty"
    if row["class"] == UNDECIDED:
        others = "theta or u" if is_of_block(row) else "another state"
        hint = f": the history disturbs too little, disturb {others}"
        words = row["reason"] + hint * (row["reason"] == "unstable rest")
        return f"of no class that can be decided ({words})"
    if row["class"] == "chaos":
        return "chaotic"
    several = f" with {row['period']:g} points in its section"
    return f"a {class_in_words(row)}" + several * (kind_of(row) != row["class"])
