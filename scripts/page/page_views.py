"""Trajectories that can be zoomed into on the page, and motions in words."""

import base64
import math

import numpy as np
import xarray as xr

from scripts.files.marked_words import GREEK
from scripts.files.tsv import as_text
from scripts.page.mathematics import in_signs
from scripts.tables.motion_rows import AXES_FIRST, UNDECIDED, has_problem, kind_of

SHOWN = 1000.0
"""Time up to the end of a run that can be zoomed into."""
DRAWN = ["v", "u"]
"""Variables that are drawn, as far as the scene's file has them."""
MOST_POINTS = 12_000
"""Of a trajectory. Of longer ones every second, third, ... sample is kept, or the last ones where
samples follow the motion."""


def describe_parameters(values: dict) -> str:
    """Parameters as a line of text."""
    return ", ".join(
        f"{GREEK[key]} = {in_signs(as_text(float(values[key])))}" for key in AXES_FIRST
    )


def describe_attractor(row: dict) -> str:
    """Class and exponents of a row of a table of attractors, or why there are none."""
    known = "" if has_problem(row) else f"; exponents {exponents(row) or 'not known'}"
    return motion(row) + known


def motion(row: dict) -> str:
    """The class of a row of a table of attractors, or why there is none."""
    if has_problem(row):
        return f"no result: {row['problem']}"
    met = kind_of(row)
    if met == UNDECIDED:
        return f"undecided ({row['reason']})"
    return met if met == row["class"] else f"cycle with {row['period']:g} loops"


def exponents(row: dict) -> str:
    """Exponents with their standard errors, where they have one; empty where none is known.

    Three, and the fourth of a 3-torus.
    """
    listed = ", ".join(
        f"{row[f'exponent_{i}']:.3g}" + f" ± {row[f'error_{i}']:.1g}" * (row[f"error_{i}"] > 0)
        for i in range(1, 5 if row["class"] == "3-torus" else 4)
        if not math.isnan(row[f"exponent_{i}"])
    )
    return in_signs(listed)


def can_be_drawn(run: xr.Dataset) -> bool:
    """Whether a scene of one block keeps something to draw."""
    return "block" not in run.dims and any(name in run for name in DRAWN)


def describe_run(run: xr.Dataset, attractors: list[dict]) -> dict:
    """The last part of a run, thinned, with what is known of it."""
    scene = run.attrs["scene"]
    end = float(run.t[-1])
    shown = run.sel(t=slice(max(0.0, end - SHOWN), end))
    uneven = (run.sizes["t"] - 1.5) * run.attrs["sample_interval"] > end
    every = 1 if uneven else math.ceil(shown.sizes["t"] / MOST_POINTS)
    shown = shown.isel(t=slice(-MOST_POINTS, None) if uneven else slice(None, None, every))
    reached = [row for row in attractors if row["scene"] == scene and row["history"] == 1]
    known = describe_attractor(reached[0]) if reached else "its attractor was not computed"
    return {
        "name": scene.replace("_", " "),
        "words": f"{describe_parameters(run.attrs)}: {known}",
        "every": every,
        "start": float(shown.t[0]),
        "step": every * run.attrs["sample_interval"],
        "times": as_base64(shown.t.values - float(shown.t[0])) if uneven else "",
        "series": [
            {"name": name, "values": as_base64(shown[name].values)}
            for name in DRAWN
            if name in shown
        ],
    }


def as_base64(values: np.ndarray) -> str:
    """Numbers in single precision, as text."""
    return base64.b64encode(values.astype("<f4").tobytes()).decode()
