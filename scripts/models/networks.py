"""Networks of a user: models with an index, whose parameters of nodes and edges are lists or files.

The path of a file begins in the folder of the user's file that names it, or of --configfile in the
project's folder.
"""

from pathlib import Path

from generator.network_file import count_indices
from scripts.files.read_config import ConfigError

VALUES = ("default", "csv")
"""Keys of a parameter with the numbers of nodes or edges."""


def network_of(definition: dict) -> dict:
    """Index, nodes and parameters with indices of a model; empty of a model without an index."""
    own = definition.get("parameters") or {}
    texts = {**(definition.get("definitions") or {}), **definition.get("equations", {})}
    index, indices = count_indices({key: str(text) for key, text in texts.items()}, own)
    if not index:
        return {}
    entries = {name: {**(own[name] or {}), "indices": n} for name, n in indices.items()}
    return {"index": index, "size": definition.get("size") or {}, "parameters": entries}


def without_numbers(definition: dict) -> dict:
    """A definition as the generator reads it: neither nodes nor their numbers."""
    of_nodes = network_of(definition).get("parameters", {})
    parameters = {
        name: {k: v for k, v in entry.items() if k not in VALUES} if name in of_nodes else entry
        for name, entry in definition["parameters"].items()
    }
    rest = {key: one for key, one in definition.items() if key != "size"}
    return {**rest, "parameters": parameters}


def find_files(config: dict, folder: Path) -> None:
    """Let the paths of a user's file begin in its folder."""
    models = config.get("models")
    for model in models.values() if isinstance(models, dict) else ():
        parameters = model.get("parameters") if isinstance(model, dict) else None
        for entry in parameters.values() if isinstance(parameters, dict) else ():
            if isinstance(entry, dict) and isinstance(entry.get("csv"), str):
                entry["csv"] = str(folder / entry["csv"])


def files_of(network: dict) -> list[str]:
    """Files with numbers of a network."""
    return [one["csv"] for one in network.get("parameters", {}).values() if "csv" in one]


def check_network(definition: dict, place: str) -> None:
    """Refuse nodes and numbers that a model cannot have; raise ConfigError."""
    network = network_of(definition)
    if network:
        if set(network["size"]) != {network["index"]}:
            expected = f"{{ {network['index']}: number of nodes }}"
            raise ConfigError(f"{place}: size = {network['size']!r}; expected {expected}")
        # plans without a network need no NumPy
        from scripts.models.network_numbers import arrays_of

        arrays_of(network, place)
    elif definition.get("size"):
        raise ConfigError(f"{place}: size = {definition['size']!r}; expected none without an index")


def nodes_of(network: dict) -> int:
    """The number of nodes."""
    return network["size"][network["index"]]
