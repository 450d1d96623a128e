"""Values of an entry as groups of namelists: its model with parameters, and histories."""

from scripts.namelists import laws
from scripts.namelists.laws import CHAIN, block_parameters, chain_parameters, is_law, parameters_of

PARAMETERS = list(block_parameters())
"""Names of the block's parameters."""
HISTORY = list(laws.HISTORY)
"""Names of the block's values for t <= 0."""
OF_PLANES = ("abscissa", "ordinate", "abscissa_window", "ordinate_window")
"""Keys of a plane beside those of its place."""


def place_of(config: dict, settings: dict) -> dict:
    """Model and parameters of an entry, of the latter those that it gives: all but axes."""
    names = [*parameters_of(config, settings["law"]), "law"]
    return {key: settings[key] for key in names if key in settings}


def with_model(config: dict, values: dict) -> dict:
    """Values of which the model with its parameters and its blocks becomes a group of its own."""
    known = parameters_of(config, values["law"])
    of_chain = chain_parameters() if is_law(config, values["law"]) else {}
    # one block without springs to neighbours is no chain
    is_chain = values.get("blocks", 1) > 1 or any(values.get(key, 0) > 0 for key in of_chain)
    names = [*known, *(of_chain if is_chain else [])]
    there = {key: values[key] for key in names if key in values}
    left_out = {*known, *of_chain, "law", "blocks", "ends"}
    rest = {key: value for key, value in values.items() if key not in left_out}
    model = {"name": values["law"]}
    if not is_law(config, values["law"]):
        # no number of it is known to be of order 1
        model["own_units"] = True
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
