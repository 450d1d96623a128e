"""The true torus: the damped frequency that the paper shows."""

import numpy as np
import pytest
import xarray as xr

from scripts.studies.true_torus import figure as true_torus
from scripts.studies.true_torus.finding import describe


def a_trajectory(v: np.ndarray, u: np.ndarray) -> xr.Dataset:
    """A made-up trajectory with a time step of 0.1."""
    time = {"t": 0.1 * np.arange(v.size)}
    attributes = {"tau": 3.0, "epsilon": 0.25, "xi": 0.5, "gamma": 0.75, "t_transient": 50.0}
    return xr.Dataset({"u": ("t", u), "v": ("t", v)}, time, attributes)


def test_a_damped_pair_is_found_in_the_spectrum_of_the_beginning():
    """A wave that dies out beside a lasting one: its height follows from its mean in the window."""
    t = 0.1 * np.arange(20_001)
    dying = 0.1 * np.exp(-0.015 * t)
    run = a_trajectory(np.cos(0.62 * t) + dying * np.cos(1.11 * t), 0 * t)
    pairs = {"root_real": ("root", [0.01, -0.015, -0.08]), "root_imag": ("root", [0.62, 1.11, 0.2])}
    frequency, rate = true_torus.damped_pair(xr.Dataset(pairs))
    assert (frequency, rate) == (1.11 / (2 * np.pi), -0.015)
    found, height = true_torus.peak_near(frequency, *true_torus.early_spectrum(run))
    assert found == pytest.approx(frequency, abs=1e-3)
    mean = np.average(dying[:2001], weights=np.hanning(2001))
    assert height == pytest.approx(mean**2, rel=0.05)


@pytest.mark.parametrize("holds", [True, False])
def test_finding_follows_the_table(holds):
    """The title says the opposite if the results do."""
    row = {"history": 1.0, "tau": 10.0, "f1": 0.1, "f2": np.nan, "zero_exponents": 1.0}
    cycle = row | {"class": "cycle"}
    torus = row | {"class": "torus", "tau": 12.5, "f2": 0.3, "zero_exponents": 2.0}
    rows = [(cycle if holds else torus) | {"scene": "torus"}, torus | {"scene": "true_torus"}]
    found = describe({"attractors": rows})
    assert found["title"] == f"The paper's torus is a {'limit cycle' if holds else 'torus'}."
    words = "At $tau = 12.5$, with all else the same, the motion is a torus: it has two zero"
    assert words in found["words"]
