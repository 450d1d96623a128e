"""Compiled models: which of them a run opens by name, and from which definitions each is made."""

from pathlib import Path

from scripts.namelists.laws import BLOCK, CHAIN, MODEL, PREFIX, models_of_user

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


def of_user(config: dict) -> dict[str, dict]:
    """The user's laws and models by name."""
    return {**config["laws"], **models_of_user(config)}


def parts_of(model: str, config: dict, folder: str) -> list[str]:
    """Files that are the definition of a model together; those of a user are in a folder."""
    law = law_of(model)
    own = f"{folder}/definitions/{law}.yaml"
    if law in models_of_user(config):
        return [own]
    beside = {f"{CHAIN}{law}": ["chain.yaml"], f"{PREFIX}{law}": ["quasistatic.yaml"]}
    block = MODEL.relative_to(MODEL.parents[2])
    more = [f"{block}/{name}" for name in beside.get(model, [])]
    return [
        f"{block}/{BLOCK.name}",
        own if law in config["laws"] else f"{block}/laws/{law}.yaml",
        *more,
    ]


def folders_of(config: dict, folder: str, quad: bool) -> list[str]:
    """Where a run looks for models: its own folder first, where it has models of its user."""
    name = "models_quad" if quad else "models"
    return [f"{each}/{name}" for each in ([folder] if of_user(config) else []) + [OWN]]


def objects_of(models: set[str], config: dict, folder: str, quad: bool) -> list[str]:
    """Paths of the compiled models."""
    name, users = "models_quad" if quad else "models", of_user(config)
    places = {model: folder if law_of(model) in users else OWN for model in sorted(models)}
    return [str(Path(place, name, f"{model}.so")) for model, place in places.items()]
