"""Cases of a family: all combinations of its lists."""

import math
from itertools import product

from scripts.namelists.laws import own_place
from scripts.namelists.parameters import HISTORY, PARAMETERS


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
