"""Compiled models: which of them a run opens by name, and from which definitions each is made."""

from pathlib import Path

from scripts.models.models import ADDED, BLOCK, MODEL, models, of_user

OWN = "build/release"
"""The folder of the program and of the project's models."""


def models_in(groups) -> set[str]:
    """Names of the models that groups of a namelist name."""
    if isinstance(groups, list):
        return set().union(*map(models_in, groups))
    if not isinstance(groups, dict):
        return set()
    found = set().union(*map(models_in, groups.values()))
    model = groups.get("model")
    return found | ({model["name"]} if isinstance(model, dict) else set())


def parts_of(name: str, config: dict, folder: str) -> list[str]:
    """Files that are the definition of a model together; those of a user are in a folder."""
    model, block = models(config)[name], MODEL.relative_to(MODEL.parents[2])
    own = f"{folder}/definitions/{model.name}.yaml"
    if not model.is_block:
        return [own]
    law = own if model.name in of_user(config) else f"{block}/laws/{model.name}.yaml"
    added = [f"{block}/{ADDED[model.kind]}.yaml"] * bool(ADDED[model.kind])
    return [f"{block}/{BLOCK.name}", law, *added]


def folders_of(config: dict, folder: str, quad: bool) -> list[str]:
    """Where a run looks for models: its own folder first, where it has models of its user."""
    name = "models_quad" if quad else "models"
    return [f"{each}/{name}" for each in ([folder] if of_user(config) else []) + [OWN]]


def objects_of(names: set[str], config: dict, folder: str, quad: bool) -> list[str]:
    """Paths of the compiled models, and of the nodes and edges of networks."""
    kind, users, known = "models_quad" if quad else "models", of_user(config), models(config)
    places = {name: folder if known[name].name in users else OWN for name in sorted(names)}
    objects = [str(Path(place, kind, f"{name}.so")) for name, place in places.items()]
    networks = [name for name in places if known[name].network]
    return objects + [str(Path(places[one], kind, f"{one}.network")) for one in networks]
