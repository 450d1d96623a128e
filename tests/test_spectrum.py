"""The spectrum program: against SciPy's Welch, and what its file says of known signals.

Peaks, their labels and verdicts are shown by the suite spectrum.
"""

import numpy as np
import pytest
import xarray as xr
from scipy.signal import welch
from scipy.special import ndtr

INTERVAL = 0.1
ATTRIBUTES = {"scene": "made_up", "sample_interval": INTERVAL, "t_transient": 0.0, "signal": "v"}
"""Of a trajectory with even times."""


@pytest.fixture
def settings(good_inputs) -> dict:
    return {**good_inputs["spectrum"], "trajectory": "signal.nml"}


@pytest.fixture
def spectrum_of(programs, settings):
    def run(v: np.ndarray, t_transient: float = 0.0, **changes) -> xr.Dataset:
        attributes = {**ATTRIBUTES, "t_transient": t_transient}
        times = INTERVAL * np.arange(v.size)
        signal = xr.Dataset({"v": ("t", v)}, coords={"t": times}, attrs=attributes)
        signal.to_netcdf(programs.folder / settings["trajectory"])
        return programs.made_by("spectrum", {**settings, **changes})

    return run


def noise(n: int) -> np.ndarray:
    """A signal with power at every frequency, and a mean."""
    return 1.0 + np.random.default_rng(1).normal(size=n)


@pytest.mark.parametrize(
    ("window", "n", "segments", "overlap", "length", "step"),
    [
        ("hann", 999, 1, 0.5, 999, 999),
        ("boxcar", 1003, 4, 0.0, 250, 250),
        ("hann", 1000, 5, 0.75, 500, 125),
        ("boxcar", 72, 8, 0.5, 16, 8),
    ],
)
def test_spectrum_agrees_with_scipy(spectrum_of, window, n, segments, overlap, length, step):
    """Even and odd lengths, one and many segments, with and without overlap. A spike before the end
    of the transient changes nothing."""
    v = noise(n)
    signal = np.append(np.full(200, 1e3), v)
    settings = {"window": window, "segments": segments, "overlap": overlap}
    spectrum = spectrum_of(signal, t_transient=200 * INTERVAL, **settings)
    frequency, power = welch(
        v - v.mean(),
        fs=1 / INTERVAL,
        window=window,
        nperseg=length,
        noverlap=length - step,
        detrend=False,
    )
    np.testing.assert_allclose(spectrum.frequency, frequency, rtol=1e-13)
    np.testing.assert_allclose(spectrum.power, power, rtol=1e-9, atol=1e-14 * power.max())
    assert spectrum.attrs["variance"] == pytest.approx(v.var(), rel=1e-12)


def test_events_shorter_than_the_interval_leave_no_false_peaks(spectrum_of, programs, settings):
    """Pulses of area T every T = 7.3, each a hundredth of the interval wide: 2 at n/T, no else.

    The power of a line is spread over 1.5 bins of a Hann window.
    """
    period, width, count = 7.3, 1e-3, 150
    centres = period * np.arange(-0.5, count + 1)
    offsets = np.linspace(-6 * width, 6 * width, 61)
    even = INTERVAL * np.arange(int(period * count / INTERVAL))
    t = np.sort(np.append(even, (centres[1:-1, None] + offsets).ravel()))
    after = (t[:, None] - centres) / width
    v = period * (np.exp(-(after**2) / 2) / np.sqrt(2 * np.pi) / width).sum(axis=1)
    u = period * ndtr(after).sum(axis=1) - t
    attributes = {**ATTRIBUTES, "integral": "u", "integral_slope": 1.0}
    signal = xr.Dataset({"v": ("t", v), "u": ("t", u)}, coords={"t": t}, attrs=attributes)
    signal.to_netcdf(programs.folder / settings["trajectory"])
    spectrum = programs.made_by("spectrum", {**settings, "segments": 1})
    lines = np.arange(1, spectrum.sizes["peak"] + 1)
    assert lines.size == int(period / (2 * INTERVAL))
    bin_width = float(spectrum.frequency[1])
    np.testing.assert_allclose(spectrum.peak_frequency, lines / period, atol=0.02 * bin_width)
    np.testing.assert_allclose(spectrum.peak_power, 2 / (1.5 * bin_width), rtol=0.02)
    assert spectrum.attrs["spectrum_kind"] == "periodic"
