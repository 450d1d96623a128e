"""Verdicts on spectra, on made-up ones."""

import pytest
from made_up_results import NO, PARTLY, YES, Results, spectrum

from scripts.claims.claims_of_spectra import single_peak, spectrum_class


@pytest.mark.parametrize(
    ("made", "verdict"),
    [
        (spectrum(x1=50.0), YES),
        (spectrum(x1=50.0, x2=0.4), YES),
        (spectrum(x1=50.0, x2=3.4), PARTLY),
        (spectrum("quasiperiodic", x1=50.0), NO),
        (spectrum("undecided", x1=50.0), NO),
        (spectrum("none"), NO),
    ],
)
def test_single_peak(made, verdict):
    """One fundamental frequency with harmonics of 0.8 or 6.8 % or none, or another spectrum."""
    assert single_peak(Results(spectra={"mine": made}), scene="mine").verdict == verdict


@pytest.mark.parametrize("kind", ["periodic", "quasiperiodic", "continuum", "undecided", "none"])
def test_spectrum_class(kind):
    """The kind of the spectrum in the figure."""
    made = Results(spectra={"mine": spectrum(kind, x1=1.0)})
    found = spectrum_class(made, scene="mine", expected="quasiperiodic")
    assert found.verdict == (YES if kind == "quasiperiodic" else NO)
    assert f"scene mine: {kind}." in found.evidence


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (
            spectrum(x3=2.0, x1=50.0, x2=4.0),
            "frequency 0.1. The second highest is at 0.2 ($= 2 f1$). It has 8 % of the height",
        ),
        (spectrum("continuum", x1=50.0), "continuum. 69 % of the power is not in lines."),
    ],
)
def test_spectrum_in_words(made, words):
    """The highest two peaks, in any order of the file, and what the second is; or the continuum."""
    assert words in single_peak(Results(spectra={"mine": made}), scene="mine").evidence


def test_scene_without_spectrum_is_an_error():
    """It names the scene and those that there are."""
    with pytest.raises(ValueError, match=r"results/spectra: no file of scene 'other'.*: mine"):
        single_peak(Results(spectra={"mine": spectrum()}), scene="other")
