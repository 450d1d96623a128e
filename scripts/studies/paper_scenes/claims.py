"""Claims about spectra of v, by the files that figures 6 and 7 show."""

from typing import Annotated

from scripts.claims.claims_results import Finding, Results, decided, short
from scripts.claims.declare import Scene, among, claim, reads, says, tested_with
from scripts.files.inputs import Dataset

KINDS = ["periodic", "quasiperiodic", "continuum"]
Kind = Annotated[str, among("kind of a spectrum", KINDS)]

SMALL = 0.02
"""A harmonic below this share of the highest peak is not seen in a figure with a linear axis."""


@claim(40, "figure_6a", "Figure 6a", look_at="figure_6")
@says("The spectrum of the oscillations has a single peak, that of periodic motion.")
@tested_with(scene="oscillation")
@reads("spectra")
def single_peak(results: Results, *, scene: Scene) -> Finding:
    """Whether the spectrum has one fundamental frequency and only small harmonics."""
    spectrum = results.spectrum_of(scene)
    periodic = spectrum.attrs["spectrum_kind"] == "periodic"
    power = spectrum.peak_power.values
    alone = bool((power > SMALL * power.max(initial=0)).sum() == 1)
    evidence, instead = in_words(scene, spectrum), second_peak(scene, spectrum)
    return decided(periodic and alone, evidence, instead, partly=periodic)


@claim(41, "figure_6b", "Figure 6b", look_at="figure_6")
@says("A second peak in the spectrum shows a torus.")
@tested_with(scene="torus", expected="quasiperiodic")
@claim(43, "figure_7", "abstract; Figure 7", look_at="figure_7")
@says("The spectrum of the chaotic motion is broadband noise.")
@tested_with(scene="chaos", expected="continuum")
@reads("spectra")
def spectrum_class(results: Results, *, scene: Scene, expected: Kind) -> Finding:
    """Whether the spectrum is of this kind."""
    spectrum = results.spectrum_of(scene)
    return decided(
        spectrum.attrs["spectrum_kind"] == expected,
        in_words(scene, spectrum),
        second_peak(scene, spectrum),
    )


def second_peak(scene: str, spectrum: Dataset) -> str:
    """What the second highest peak is, in a sentence."""
    kind, count = spectrum.attrs["spectrum_kind"], spectrum.sizes["peak"]
    if kind != "periodic" or count < 2:
        return f"The spectrum of scene {scene} is of the kind {kind}, with {count} peaks."
    first, second = (-spectrum.peak_power.values).argsort()[:2]
    share = 100 * float(spectrum.peak_power[second] / spectrum.peak_power[first])
    multiple = int(spectrum.peak_multiple[second])
    return (
        f"The second peak is a harmonic of periodic motion, at {multiple} $f1$, with"
        f" {short(share, 2)} % of the height of the first."
    )


def in_words(scene: str, spectrum: Dataset) -> str:
    """Kind of the spectrum; its two highest peaks, or the power beside all lines."""
    kind = spectrum.attrs["spectrum_kind"]
    words = f"Kind of the spectrum of scene {scene}: {kind}."
    if kind == "continuum":
        share = spectrum.attrs["continuum_share"]
        return f"{words} {short(100 * share, 2)} % of the power is not in lines."
    peaks = spectrum.isel(peak=(-spectrum.peak_power.values).argsort())
    if peaks.sizes["peak"] > 0:
        words += f" The highest peak is at the frequency {short(peaks.peak_frequency[0])}."
    if peaks.sizes["peak"] > 1:
        multiple = f" ($= {int(peaks.peak_multiple[1])} f1$)" if kind == "periodic" else ""
        ratio = float(peaks.peak_power[1] / peaks.peak_power[0])
        words += (
            f" The second highest is at {short(peaks.peak_frequency[1])}{multiple}. It has"
            f" {short(100 * ratio, 2)} % of the height of the first."
        )
    return words
