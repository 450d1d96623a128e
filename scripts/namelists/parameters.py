"""Parameters of the block, and how values of an entry are told from them."""

from scripts.namelists.laws import block_parameters, law_group, own_parameters, own_place

PARAMETERS = list(block_parameters())
"""Names of the block's parameters."""
HISTORY = ["theta", "u", "v"]
"""Names of the values for t <= 0, in the order of block_parameters.f90."""


def place_of(config: dict, settings: dict) -> dict:
    """Parameters, law and the law's own parameters of an entry."""
    return {key: settings[key] for key in PARAMETERS} | own_place(config, settings)


def with_parameters(config: dict, values: dict) -> dict:
    """Values of which parameters and law become a group of their own."""
    own = own_parameters(config, values["law"])
    there = {key: values[key] for key in PARAMETERS if key in values}
    rest = {key: value for key, value in values.items() if key not in {*PARAMETERS, "law", *own}}
    return {"parameters": {**there, **law_group(config, values)}, **rest}


def zero_of(config: dict) -> dict[str, float]:
    """What counts as a zero exponent, for all measurements that of the class."""
    return {key: config["attractors"]["observation"][key] for key in ("zero_level", "longest_bar")}
