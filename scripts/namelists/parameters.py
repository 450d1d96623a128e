"""Parameters of the block, and how values of an entry are told from them."""

from scripts.namelists.laws import CHAIN, block_parameters, own_parameters, own_place

PARAMETERS = list(block_parameters())
"""Names of the block's parameters."""
HISTORY = ["theta", "u", "v"]
"""Names of the values for t <= 0."""


OF_PLANES = ("ordinate", "epsilon_window", "ordinate_window")
"""Keys of a plane of Hopf curves beside those of its place."""


def place_of(config: dict, settings: dict) -> dict:
    """Parameters, law and the law's own parameters of an entry."""
    return {key: settings[key] for key in PARAMETERS} | own_place(config, settings)


def with_model(config: dict, values: dict) -> dict:
    """Values of which the model with its parameters and its blocks becomes a group of its own."""
    own = own_parameters(config, values["law"])
    # one block without springs to neighbours is no chain
    is_chain = values.get("blocks", 1) > 1 or values.get("kappa", 0.0) > 0
    names = [*PARAMETERS, *own, *["kappa"] * is_chain]
    there = {key: values[key] for key in names if key in values}
    rest = {
        key: value
        for key, value in values.items()
        if key not in {*names, "law", "kappa", "blocks", "ends"}
    }
    model = {"name": values["law"]}
    if is_chain:
        model |= {"name": CHAIN + values["law"], "blocks": values["blocks"], "ends": values["ends"]}
    # a namelist has no empty lists
    listed = {"parameters": list(there), "values": list(there.values())} if there else {}
    return {"model": model | listed, **rest}


def histories_group(histories: list[dict[str, float]]) -> dict[str, list]:
    """The namelist group of histories, of one block after another where they are of a chain."""
    names = list(histories[0])
    return {"names": names, "values": [history[name] for history in histories for name in names]}


def plane_group(config: dict, plane: dict) -> dict:
    """A plane of Hopf curves, of epsilon and its ordinate."""
    settings = {key: value for key, value in plane.items() if key not in OF_PLANES}
    return {
        **with_model(config, settings),
        "along": ["epsilon", plane["ordinate"]],
        "windows": [*plane["epsilon_window"], *plane["ordinate_window"]],
    }


def zero_of(config: dict) -> dict[str, float]:
    """What counts as a zero exponent, for all measurements that of the class."""
    return {key: config["attractors"]["observation"][key] for key in ("zero_level", "longest_bar")}
