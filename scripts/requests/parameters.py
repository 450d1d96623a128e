"""Values of an entry as groups of namelists: its model with parameters, and histories."""

from dataclasses import replace

import numpy as np

from scripts.models.models import OF_CHAIN, chain_parameters, model_of

OF_PLANES = ("abscissa", "ordinate", "abscissa_window", "ordinate_window")
"""Keys of a plane beside those of its place."""


def with_model(config: dict, values: dict) -> dict:
    """Values of which the model with its parameters and its blocks becomes a group of its own."""
    model = model_of(config, values)
    of_chain = chain_parameters() if model.is_block else {}
    left_out = {*model.parameters, *of_chain, "law", "blocks", "ends"}
    # no number of a user's model is known to be of order 1
    group = {} if model.is_block else {"own_units": True}
    # one block without springs to neighbours is no chain
    is_chain = values.get("blocks", 1) > 1 and not model.network
    if is_chain or any(values.get(key, 0) > 0 for key in of_chain):
        model = replace(model, kind=OF_CHAIN)
        group |= {"blocks": values["blocks"], "ends": values["ends"]}
    there = {key: values[key] for key in model.parameters if key in values}
    # a namelist has no empty lists
    listed = {"parameters": list(there), "values": list(there.values())} if there else {}
    rest = {key: value for key, value in values.items() if key not in left_out}
    return {"model": {"name": model.compiled, **group, **listed}, **rest}


def histories_group(histories: list[dict[str, float]]) -> dict[str, list]:
    """The namelist group of histories, of one block after another where they are of a chain."""
    names = list(histories[0])
    return {"names": names, "values": [history[name] for history in histories for name in names]}


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


def plane_group(config: dict, plane: dict) -> dict:
    """A plane of Hopf curves, of its abscissa and its ordinate."""
    settings = {key: value for key, value in plane.items() if key not in OF_PLANES}
    return {
        **with_model(config, settings),
        "along": [plane["abscissa"], plane["ordinate"]],
        "windows": [*plane["abscissa_window"], *plane["ordinate_window"]],
    }


def zero_of(config: dict) -> dict[str, float]:
    """What counts as a zero exponent, for all measurements that of the class."""
    return {key: config["attractors"]["observation"][key] for key in ("zero_level", "longest_bar")}
