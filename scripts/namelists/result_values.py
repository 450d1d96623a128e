"""What each result is computed from: the values of its namelists, by the configuration."""

from pathlib import PurePath

from scripts.namelists import attractor_surveys, study_cases

PARAMETERS = study_cases.PARAMETERS


def scene_values(config: dict, scene: str) -> dict:
    """The namelist group of a scene."""
    settings = config["scenes"][scene]
    own = {key: value for key, value in settings.items() if key not in ("exponents", "attractors")}
    return {"name": scene, **own}


def exponents_groups(config: dict, scene: str) -> dict:
    """A scene and how its exponents are measured, by default up to its own end."""
    settings, shared = config["scenes"][scene], dict(config["exponents"])
    default = {"count": shared.pop("count"), "t_end": settings["t_end"]}
    exponents = {**default, **settings.get("exponents", {}), **shared}
    return {"runs": {"scene": scene_values(config, scene), "exponents": exponents}}


def survey_groups(config: dict, survey: str, part: str) -> dict:
    """How attractors of a part of a survey are looked for."""
    kind, _, name = survey.partition("/")
    if kind == "scenes":
        groups = attractor_surveys.scene_groups(config, part)
    elif kind == "basins":
        groups = attractor_surveys.basin_groups(config, part)
    elif kind == "routes":
        groups = attractor_surveys.route_groups(config, name, part)
    else:
        groups = attractor_surveys.atlas_groups(config, name, int(part))
    return {"runs": groups}


def linear_stability_values(config: dict, scene: str) -> dict:
    """The parameters of a scene, and what is asked of its linear stability."""
    settings = config["scenes"][scene]
    return {**{key: settings[key] for key in PARAMETERS}, **config["linear_stability"]}


def plane_values(config: dict, plane: str) -> dict:
    """The namelist group of a plane."""
    return config["hopf_curves"][plane]


def cycles_values(config: dict, line: str) -> dict:
    """The line on which cycles are followed, and how."""
    cycles = config["cycles"]
    how = {key: value for key, value in cycles.items() if key not in ("lines", "curves")}
    # curves are in planes of epsilon and tau
    if cycles["lines"][line]["along"] in ("epsilon", "tau"):
        how |= cycles.get("curves", {})
    # a namelist has no empty lists
    own = {key: value for key, value in cycles["lines"][line].items() if value != []}
    return {**how, **own}


def family_groups(config: dict, family: str) -> dict:
    """Namelists of a family of cases."""
    return study_cases.stability_groups(config["stability"], family)


def trust_groups(config: dict, scene: str) -> dict:
    """Namelists of a scene whose horizon of trust is sought."""
    return study_cases.trust_groups(study_cases.measured_study(config), scene)


def study_groups(config: dict, study: str, name: str) -> dict:
    """Namelists of a study, of one of these two kinds."""
    return (family_groups if study == "stability" else trust_groups)(config, name)


def values_of(config: dict, path: str) -> dict:
    """All that a NetCDF file is computed from, by its path in the folder of results.

    What does not stand in the configuration is a KeyError.
    """
    kind, *folders, name = PurePath(path).with_suffix("").parts
    match kind:
        case "trajectories" | "slip_events":
            return scene_values(config, name)
        case "spectra":
            return {"scene": scene_values(config, name), "spectrum": config["spectra"]}
        case "exponents":
            return exponents_groups(config, name)
        case "linear_stability":
            return linear_stability_values(config, name)
        case "hopf":
            return plane_values(config, name)
        case "cycles":
            return cycles_values(config, name)
        case "attractors":
            return survey_groups(config, "/".join(folders), name)
        case "measurements" | "references" if folders != ["work_precision"]:
            return study_groups(config, folders[0], name)
    raise KeyError(kind)


def are_the_same(path: str, one: dict, other: dict) -> bool:
    """Whether a file is computed from the same values by two configurations."""
    try:
        return values_of(one, path) == values_of(other, path)
    except KeyError:
        return False
