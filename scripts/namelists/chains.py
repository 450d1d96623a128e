"""Chains of blocks: their namelists, and the eigenvalues of their modes."""

import math

import numpy as np

from scripts.namelists.parameters import HISTORY, histories_group, with_model


def histories_of(chain: dict) -> list[dict[str, float]]:
    """Values for t <= 0 of each block: those of `history`, and the disturbance."""
    blocks, disturbance = chain["blocks"], chain["disturbance"]
    values = {
        key: np.array(value if isinstance(value, list) else [value] * blocks, dtype=float)
        for key, value in chain["history"].items()
    }
    values["v"] = np.log(values["v"])
    draw = np.random.default_rng(disturbance["seed"]).uniform
    for key, size in (("theta", "theta"), ("u", "u"), ("v", "ln_v")):
        # drawn of each, so that one size does not change another's numbers
        change = disturbance[size] * draw(-1.0, 1.0, blocks)
        if disturbance["block"] > 0:
            change = disturbance[size] * (np.arange(1, blocks + 1) == disturbance["block"])
        values[key] = values[key] + change
    values["v"] = np.exp(values["v"])
    columns = [values[key].tolist() for key in HISTORY]
    return [dict(zip(HISTORY, block, strict=True)) for block in zip(*columns, strict=True)]


def groups_of_chain(config: dict, chain: str, settings: dict) -> dict[str, dict]:
    """A chain as a scene, with the histories of its blocks."""
    left_out = {"history", "disturbance"}
    scene = {key: value for key, value in settings.items() if key not in left_out}
    return {
        "scene": with_model(config, {"name": chain, **scene}),
        "histories": histories_group(histories_of(settings)),
    }


def eigenvalues(blocks: int, ends: str) -> list[float]:
    """Minus the second difference over the mode, of each mode in ascending order, each once."""
    numbers = range(1, blocks + 1) if ends == "plate" else range(blocks)
    turns = {"free": 0.5 / blocks, "ring": 1.0 / blocks, "plate": 0.5 / (blocks + 1)}[ends]
    values = [4.0 * math.sin(math.pi * turns * number) ** 2 for number in numbers]
    return sorted({round(value, 12) for value in values})
