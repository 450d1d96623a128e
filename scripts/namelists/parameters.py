"""Values of an entry as groups of namelists: its model with parameters, and histories."""

from scripts.namelists import laws
from scripts.namelists.laws import CHAIN, block_parameters, parameters_of

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
    names = [*parameters_of(config, values["law"]), "kappa"]
    there = {key: values[key] for key in names if key in values}
    rest = {
        key: value for key, value in values.items() if key not in {*names, "law", "blocks", "ends"}
    }
    model = {"name": values["law"]}
    if "kappa" in values:
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
