"""The drawing of power spectra (Figures 6 and 7), and the numbers of its caption."""

import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from scripts.drawing.spectra import label_peaks, lines_in_words, peaks_in_words
from scripts.drawing.trajectories import title_columns

WIDTH_OF_A_CHARACTER = 0.0162
"""Of a label, as a share of the wider axis."""
LEAST_SHOWN = 1e-10
"""Power below this share of the highest peak is not shown."""
COLUMNS = ("logarithmic scale", "the same on a linear scale")


def draw(spectra: list[xr.Dataset], settings: dict) -> Figure:
    """Rows a, b, ...: power spectral density of v over frequency, and the same on a linear scale.

    All rows have the same frequencies and, on the logarithmic scale, the same powers.
    """
    figure, grid = plt.subplots(
        len(spectra),
        2,
        figsize=(6.7, 0.4 + 2.2 * len(spectra)),
        width_ratios=[2.4, 1],
        sharex="col",
        squeeze=False,
    )
    end = settings["frequency_shown"]
    shown = [
        spectrum.sel(frequency=slice(spectrum.frequency[1], end)).power for spectrum in spectra
    ]
    highest = max(float(power.max()) for power in shown)
    least = min(float(power.min()) for power in shown)
    for (label, row), spectrum, power, (left, right) in zip(
        settings["rows"].items(), spectra, shown, grid, strict=True
    ):
        draw_power(left, power, end)
        left.set(yscale="log", ylim=(max(0.3 * least, LEAST_SHOWN * highest), 100 * highest))
        label_peaks(left, spectrum, end, WIDTH_OF_A_CHARACTER)
        draw_power(right, power, end)
        right.set(ylim=(0, None))
        right.xaxis.set_major_locator(MaxNLocator(4))
        letter = f"$\\bf{{{label}}}$  " if len(spectra) > 1 else ""
        title_columns((left, right), COLUMNS, f"{letter}{title_of(spectrum, row['paper'])}")
    grid[-1, 0].set_xlabel("frequency (cycles per unit of time)")
    grid[-1, 1].set_xlabel("frequency")
    return figure


def draw_power(axes: Axes, power: xr.DataArray, frequency_shown: float) -> None:
    """Power spectral density over frequency."""
    axes.plot(power.frequency, power, color="C0", lw=0.7)
    axes.set(ylabel="power spectral density of $v$", xlim=(0, frequency_shown))


def title_of(spectrum: xr.Dataset, paper: str) -> str:
    """What the paper says, and what the spectrum shows."""
    scene = spectrum.attrs["scene"].replace("_", " ")
    return f"scene {scene}; the paper: “{paper}”; here: {lines_in_words(spectrum)}"


def numbers(spectra: list[xr.Dataset], settings: dict) -> dict:
    """Frequencies and heights of the highest peaks, the share of broadband power."""
    return {"rows": dict(zip(settings["rows"], map(peaks_in_words, spectra), strict=True))}
