# SPDX-License-Identifier: BSD-3-Clause
"""Power spectra of runs."""

import numpy as np
import xarray as xr

from delaykit.errors import ModelError, check_name

UNEVEN = 1e-6
"""Greatest difference of the times between samples, as a share of their mean."""


def spectrum(
    run: xr.Dataset,
    state=None,
    *,
    t_transient=0.0,
    segments=8,
    overlap=0.5,
    floor=1e-6,
    prominence=10.0,
) -> xr.Dataset:
    """Power spectral density of a state from t_transient on, by Welch's method, and its peaks.

    run: with evenly spaced samples (`t_eval=np.arange(...)`). state: the first unless given.
    segments: of equal length, which overlap by a share and go through a Hann window.
    floor: least height of a peak over the highest. prominence: least height of a peak over the
        ground that parts it from higher ones.

    Frequencies count turns in a unit of time. The density is the square of the state's unit over
    that of a frequency; its integral is the variance.
    """
    from scipy.signal import find_peaks, welch

    if state is None:
        state = next(iter(run.data_vars))
    check_name("state", state, [name for name in run.data_vars if run[name].dims == ("t",)])
    t, y = run.t.values, run[state].values
    y, t = y[t >= t_transient], t[t >= t_transient]
    steps = np.diff(t)
    if len(t) < 4 * segments or np.ptp(steps) > UNEVEN * steps.mean():
        raise ModelError(
            f"spectrum: {len(t)} samples; expected at least {4 * segments}, evenly spaced, as from "
            "a run with t_eval=np.arange(...)"
        )
    length = int(len(t) / (1 + (segments - 1) * (1 - overlap)))
    frequency, density = welch(y, 1 / steps.mean(), "hann", length, int(overlap * length))
    logs = np.log(np.maximum(density, np.finfo(float).tiny))
    lowest = logs[1:].max() + np.log(floor)
    at, _ = find_peaks(logs, lowest, prominence=np.log(prominence))
    # a line through a Hann window, from three bins: fortran/src/methods/spectra/spectral_peaks.f90
    before, here, behind = np.sqrt([density[at - 1], density[at], density[at + 1]])
    shift = 2 * (behind - before) / (before + 2 * here + behind)
    height = density[at] * ((1 - shift**2) / np.sinc(shift)) ** 2
    order = np.argsort(-height)
    return xr.Dataset(
        {
            "density": ("frequency", density, {"long_name": f"power spectral density of {state}"}),
            "peak_frequency": (
                "peak",
                (frequency[at] + shift * frequency[1])[order],
                {"long_name": "frequency of a peak, the highest first"},
            ),
            "peak_density": ("peak", height[order], {"long_name": "density at the peak"}),
        },
        {"frequency": ("frequency", frequency, {"long_name": "frequency"})},
        {**run.attrs, "window": "hann", "segments": segments, "overlap": overlap},
    )
