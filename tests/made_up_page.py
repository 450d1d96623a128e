"""Parts of a page, made up for tests."""

import numpy as np
import xarray as xr

from scripts.claims.claims_results import VERDICTS


def claim(name: str, verdict: str = VERDICTS[0], **values) -> dict:
    row = {"id": name, "whose": "the paper", "claim": f"It is {name}.", "verdict": verdict}
    row |= {"evidence": "0 < 1 & so on", "instead": "", "look_at": "", "table": ""}
    return {**row, "place": "section 1", **values}


def attractor(epsilon: float, tau: float, **given) -> dict:
    row = {"epsilon": epsilon, "tau": tau, "xi": 0.5, "gamma": 0.8, "class": "cycle"}
    row |= {f"exponent_{i}": -0.01 * i for i in (1, 2, 3)}
    row |= {f"error_{i}": 0.001 for i in (1, 2, 3)}
    return {**row, "period": 1.0, "reason": np.nan, "problem": np.nan, **given}


def atlas_run(*paths: np.ndarray | None) -> xr.Dataset:
    """A part of the atlas with these paths, as far as the page reads it."""
    moving = [path for path in paths if path is not None]
    lengths = [0 if path is None else path.shape[1] for path in paths]
    values = {"path_length": ("point", lengths)}
    if moving:
        columns = np.concatenate(moving, axis=1)
        names = ("path_time", "path_u", "path_ln_v")
        values |= {
            name: ("path_point", column) for name, column in zip(names, columns, strict=True)
        }
    return xr.Dataset(values, attrs={"t_path": 60.0})


def turn(period: float, largest: float) -> np.ndarray:
    """One period of a made-up cycle: time, u and ln v."""
    time = np.linspace(0, period, 41)
    phase = 2 * np.pi * time / period
    return np.array([time, -largest * np.cos(phase), np.log(largest) * np.sin(phase)])
