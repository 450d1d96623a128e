"""Cases of the studies of stability and of work against precision, as namelist groups."""

import math
from itertools import product

PARAMETERS = ["tau", "epsilon", "xi", "gamma"]
HISTORY = ["theta", "u", "v"]
REFERENCE_STEPS = 10_000_000
"""Most steps of a reference: far above what any needs."""


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


def columns(cases: list[dict]) -> dict:
    """The namelist group of cases: one list a key."""
    return {key: [case[key] for case in cases] for key in cases[0]}


def stability_groups(study: dict, family: str) -> dict:
    """Namelists of a family: its measured runs and its references."""
    settings = study["families"][family]
    cases = columns(cases_of_family(family, settings))
    measure = {
        "methods": study["methods"],
        "tolerances": [study["tolerance"]],
        "most_steps": settings["most_steps"],
        "repeats": study["repeats"],
        "least_seconds": study["least_seconds"],
    }
    return {
        "measurement": {"cases_list": cases, "measure": measure},
        "reference": {"cases_list": cases, "reference": reference_group(study)},
    }


def trust_groups(study: dict, name: str) -> dict:
    """Namelists of a case in full length: a run at the least tolerance, and the reference."""
    cases = columns([case_of(name, study["cases"][name])])
    measure = {
        "methods": ["auto"],
        "tolerances": [min(study["tolerances"])],
        "most_steps": REFERENCE_STEPS,
        "repeats": 0,
        "least_seconds": 0.0,
    }
    return {
        "measurement": {"cases_list": cases, "measure": measure},
        "reference": {"cases_list": cases, "reference": reference_group(study)},
    }


def work_precision_groups(study: dict, name: str) -> dict:
    """Namelist of a case's measured runs in full length."""
    cases = columns([case_of(name, study["cases"][name])])
    keys = ["methods", "tolerances", "steps", "most_steps", "repeats", "least_seconds"]
    return {"cases_list": cases, "measure": {key: study[key] for key in keys}}


def reference_group(study: dict) -> dict:
    """How references of a study are computed."""
    return {**study["reference"], "most_steps": REFERENCE_STEPS}
