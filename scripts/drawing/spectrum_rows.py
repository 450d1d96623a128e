"""Power spectra with their peaks named, one scene a row, for figures 6 and 7."""

import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from scripts.drawing.style import INK
from scripts.drawing.trajectory_rows import title_columns

BASE, HARMONIC, SECOND_BASE, COMBINATION, OTHER = range(5)
"""Values of peak_kind."""
WIDTH_OF_A_CHARACTER = 0.0162
"""Of a label, as a share of the wider axis."""
LEAST_SHOWN = 1e-10
"""Power below this share of the highest peak is not shown."""
COLUMNS = ("logarithmic scale", "the same on a linear scale")


def draw(rows: dict[str, xr.Dataset], paper: dict[str, str], frequency_shown: float) -> Figure:
    """Rows a, b, ...: power spectral density of v over frequency, and the same on a linear scale.

    All rows have the same frequencies and, on the logarithmic scale, the same powers.
    """
    figure, grid = plt.subplots(
        len(rows),
        2,
        figsize=(6.7, 0.4 + 2.2 * len(rows)),
        width_ratios=[2.4, 1],
        sharex="col",
        squeeze=False,
    )
    shown = {
        label: spectrum.sel(frequency=slice(spectrum.frequency[1], frequency_shown))
        for label, spectrum in rows.items()
    }
    highest = max(float(spectrum.power.max()) for spectrum in shown.values())
    least = min(float(spectrum.power.min()) for spectrum in shown.values())
    for (label, spectrum), (left, right) in zip(rows.items(), grid, strict=True):
        draw_power(left, shown[label], frequency_shown)
        left.set(yscale="log", ylim=(max(0.3 * least, LEAST_SHOWN * highest), 100 * highest))
        label_peaks(left, spectrum, frequency_shown, WIDTH_OF_A_CHARACTER)
        draw_power(right, shown[label], frequency_shown)
        right.set(ylim=(0, None))
        right.xaxis.set_major_locator(MaxNLocator(4))
        letter = f"$\\bf{{{label}}}$  " if len(rows) > 1 else ""
        title_columns((left, right), COLUMNS, f"{letter}{seen(spectrum, paper[label])}")
    grid[-1, 0].set_xlabel("frequency (cycles per unit of time)")
    grid[-1, 1].set_xlabel("frequency")
    return figure


def draw_power(axes: Axes, spectrum: xr.Dataset, frequency_shown: float) -> None:
    """Power spectral density over frequency."""
    axes.plot(spectrum.frequency, spectrum.power, color="C0", lw=0.7)
    axes.set(ylabel="power spectral density of $v$", xlim=(0, frequency_shown))


def label_peaks(axes: Axes, spectrum: xr.Dataset, frequency_shown: float, letter: float) -> None:
    """A dot on each peak; its name and frequency where no higher one's are in the way.

    Labels begin right of the axis. A letter is as wide as this share of the axis.
    """
    peaks = spectrum.drop_dims(["frequency", "base"])
    peaks = peaks.isel(peak=peaks.peak_frequency.values <= frequency_shown)
    peaks = peaks.isel(peak=(-peaks.peak_power.values).argsort())
    named = spectrum.attrs["spectrum_kind"] != "continuum"
    taken: list[tuple[float, float]] = []
    for i in range(peaks.sizes["peak"]):
        peak = peaks.isel(peak=i)
        place = (float(peak.peak_frequency), float(peak.peak_power))
        colour = "C1" if named and int(peak.peak_kind) == OTHER else INK
        axes.plot(*place, "o", color=colour, ms=2)
        lines = [name_of(peak)] if named else []
        lines.append(f"{place[0]:.4f}")
        half = 0.5 * letter * frequency_shown * max(map(characters, lines))
        centre = max(place[0], half)
        if any(abs(centre - other) < half + its_half for other, its_half in taken):
            taken.append((place[0], 0.0))
            continue
        taken.append((centre, half))
        axes.annotate(
            "\n".join(lines),
            (centre, place[1]),
            xytext=(0, 4),
            textcoords="offset points",
            ha="center",
            fontsize=7,
            color=colour,
            path_effects=[withStroke(linewidth=1.5, foreground="white")],
        )


def name_of(peak: xr.Dataset) -> str:
    """What a peak is, in terms of the fundamental frequencies."""
    kind = int(peak.peak_kind)
    if kind == OTHER:
        return "other"
    multiples = {"f_1": int(peak.peak_multiple), "f_2": int(peak.peak_second_multiple)}
    terms = [(m, base) for base, m in multiples.items() if m]
    terms.sort(key=lambda term: term[0] < 0)
    words = " ".join(
        f"{'-' if m < 0 else '+'} {abs(m) if abs(m) > 1 else ''}{base}" for m, base in terms
    )
    return f"${words.removeprefix('+ ')}$"


def characters(label: str) -> int:
    """How many characters of a label are seen."""
    return len(label.replace("$", "").replace("_", ""))


def seen(spectrum: xr.Dataset, paper: str) -> str:
    """What the paper says, and what the spectrum shows."""
    scene = spectrum.attrs["scene"].replace("_", " ")
    return f"scene {scene}; the paper: “{paper}”; here: {lines_in_words(spectrum)}"


def lines_in_words(spectrum: xr.Dataset) -> str:
    """What the spectrum shows, in a line."""
    kind = spectrum.attrs["spectrum_kind"]
    bases = [f"$f_{i}$ = {f:.4f}" for i, f in enumerate(spectrum.base_frequency.values, start=1)]
    if kind == "periodic":
        words = f"periodic, {bases[0]} and its harmonics"
    elif kind == "quasiperiodic":
        words = f"quasiperiodic, {' and '.join(bases)}"
    elif kind == "continuum":
        off = 100 * spectrum.attrs["continuum_share"]
        words = f"a continuum, {off:.0f} % of the power is broadband"
    elif kind == "undecided":
        words = f"undecided: {reason(spectrum)}"
    else:
        words = "no power"
    return words


def reason(spectrum: xr.Dataset) -> str:
    """Why the spectrum is neither periodic, nor quasiperiodic, nor a continuum."""
    off = 100 * (1 - spectrum.attrs["line_share"])
    reasons = [f"{off:.2g} % of the power is outside the explained lines"]
    others = int((spectrum.peak_kind == OTHER).sum())
    if others:
        reasons.append(f"{others} other peak{'s' if others > 1 else ''}")
    if spectrum.attrs.get("bases_told_apart") == "no":
        reasons.append(f"$f_2/f_1$ not distinguished from {spectrum.attrs['ratio_of_bases']}")
    return ", ".join(reasons)
