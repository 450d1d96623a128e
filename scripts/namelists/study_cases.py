"""Parameters of the block; cases of the studies of stability and of work against precision."""

import math
from itertools import product

from scripts.namelists.laws import block_parameters, law_group, own_parameters, own_place

PARAMETERS = list(block_parameters())
"""Names of the block's parameters."""
HISTORY = ["theta", "u", "v"]
"""Names of the values for t <= 0, in the order of block_parameters.f90."""


def place_of(config: dict, settings: dict) -> dict:
    """Parameters, law and the law's own parameters of an entry."""
    return {key: settings[key] for key in PARAMETERS} | own_place(config, settings)


def with_parameters(config: dict, values: dict) -> dict:
    """Values of which parameters and law become a group of their own."""
    own = own_parameters(config, values["law"])
    there = {key: values[key] for key in PARAMETERS if key in values}
    rest = {key: value for key, value in values.items() if key not in {*PARAMETERS, "law", *own}}
    return {"parameters": {**there, **law_group(config, values)}, **rest}


def number_of_cases(settings: dict) -> int:
    """How many combinations a family's lists have."""
    return math.prod(len(settings[key]) for key in [*PARAMETERS, *HISTORY])


def cases_of_family(config: dict, family: str) -> list[dict]:
    """All combinations of a family's lists; a name says what differs within the family."""
    settings = config["stability"]["families"][family]
    keys = [*PARAMETERS, *HISTORY]
    varied = [key for key in keys if len(settings[key]) > 1]
    cases = []
    for values in product(*(settings[key] for key in keys)):
        case = dict(zip(keys, values, strict=True))
        name = " ".join([family, *(f"{key}={case[key]:g}" for key in varied)])
        interval = settings["t_end"] / settings["samples"]
        times = {"t_end": settings["t_end"], "sample_interval": interval}
        cases.append({"name": name, **case, **own_place(config, settings), **times})
    return cases


def measured_study(config: dict) -> dict:
    """The study of work against precision, in which its scenes are cases among the others."""
    study = config["work_precision"]
    scenes = {
        name: place_of(config, config["scenes"][name])
        | {"history": config["scenes"][name]["history"]}
        | settings
        for name, settings in study["scenes"].items()
    }
    return {**study, "cases": scenes | study["cases"]}


def case_of(name: str, settings: dict) -> dict:
    """One case up to its t_end."""
    own = {key: value for key, value in settings.items() if key != "history"}
    return {"name": name, **settings["history"], **own}


def zero_of(config: dict) -> dict[str, float]:
    """What counts as a zero exponent, for all measurements that of the class."""
    return {key: config["attractors"]["observation"][key] for key in ("zero_level", "longest_bar")}
