"""Cases of a family: all combinations of its lists."""

import math
from itertools import product

from scripts.namelists.parameters import place_of


def number_of_cases(config: dict, family: str) -> int:
    """How many combinations a family's lists have."""
    return math.prod(map(len, lists_of(config, family).values()))


def lists_of(config: dict, family: str) -> dict[str, list[float]]:
    """The values of each parameter of a family, and then of each value before the initial time."""
    settings = config["stability"]["families"][family]
    place = place_of(config, settings) | settings["history"]
    del place["law"]
    return {key: one if isinstance(one, list) else [one] for key, one in place.items()}


def cases_of_family(config: dict, family: str) -> list[dict]:
    """All combinations of a family's lists; a name says what differs within the family."""
    settings, lists = config["stability"]["families"][family], lists_of(config, family)
    varied = [key for key, values in lists.items() if len(values) > 1]
    before = settings["history"].keys()
    interval = settings["t_end"] / settings["samples"]
    times = {"t_end": settings["t_end"], "sample_interval": interval}
    cases = []
    for values in product(*lists.values()):
        case = dict(zip(lists, values, strict=True))
        name = " ".join([family, *(f"{key}={case[key]:g}" for key in varied)])
        history = {key: case.pop(key) for key in before}
        cases.append({"name": name, **case, "law": settings["law"], "history": history, **times})
    return cases
