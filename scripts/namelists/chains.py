"""Histories of the blocks of a scene, and the eigenvalues of the modes of chains."""

import math

import numpy as np


def histories_of(scene: dict) -> list[dict[str, float]]:
    """Values for t <= 0 of each block: those of `history`, and the disturbance."""
    blocks, disturbance = scene["blocks"], scene["disturbance"]
    values = {
        key: np.array(value if isinstance(value, list) else [value] * blocks)
        for key, value in scene["history"].items()
    }
    draw = np.random.default_rng(disturbance["seed"]).uniform
    for key, value in values.items():
        # drawn of each, so that one size does not change another's numbers
        share = draw(-1.0, 1.0, blocks)
        if disturbance["block"] > 0:
            share = 1.0 * (np.arange(1, blocks + 1) == disturbance["block"])
        if key in disturbance:
            values[key] = value + disturbance[key] * share
        if f"ln_{key}" in disturbance:
            values[key] = np.exp(np.log(value) + disturbance[f"ln_{key}"] * share)
    columns = [column.tolist() for column in values.values()]
    return [dict(zip(values, block, strict=True)) for block in zip(*columns, strict=True)]


def eigenvalues(blocks: int, ends: str) -> list[float]:
    """Minus the second difference over the mode, of each mode in ascending order, each once."""
    numbers = range(1, blocks + 1) if ends == "plate" else range(blocks)
    turns = {"free": 0.5 / blocks, "ring": 1.0 / blocks, "plate": 0.5 / (blocks + 1)}[ends]
    values = [4.0 * math.sin(math.pi * turns * number) ** 2 for number in numbers]
    return sorted({round(value, 12) for value in values})
