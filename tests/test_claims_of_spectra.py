"""Verdicts on spectra, on made-up ones."""

import pytest
from made_up_results import results, spectrum

from scripts.claims.claims_of_spectra import TESTS
from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, REPRODUCED


def of(made):
    """Results with one spectrum."""
    return results(spectra={"mine": made})


@pytest.mark.parametrize(
    ("made", "verdict"),
    [
        (spectrum(x1=50.0), REPRODUCED),
        (spectrum(x1=50.0, x2=0.4), REPRODUCED),
        (spectrum(x1=50.0, x2=3.4), CORRECTED),
        (spectrum("quasiperiodic", x1=50.0), NOT_REPRODUCED),
        (spectrum("undecided", x1=50.0), NOT_REPRODUCED),
        (spectrum("none"), NOT_REPRODUCED),
    ],
)
def test_single_peak(made, verdict):
    """One fundamental frequency with harmonics of 0.8 or 6.8 % or none, or another spectrum."""
    assert TESTS["single_peak"](of(made), scene="mine").verdict == verdict


@pytest.mark.parametrize("kind", ["periodic", "quasiperiodic", "continuum", "undecided", "none"])
def test_spectrum_class(kind):
    """The kind of the spectrum in the figure."""
    found = TESTS["spectrum_class"](
        of(spectrum(kind, x1=1.0)), scene="mine", expected="quasiperiodic"
    )
    assert found.verdict == (REPRODUCED if kind == "quasiperiodic" else NOT_REPRODUCED)
    assert f"scene mine: {kind}." in found.evidence


def test_second_peak_in_words():
    """The highest two, whatever their order in the file, and what the second is."""
    words = TESTS["single_peak"](of(spectrum(x3=2.0, x1=50.0, x2=4.0)), scene="mine").evidence
    assert "frequency 0.1. The second highest is at 0.2 (= 2 f1). It has 8 % of" in words


def test_continuum_in_words():
    """Its share, and no peaks."""
    test = TESTS["spectrum_class"]
    words = test(of(spectrum("continuum", x1=50.0)), scene="mine", expected="continuum").evidence
    assert words.endswith("scene mine: continuum. 69 % of the power is not in lines.")


def test_scene_without_spectrum_is_an_error():
    """It names the scene and those that there are."""
    with pytest.raises(ValueError, match=r"results/spectra: no file of scene 'other'.*: mine"):
        TESTS["single_peak"](of(spectrum()), scene="other")
