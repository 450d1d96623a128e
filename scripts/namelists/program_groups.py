"""Namelist groups of each program, by the configuration: what each result is computed from.

Each function takes the configuration and the names of one result, and returns the groups of the
program's namelist by name: for each, its values by key. A group is a variable of a derived type in
the program, and a group within a group a component of that variable.
"""

from scripts.namelists import attractor_surveys
from scripts.namelists.study_cases import (
    HISTORY,
    case_of,
    cases_of_family,
    measured_study,
    place_of,
    with_parameters,
    zero_of,
)

REFERENCE_STEPS = 10_000_000
"""Most steps of a reference: far above what any needs."""


def nested(values: dict, name: str, keys: list[str]) -> dict:
    """Values of which some become a group of their own."""
    part = {key: values[key] for key in keys if key in values}
    return {name: part, **{key: value for key, value in values.items() if key not in part}}


def scene_groups(config: dict, scene: str) -> dict[str, dict]:
    """A scene: for its trajectory and its slip events."""
    settings = config["scenes"][scene]
    studies = ("exponents", "attractors", "si")
    own = {key: value for key, value in settings.items() if key not in studies}
    return {"scene": with_parameters(config, {"name": scene, **own})}


def exponents_groups(config: dict, scene: str) -> dict[str, dict]:
    """A scene and how its exponents are measured, by default up to its own end."""
    settings, shared = config["scenes"][scene], config["exponents"] | zero_of(config)
    default = {"count": shared.pop("count"), "t_end": settings["t_end"]}
    exponents = {**default, **settings.get("exponents", {}), **shared}
    return {**scene_groups(config, scene), "exponents": exponents}


def spectrum_groups(config: dict, scene: str) -> dict:
    """The trajectory of a scene, and how its spectrum is made."""
    return {"trajectory": f"<results>/trajectories/{scene}.nc", "spectrum": config["spectra"]}


def linear_stability_groups(config: dict, scene: str) -> dict[str, dict]:
    """The parameters of a scene, and the bounds of roots and changes of its linear stability."""
    place = place_of(config, config["scenes"][scene])
    return {"linear_stability": {**with_parameters(config, place), **config["linear_stability"]}}


def hopf_groups(config: dict, plane: str) -> dict[str, dict]:
    """A plane of Hopf curves."""
    return {"hopf_curves": with_parameters(config, config["hopf_curves"][plane])}


def cycles_groups(config: dict, cycle_line: str) -> dict[str, dict]:
    """The line on which cycles are followed, and how."""
    cycles = config["cycles"]
    how = {key: value for key, value in cycles.items() if key not in ("lines", "curves")}
    # curves are in planes of epsilon and tau
    if cycles["lines"][cycle_line]["along"] in ("epsilon", "tau"):
        how |= cycles.get("curves", {})
    # a namelist has no empty lists
    own = {key: value for key, value in cycles["lines"][cycle_line].items() if value != []}
    return {"cycles": with_parameters(config, {**how, **own})}


def attractors_groups(config: dict, survey: str, part: str) -> dict[str, dict]:
    """How attractors of a part of a survey are found and judged."""
    kind, _, name = survey.partition("/")
    if kind == "basins":
        return attractor_surveys.basin_groups(config, part)
    if kind == "laws":
        return attractor_surveys.law_groups(config, name, part)
    if kind == "routes":
        return attractor_surveys.route_groups(config, name, part)
    return attractor_surveys.atlas_groups(config, name, int(part))


def measurement_groups(config: dict, study: str, case: str) -> dict[str, dict]:
    """Measured runs: of a family of the study `stability`, or of a scene of the study `trust`."""
    if study == "stability":
        settings = config["stability"]
        methods, tolerances = settings["methods"], [settings["tolerance"]]
        most_steps = settings["families"][case]["most_steps"]
        repeats, least_seconds = settings["repeats"], settings["least_seconds"]
    else:
        methods, tolerances = ["auto"], [min(config["work_precision"]["tolerances"])]
        most_steps, repeats, least_seconds = REFERENCE_STEPS, 0, 0.0
    measure = {
        "methods": methods,
        "tolerances": tolerances,
        "most_steps": most_steps,
        "repeats": repeats,
        "least_seconds": least_seconds,
    }
    return {**cases_of_study(config, study, case), "measure": measure}


def reference_groups(config: dict, study: str, case: str) -> dict[str, dict]:
    """References of the same cases."""
    settings = config["stability" if study == "stability" else "work_precision"]["reference"]
    reference = {**settings, "most_steps": REFERENCE_STEPS}
    return {**cases_of_study(config, study, case), "reference": reference}


def work_precision_groups(config: dict, case: str) -> dict[str, dict]:
    """Measured runs of a case in full length."""
    study = measured_study(config)
    cases = [case_of(case, study["cases"][case])]
    keys = ["methods", "tolerances", "steps", "most_steps", "repeats", "least_seconds"]
    return {**case_groups(config, cases), "measure": {key: study[key] for key in keys}}


def cases_of_study(config: dict, study: str, name: str) -> dict[str, dict]:
    """The cases of a family, or the case of a scene in full length."""
    if study == "stability":
        return case_groups(config, cases_of_family(config, name))
    return case_groups(config, [case_of(name, measured_study(config)["cases"][name])])


def case_groups(config: dict, cases: list[dict]) -> dict[str, list[dict]]:
    """The namelist group of cases, an element a case."""
    return {"cases": [nested(with_parameters(config, case), "history", HISTORY) for case in cases]}
