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
