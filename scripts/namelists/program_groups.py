"""Namelist groups that several studies share.

A function of groups takes the configuration and the names of one result, and returns the groups of
the program's namelist by name: for each, its values by key. A group is a variable of a derived type
in the program, and a group within a group a component of that variable.
"""

from scripts.namelists.parameters import HISTORY, with_parameters

REFERENCE_STEPS = 10_000_000
"""Most steps of a reference: far above what any needs."""
OF_STUDIES = ("exponents", "attractors", "si")
"""Keys of a scene that say what else is computed of it."""


def nested(values: dict, name: str, keys: list[str]) -> dict:
    """Values of which some become a group of their own."""
    part = {key: values[key] for key in keys if key in values}
    return {name: part, **{key: value for key, value in values.items() if key not in part}}


def scene_alone(config: dict, scene: str, **changes) -> dict:
    """The values of a scene, some of them changed."""
    own = {key: value for key, value in config["scenes"][scene].items() if key not in OF_STUDIES}
    return with_parameters(config, {"name": scene, **own, **changes})


def scene_groups(config: dict, scene: str) -> dict[str, dict]:
    """A scene: for its trajectory and its slip events."""
    return {"scene": scene_alone(config, scene)}


def case_groups(config: dict, cases: list[dict]) -> dict[str, list[dict]]:
    """The namelist group of cases, an element a case."""
    return {"cases": [nested(with_parameters(config, case), "history", HISTORY) for case in cases]}
