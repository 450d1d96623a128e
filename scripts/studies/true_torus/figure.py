"""The drawing of the paper's torus beside a true one, and the numbers of its caption."""

import math

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.signal import periodogram

from scripts.drawing import parameters
from scripts.drawing.spectra import label_peaks, lines_in_words, peaks_in_words
from scripts.drawing.style import FAINT
from scripts.drawing.trajectories import draw_signal
from scripts.drawing.wording import count, short, with_error
from scripts.tables.motion_rows import class_in_words, own_rows

EXPONENTS = (1, 2, 3)
EARLY = 200.0
"""Time before which a spectrum still shows the damped pair of roots of (5)."""
LETTER = 0.0215
"""How wide a letter is, as a share of the axis."""
POINT = 1e-3
"""Maxima that differ by less are one point."""
STYLES = {"point": {"color": "C0", "ms": 5}, "curve": {"color": "C1", "ms": 2}}
"""Of points of the section."""


def draw(
    table: list[dict],
    trajectories: list[xr.Dataset],
    attractors: list[xr.Dataset],
    spectra: list[xr.Dataset],
    roots: xr.Dataset,
    settings: dict,
) -> Figure:
    """Rows a, b, ...: v(t) and its spectrum; at the end the section of all.

    One panel a row, so that the figure is as narrow as a telephone.
    """
    rows = len(trajectories)
    figure, panels = plt.subplots(
        2 * rows + 1, 1, figsize=(3.6, 3.1 * rows + 2.0), height_ratios=[1, 1] * rows + [1.7]
    )
    known = own_rows(table)
    section = panels[-1]
    for i, ((label, shown), trajectory, attractor, powers) in enumerate(
        zip(settings["rows"].items(), trajectories, attractors, spectra, strict=True)
    ):
        velocity, spectrum = panels[2 * i : 2 * i + 2]
        last = float(trajectory.t[-1])
        draw_signal(velocity, trajectory, max(0.0, last - settings["end_shown"]), last)
        place = parameters.in_words(trajectory.attrs)
        velocity.set_title(f"$\\bf{{{label}}}$  {title_of(known[shown['scene']], place)}")
        draw_spectrum(spectrum, powers, settings["frequency_shown"])
        if i == 0:
            spectrum.plot(*early_spectrum(trajectory), color=FAINT, lw=0.7, zorder=0)
            spectrum.axvline(damped_pair(roots)[0], 0, 0.45, color="C1", lw=0.9, ls=":", zorder=0)
        draw_section(section, attractor, label)
        for panel, first in ((velocity, panels[0]), (spectrum, panels[1])):
            if i > 0:
                panel.sharey(first)
    section.set_title("section: successive maxima of $v$")
    section.set(xlabel="maximum of $v$", ylabel="next maximum", aspect="equal")
    section.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def title_of(row: dict, place: str) -> str:
    """Scene, class, parameters, and the leading exponents with their standard errors."""
    pairs = {i: (row[f"exponent_{i}"], row[f"error_{i}"]) for i in EXPONENTS}
    there = {i: pair for i, pair in pairs.items() if not math.isnan(pair[0])}
    each = [f"$\\lambda_{i}$ = {in_power_of_ten(*pair)}" for i, pair in there.items()]
    name = row["scene"].replace("_", " ")
    return (
        f"scene {name}: {row['class']}, {count(int(row['zero_exponents']), 'zero exponent')}"
        f"\n{place}\n{', '.join(each[:2])}\n{', '.join(each[2:])}"
    )


def in_power_of_ten(value: float, error: float) -> str:
    """A number with its error, in the same power of ten, to the first digits of the error.

    The zero exponent of a flow has no error.
    """
    if value == error == 0:
        return "0"
    largest = max(abs(value), error)
    power = math.floor(math.log10(largest)) if largest > 0 else 0
    finest = math.floor(math.log10(error)) if error > 0 else power - 2
    digits = power - finest + (1 if power == finest else 0)
    number, bar = (round(x / 10.0**power, digits) + 0.0 for x in (value, error))
    scaled = parameters.true_minus(f"{number:.{digits}f} ± {bar:.{digits}f}")
    return f"({scaled})$\\times 10^{{{power}}}$" if power else scaled


def draw_spectrum(axes: Axes, spectrum: xr.Dataset, frequency_shown: float) -> None:
    """The power spectral density with its peaks named."""
    shown = spectrum.sel(frequency=slice(spectrum.frequency[1], frequency_shown))
    axes.semilogy(shown.frequency, shown.power, color="C0", lw=0.7)
    label_peaks(axes, spectrum, frequency_shown, LETTER)
    top = float(shown.power.max())
    axes.set(xlim=(0, frequency_shown), ylim=(3e-11 * top, 1e5 * top))
    axes.set(xlabel="frequency (cycles per unit of time)", ylabel="power spectral\ndensity of $v$")
    axes.set_title(lines_in_words(spectrum))


def early_spectrum(trajectory: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies, finer than peaks are wide, and the power spectral density of v up to EARLY."""
    v = trajectory.v.sel(t=slice(0, EARLY))
    step = float(v.t[1] - v.t[0])
    return periodogram(v.values, 1 / step, window="hann", nfft=16 * v.size)


def damped_pair(roots: xr.Dataset) -> tuple[float, float]:
    """Frequency and growth rate of the least damped pair of stable roots of (5)."""
    real, imaginary = roots.root_real.values, roots.root_imag.values
    rate, omega = max(zip(real[real < 0], imaginary[real < 0], strict=True))
    return abs(omega) / (2 * math.pi), rate


def peak_near(frequency: float, frequencies: np.ndarray, power: np.ndarray) -> tuple[float, float]:
    """The maximum nearest to a frequency, and its height over that of the highest."""
    tops = np.flatnonzero((power[1:-1] > power[:-2]) & (power[1:-1] > power[2:])) + 1
    top = tops[np.argmin(abs(frequencies[tops] - frequency))]
    return frequencies[top], power[top] / power.max()


def draw_section(axes: Axes, attractors: xr.Dataset, label: str) -> None:
    """Each maximum of v over the one before: points where dv/dt falls through 0."""
    maxima = attractors.maximum.values[0]
    style = STYLES["point" if np.ptp(maxima[np.isfinite(maxima)]) < POINT else "curve"]
    axes.plot(maxima[:-1], maxima[1:], ls="", marker="o", mew=0, label=f"scene {label}", **style)


def numbers(
    table: list[dict],
    trajectories: list[xr.Dataset],
    spectra: list[xr.Dataset],
    roots: xr.Dataset,
    settings: dict,
) -> dict:
    """Delay, class, second exponent and frequencies of each scene, and a peak that dies out."""
    known = own_rows(table)
    rows = {}
    for (label, shown), spectrum in zip(settings["rows"].items(), spectra, strict=True):
        row = known[shown["scene"]]
        rows[label] = {
            "tau": short(row["tau"]),
            "motion": class_in_words(row),
            "second": with_error(row["exponent_2"], row["error_2"]),
            **peaks_in_words(spectrum),
        }
    damped, rate = damped_pair(roots)
    early, height = peak_near(damped, *early_spectrum(trajectories[0]))
    return {
        "rows": rows,
        **{"damped": short(damped, 4), "rate": short(rate), "time": short(EARLY)},
        **{"early": short(early, 4), "early_share": short(100 * height, 2)},
    }
