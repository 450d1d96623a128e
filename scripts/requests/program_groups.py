"""Namelist groups that several studies share.

A function of groups takes the configuration and the names of one result, and returns the groups of
the program's namelist by name: for each, its values by key. A group is a variable of a derived type
in the program, and a group within a group a component of that variable.
"""

from scripts.requests.parameters import histories_group, histories_of, with_model

REFERENCE_STEPS = 10_000_000
"""Most steps of a reference: far above what any needs."""
OF_STUDIES = ("exponents", "attractors", "si")
"""Keys of a scene that say what else is computed of it."""


def scene_groups(config: dict, scene: str, **changes) -> dict[str, dict]:
    """A scene with the histories of its blocks, some of its values changed."""
    left_out = {*OF_STUDIES, "history", "disturbance"}
    own = {key: value for key, value in config["scenes"][scene].items() if key not in left_out}
    return {
        "scene": with_model(config, {"name": scene, **own, **changes}),
        "histories": histories_group(histories_of(config["scenes"][scene])),
    }


def case_groups(config: dict, cases: list[dict]) -> dict[str, list[dict]]:
    """The namelist group of cases, an element a case."""
    groups = []
    for case in cases:
        own = {key: value for key, value in case.items() if key != "history"}
        groups.append(with_model(config, own) | {"histories": histories_group([case["history"]])})
    return {"cases": groups}
