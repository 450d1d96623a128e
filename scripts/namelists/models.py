"""Compiled models: which of them a run opens by name, and from which definitions each is made."""

from pathlib import Path

from scripts.namelists.laws import CHAIN, MODEL, PREFIX

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


def law_of(model: str) -> str:
    """The law of which a model is made."""
    return model.removeprefix(CHAIN).removeprefix(PREFIX)


def parts_of(model: str, users: dict, folder: str) -> list[str]:
    """Files that are the definition of a model together; those of a user's law are in a folder."""
    law, block = law_of(model), MODEL.relative_to(MODEL.parents[2])
    beside = {f"{CHAIN}{law}": ["chain.yaml"], f"{PREFIX}{law}": ["quasistatic.yaml"]}
    own = f"{folder}/laws/{law}.yaml" if law in users else f"{block}/laws/{law}.yaml"
    more = [f"{block}/{name}" for name in beside.get(model, [])]
    return [f"{block}/spring_block.yaml", own, *more]


def folders_of(users: dict, folder: str, quad: bool) -> list[str]:
    """Where a run looks for models: its own folder first, where it has laws of its user."""
    name = "models_quad" if quad else "models"
    return [f"{each}/{name}" for each in ([folder] if users else []) + [OWN]]


def objects_of(models: set[str], users: dict, folder: str, quad: bool) -> list[str]:
    """Paths of the compiled models."""
    name = "models_quad" if quad else "models"
    places = {model: folder if law_of(model) in users else OWN for model in sorted(models)}
    return [str(Path(place, name, f"{model}.so")) for model, place in places.items()]
