"""Power spectra with their peaks named, one scene a row, for figures 6 and 7."""

import xarray as xr
from drawing import INK
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

BASE, HARMONIC, OTHER = range(3)
"""Values of peak_kind."""
LEAST_DISTANCE = 0.05
"""Peaks closer to a higher one than this share of the axis get a dot and no label."""


def draw(rows: dict[str, xr.Dataset], paper: dict[str, str], frequency_shown: float) -> Figure:
    """Rows a, b, ...: power spectral density of v over frequency."""
    figure, grid = plt.subplots(
        len(rows), 1, figsize=(6.0, 0.5 + 2.3 * len(rows)), sharex=True, squeeze=False
    )
    for (label, spectrum), axes in zip(rows.items(), grid[:, 0], strict=True):
        shown = spectrum.sel(frequency=slice(spectrum.frequency[1], frequency_shown))
        axes.semilogy(shown.frequency, shown.power, color="C0", lw=0.7)
        label_peaks(axes, spectrum, frequency_shown)
        axes.set(ylabel="power spectral density of $v$", xlim=(0, frequency_shown))
        bottom = max(shown.power.min(), 1e-10 * shown.power.max())
        axes.set_ylim(0.3 * bottom, 100 * shown.power.max())
        scene = spectrum.attrs["scene"].replace("_", " ")
        row = f"$\\bf{{{label}}}$  " if len(rows) > 1 else ""
        axes.set_title(f"{row}scene {scene}: {seen(spectrum, paper[label])}")
    grid[-1, 0].set_xlabel("frequency (cycles per unit of time)")
    return figure


def label_peaks(axes: Axes, spectrum: xr.Dataset, frequency_shown: float) -> None:
    """A dot on each peak; its name and frequency where no higher one is near."""
    peaks = spectrum.drop_dims("frequency")
    peaks = peaks.isel(peak=peaks.peak_frequency.values <= frequency_shown)
    peaks = peaks.isel(peak=(-peaks.peak_power.values).argsort())
    labelled: list[float] = []
    for i in range(peaks.sizes["peak"]):
        peak = peaks.isel(peak=i)
        place, kind = (
            (float(peak.peak_frequency), float(peak.peak_power)),
            int(peak.peak_kind),
        )
        colour = "C1" if kind == OTHER else INK
        axes.plot(*place, "o", color=colour, ms=2)
        if any(abs(place[0] - other) < LEAST_DISTANCE * frequency_shown for other in labelled):
            continue
        labelled.append(place[0])
        name = {
            BASE: "base $f_1$\n",
            HARMONIC: f"${int(peak.peak_multiple)}\\,f_1$\n",
            OTHER: "other\n",
        }[kind]
        axes.annotate(
            f"{name}{place[0]:.4f}",
            place,
            xytext=(0, 4),
            textcoords="offset points",
            ha="center",
            fontsize=6.5,
            color=colour,
        )


def seen(spectrum: xr.Dataset, paper: str) -> str:
    """What the spectrum shows beside what the paper says, in a line."""
    share = spectrum.attrs["line_share"]
    base = spectrum.peak_frequency.values[spectrum.peak_kind.values == BASE]
    others = int((spectrum.peak_kind == OTHER).sum())
    if spectrum.attrs["signal"] == "periodic":
        words = f"one base frequency, $f_1$ = {base[0]:.4f}, and its harmonics"
    else:
        words = (
            f"{others} further peaks, {100 * (1 - share):.0f} % of the power off"
            " the base frequency and its harmonics"
        )
    return f"{words}\n(the paper: “{paper}”)"
