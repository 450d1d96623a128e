# SPDX-License-Identifier: BSD-3-Clause
"""Power spectra of runs."""

import numpy as np
import xarray as xr

from delaykit.errors import ModelError, check_name
from delaykit.methods import answer, text_of

UNEVEN = 1e-6
"""Greatest difference of the times between samples, as a share of their mean."""


def spectrum(
    run: xr.Dataset,
    state=None,
    *,
    t_transient=0.0,
    window="hann",
    segments=8,
    overlap=0.5,
    floor=1e-6,
    prominence=10.0,
) -> xr.Dataset:
    """Power spectral density of a state from t_transient on, by Welch's method, and its peaks.

    run: with evenly spaced samples (`t_eval=np.arange(...)`). state: the first unless given.
    window: hann or boxcar. segments: of equal length, which overlap by a share.
    floor: least height of a peak over the highest. prominence: least height of a peak over the
        ground that parts it from higher ones.

    Frequencies count turns in a unit of time. The density is the square of the state's unit over
    that of a frequency; its integral is the variance. `peak_kind`: base, harmonic, second_base,
    combination of both, or other. The highest peak is the first.
    """
    if state is None:
        state = next(iter(run.data_vars))
    check_name("state", state, [name for name in run.data_vars if run[name].dims == ("t",)])
    shown = run[state].sel(t=slice(t_transient, None))
    steps = np.diff(shown.t)
    if len(steps) == 0 or np.ptp(steps) > UNEVEN * steps.mean():
        raise ModelError(
            f"spectrum: {shown.size} samples; expected evenly spaced ones, as from a run with "
            "t_eval=np.arange(...)"
        )
    asked = {"window": window, "segments": segments, "overlap": overlap}
    asked |= {"peak_floor": floor, "peak_prominence": prominence}
    # f90nml takes seconds to write many numbers
    values = "\n".join(map(repr, shown.values.tolist()))
    signal = f"&signal name = '{state}' interval = {steps.mean()} values =\n{values}\n/\n"
    found = answer(None, "spectrum", text_of({"settings": {"spectrum": asked}}) + signal)
    found = found.rename(power="density", peak_power="peak_density")
    found = found.isel(peak=np.argsort(-found.peak_density.values))
    return found.assign_attrs(run.attrs)
