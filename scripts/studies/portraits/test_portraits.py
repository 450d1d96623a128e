"""Numbers of the captions of velocity and phase portrait."""

import numpy as np
import xarray as xr
from made_up_results import attractor_row

from scripts.studies.portraits import figure as drawing


def test_numbers_of_trajectories():
    """Maxima on the attractor, not on a part of the run, the class and the period."""
    time = np.arange(0.0, 20.0, 0.1)
    v = 1 + np.where(time < 9.9, 3.0, 0.5) * np.cos(2 * np.pi * 0.1 * time)
    settings = {"rows": {"a": {"scene": "mine"}}, "end_shown": 10.0}

    def row_where(*table: dict) -> dict:
        trajectory = xr.Dataset({"v": ("t", v)}, {"t": time})
        return drawing.numbers([trajectory], list(table), settings)["rows"]["a"]

    peaks = {"smallest_maximum": 2e9, "largest_maximum": 2e9}
    cycle = row_where(attractor_row("cycle", **peaks), attractor_row("chaos", history=2))
    words = "maxima of v are :math:`2 \\times 10^{9}` with a period of 10"
    assert cycle == {"motion": "limit cycle", "end": words}
    rest = row_where(attractor_row("fixed point"))
    assert rest["end"] == "at the end v is 0.5 or less from steady sliding, :math:`v = 1`"
    assert row_where(attractor_row("torus", "other"))["motion"] == "unknown"
