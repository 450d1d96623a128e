"""Histories of the blocks of a scene."""

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
