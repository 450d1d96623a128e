"""Peaks of power spectra, named."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from scripts.drawing.style import INK
from scripts.drawing.wording import short

BASE, HARMONIC, SECOND_BASE, COMBINATION, OTHER = range(5)
"""Values of peak_kind."""


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
        centre = min(max(place[0], half), frequency_shown - half)
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


def peaks_in_words(spectrum: xr.Dataset) -> dict:
    """The two highest peaks, the fundamental frequencies, and the share of broadband power."""
    peaks = spectrum.isel(peak=(-spectrum.peak_power.values).argsort())
    frequencies = [short(value, 4) for value in peaks.peak_frequency.values]
    second = "there is one peak."
    if len(frequencies) > 1:
        ratio = short(100 * peaks.peak_power[1] / peaks.peak_power[0], 2)
        periodic = spectrum.attrs["spectrum_kind"] == "periodic"
        place = f", which is {int(peaks.peak_multiple[1])} :math:`f_1`," if periodic else ""
        second = f"the second peak at {frequencies[1]}{place} has {ratio} % of its height."
    return {
        "highest": frequencies[0] if frequencies else "no frequency",
        "second_peak": second,
        "bases": [short(value, 4) for value in spectrum.base_frequency.values],
        "off_lines": short(100 * spectrum.attrs["continuum_share"], 2),
    }
