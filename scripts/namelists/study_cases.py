"""Parameters of the block; cases of the studies of stability and of work against precision."""

import math
from itertools import product

PARAMETERS = ["tau", "epsilon", "xi", "gamma"]
HISTORY = ["theta", "u", "v"]
"""Names of the parameters and of the values for t <= 0, in the order of block_parameters.f90."""


def number_of_cases(settings: dict) -> int:
    """How many combinations a family's lists have."""
    return math.prod(len(settings[key]) for key in [*PARAMETERS, *HISTORY])


def cases_of_family(family: str, settings: dict) -> list[dict]:
    """All combinations of a family's lists; a name says what differs within the family."""
    keys = [*PARAMETERS, *HISTORY]
    varied = [key for key in keys if len(settings[key]) > 1]
    cases = []
    for values in product(*(settings[key] for key in keys)):
        case = dict(zip(keys, values, strict=True))
        name = " ".join([family, *(f"{key}={case[key]:g}" for key in varied)])
        interval = settings["t_end"] / settings["samples"]
        times = {"t_end": settings["t_end"], "sample_interval": interval}
        cases.append({"name": name, **case, **times})
    return cases


def measured_study(config: dict) -> dict:
    """The study of work against precision, in which its scenes are cases among the others."""
    study = config["work_precision"]
    keys = [*PARAMETERS, "history"]
    scenes = {
        name: {key: config["scenes"][name][key] for key in keys} | settings
        for name, settings in study["scenes"].items()
    }
    return {**study, "cases": scenes | study["cases"]}


def case_of(name: str, settings: dict) -> dict:
    """One case up to its t_end."""
    own = {key: value for key, value in settings.items() if key != "history"}
    return {"name": name, **settings["history"], **own}
