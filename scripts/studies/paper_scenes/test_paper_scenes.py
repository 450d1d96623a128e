"""Power spectra: verdicts on made-up ones, and how they are drawn; numbers of portraits."""

import numpy as np
import pytest
import xarray as xr
from figure_contents import points_in
from made_up_results import NO, PARTLY, YES, assert_finding, attractor_row, cases, spectrum
from matplotlib.axes import Axes

from scripts.studies.paper_scenes import portraits, spectra

pytestmark = pytest.mark.usefixtures("styled")


def of_kind(kind: str = "periodic", **heights: float) -> dict:
    return {"spectra": {"mine": spectrum(kind, **heights)}}


@cases(
    (
        # one fundamental frequency with harmonics of 0.8 or 6.8 % or none, or another spectrum
        *("single_peak", {"scene": "mine"}),
        (of_kind(x1=50.0), YES, "peak is at the frequency 0.1."),
        (of_kind(x1=50.0, x2=0.4), YES, "second highest is at 0.2 ($= 2 f1$). It has 0.8 % of"),
        (of_kind(x1=50.0, x2=3.4), PARTLY),
        *((of_kind(kind, x1=50.0), NO) for kind in ("quasiperiodic", "undecided")),
        (of_kind("none"), NO),
    ),
    (
        *("spectrum_class", {"scene": "mine", "expected": "quasiperiodic"}),
        (of_kind("quasiperiodic", x1=1.0), YES, "scene mine: quasiperiodic."),
        (of_kind("continuum", x1=1.0), NO, "scene mine: continuum. 69 % of the power"),
        *((of_kind(kind, x1=1.0), NO) for kind in ("periodic", "undecided", "none")),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


BASE, HARMONIC, OTHER = (0.1, 9.0, 0, 1, 0), (0.2, 5.0, 1, 2, 0), (0.27, 1.0, 4, 0, 0)
SECOND = (0.35, 4.0, 2, 0, 1)


def draw_spectrum(*peaks: tuple[float, float, int, int, int]) -> Axes:
    """The logarithmic panel of a made-up spectrum up to a frequency of 0.5, with peaks of
    frequency, power, kind and multiples of both bases."""
    frequency = np.linspace(0, 5, 501)
    names = ["peak_frequency", "peak_power", "peak_kind", "peak_multiple", "peak_second_multiple"]
    columns = dict(zip(names, np.transpose(peaks), strict=True))
    data = {name: ("peak", column) for name, column in columns.items()}
    data["power"] = ("frequency", 1e-3 + 0 * frequency)
    data["base_frequency"] = ("base", [f for f, _, kind, *_ in peaks if kind in (0, 2)])
    attributes = {"scene": "made_up", "line_share": 0.75, "spectrum_kind": "undecided"}
    spectrum = xr.Dataset(data, {"frequency": frequency}, attributes)
    settings = {"rows": {"a": {"paper": "word"}}, "frequency_shown": 0.5}
    return spectra.draw([spectrum], settings).axes[0]


def test_peaks_are_named_by_kind():
    """Base, harmonic with its multiple, other in another colour, each with its frequency."""
    peaks = [BASE, HARMONIC, SECOND, OTHER]
    axes = draw_spectrum(*peaks)
    labels = {text.get_text(): text.get_color() for text in axes.texts}
    names = ["$f_1$\n0.1000", "$2f_1$\n0.2000", "$f_2$\n0.3500", "other\n0.2700"]
    assert list(labels) == names
    *explained, other = labels.values()
    assert len(set(explained)) == 1
    assert other not in explained
    assert {(x, y) for x, y, _ in points_in(axes)} == {p[:2] for p in peaks}


def test_peaks_beside_a_higher_one_get_a_dot_only():
    """Labels would lie on each other or on a dot; peaks beyond the axis get nothing."""
    beside, beyond = (0.13, 2.0, 3, -3, 2), (0.6, 3.0, 1, 6, 0)
    beside_a_dot = (0.155, 1.0, 3, -2, 2)
    axes = draw_spectrum(BASE, beside, beside_a_dot, beyond)
    assert [text.get_text() for text in axes.texts] == ["$f_1$\n0.1000"]
    assert {x for x, *_ in points_in(axes)} == {0.1, 0.13, 0.155}


def test_numbers_of_trajectories():
    """Maxima on the attractor, not on a part of the run, the class and the period."""
    time = np.arange(0.0, 20.0, 0.1)
    v = 1 + np.where(time < 9.9, 3.0, 0.5) * np.cos(2 * np.pi * 0.1 * time)
    settings = {"rows": {"a": {"scene": "mine"}}, "end_shown": 10.0}

    def row_where(*table: dict) -> dict:
        trajectory = xr.Dataset({"v": ("t", v)}, {"t": time})
        return portraits.numbers([trajectory], list(table), settings)["rows"]["a"]

    peaks = {"smallest_maximum": 2e9, "largest_maximum": 2e9}
    cycle = row_where(attractor_row("cycle", **peaks), attractor_row("chaos", history=2))
    words = "maxima of v are :math:`2 \\times 10^{9}` with a period of 10"
    assert cycle == {"motion": "limit cycle", "end": words}
    rest = row_where(attractor_row("fixed point"))
    assert rest["end"] == "at the end v is 0.5 or less from steady sliding, :math:`v = 1`"
    other = row_where(attractor_row("fixed point", law="model mine", xi=np.nan, **peaks))
    assert other["end"] == "at the end v is between 0.5 and 1.5"
    assert row_where(attractor_row("torus", "other"))["motion"] == "unknown"
