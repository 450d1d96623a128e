"""What each result is computed from: the groups of its namelist, by the configuration."""

from scripts.namelists import attractor_surveys, study_cases
from scripts.namelists.study_cases import PARAMETERS


def scene_values(config: dict, scene: str) -> dict:
    """The namelist group of a scene."""
    settings = config["scenes"][scene]
    values = {k: v for k, v in settings.items() if k not in ("exponents", "attractors")}
    return {"name": scene, **values}


def scene_groups(config: dict, scene: str) -> dict:
    """A scene, for its trajectory and its slip events."""
    return {"scene": scene_values(config, scene)}


def spectrum_groups(config: dict, scene: str) -> dict:
    """The trajectory of a scene, and how its spectrum is estimated."""
    trajectory = f"<results>/trajectories/{scene}.nc"
    return {"spectrum": {"trajectory": trajectory, **config["spectra"]}}


def exponents_groups(config: dict, scene: str) -> dict:
    """A scene and how its exponents are measured, by default up to its own end."""
    settings, shared = config["scenes"][scene], dict(config["exponents"])
    default = {"count": shared.pop("count"), "t_end": settings["t_end"]}
    exponents = {**default, **settings.get("exponents", {}), **shared}
    return {"scene": scene_values(config, scene), "exponents": exponents}


def scene_survey_groups(config: dict, scene: str) -> dict:
    """How attractors of a scene are looked for."""
    return attractor_surveys.scene_groups(config, scene)


def survey_groups(config: dict, survey: str, part: str) -> dict:
    """How attractors of a part of a survey are looked for."""
    kind, _, name = survey.partition("/")
    if kind == "basins":
        return attractor_surveys.basin_groups(config, part)
    if kind == "routes":
        return attractor_surveys.route_groups(config, name, part)
    return attractor_surveys.atlas_groups(config, name, int(part))


def linear_stability_groups(config: dict, scene: str) -> dict:
    """The parameters of a scene, and how its linear stability is examined."""
    settings = config["scenes"][scene]
    values = {**{key: settings[key] for key in PARAMETERS}, **config["linear_stability"]}
    return {"linear_stability": values}


def plane_groups(config: dict, plane: str) -> dict:
    """A plane of Hopf curves."""
    return {"hopf_curves": config["hopf_curves"][plane]}


def velocity_step_groups(config: dict) -> dict:
    """A velocity step."""
    return {"velocity_step": config["velocity_step"]}


def cycles_groups(config: dict, cycle_line: str) -> dict:
    """The line on which cycles are followed, and how."""
    cycles = config["cycles"]
    line = cycles["lines"][cycle_line]
    how = {key: value for key, value in cycles.items() if key not in ("lines", "curves")}
    # curves are in planes of epsilon and tau
    if line["along"] in ("epsilon", "tau"):
        how |= cycles.get("curves", {})
    # a namelist has no empty lists
    return {"cycles": {**how, **{key: value for key, value in line.items() if value != []}}}


def measurement_groups(config: dict, study: str, case: str) -> dict:
    """Measured runs of a family of cases, or of a case whose horizon of trust is sought."""
    return _study_groups(config, study, case)["measurement"]


def reference_groups(config: dict, study: str, case: str) -> dict:
    """The same cases in quadruple precision."""
    return _study_groups(config, study, case)["reference"]


def _study_groups(config: dict, study: str, case: str) -> dict:
    """Namelists of a study, of one of two kinds."""
    if study == "stability":
        return study_cases.stability_groups(config["stability"], case)
    return study_cases.trust_groups(study_cases.measured_study(config), case)


def work_precision_groups(config: dict, case: str) -> dict:
    """Measured runs of a case in full length."""
    return study_cases.work_precision_groups(study_cases.measured_study(config), case)
