"""Where attractors are looked for: the namelist of points and histories."""

import math
from collections.abc import Iterable

import numpy as np

from scripts.requests.parameters import histories_group, with_model


def drawn_histories(count: int, ranges: dict, names: Iterable[str]) -> list[dict[str, float]]:
    """Histories drawn evenly from ranges of values or of logarithms, the same for the same seed."""
    draw = np.random.default_rng(ranges["seed"]).uniform
    return [
        {
            name: float(draw(*ranges[name]))
            if name in ranges
            else math.exp(draw(*ranges[f"ln_{name}"]))
            for name in names
        }
        for _ in range(count)
    ]


def evenly_spaced(window: list[float], count: int) -> list[float]:
    """Values from one end of a window to the other."""
    return np.linspace(*window, count).tolist()


def survey_groups(
    config: dict,
    section: str,
    name: str,
    *,
    place: dict,
    histories: list[dict],
    sweep: str = "none",
    refinements: int = 0,
) -> dict[str, dict]:
    """The namelist of points and histories, and of how attractors are found and judged there.

    Parameters of the place are values or axes, of which the first one runs fastest.
    """
    observation = dict(config[section]["observation"])
    how = {"sweep": sweep, "refinements": refinements, "kept": observation.pop("kept")}
    solver = {key: observation.pop(key) for key in ("method", "tolerance", "most_steps")}
    axes = [
        {"along": key, "part": [1, value["count"]], **value}
        for key, value in place.items()
        if isinstance(value, dict) and "window" in value
    ]
    fixed = {key: value for key, value in place.items() if key not in [x["along"] for x in axes]}
    points = {"name": name, "model": with_model(config, fixed)["model"], **how}
    return {
        "observation": {**observation, **config["spectra"]},
        "solver": solver,
        # a namelist has no empty lists
        "points": {**points, **({"axes": axes} if axes else {})},
        "histories": histories_group(histories),
    }
