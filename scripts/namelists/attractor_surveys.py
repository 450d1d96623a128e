"""Where attractors are looked for: namelists of scenes, of the atlas, of routes and of basins."""

import math

import numpy as np

from scripts.namelists.study_cases import HISTORY, with_parameters

LEAST_DISTANCES = 6
"""Distances between the lines of a plane that are computed in full: those of the default grid, of
which it is known how many points get another class than if computed."""


def drawn_histories(count: int, ranges: dict) -> list[dict]:
    """Histories drawn evenly from the ranges, the same for the same seed."""
    draw = np.random.default_rng(ranges["seed"]).uniform
    return [
        {
            "theta": float(draw(*ranges["theta"])),
            "u": float(draw(*ranges["u"])),
            "v": math.exp(draw(*ranges["ln_v"])),
        }
        for _ in range(count)
    ]


def survey_groups(
    config: dict,
    section: str,
    name: str,
    *,
    place: dict,
    histories: list[dict],
    sweep: str = "none",
    refinements: int = 0,
) -> dict[str, dict]:
    """The namelist of points and histories, and of how attractors are found and judged there.

    Parameters of the place are values or axes, of which the first one runs fastest.
    """
    observation = dict(config[section]["observation"])
    how = {"sweep": sweep, "refinements": refinements, "kept": observation.pop("kept")}
    solver = {key: observation.pop(key) for key in ("method", "tolerance", "most_steps")}
    axes = [
        {"along": key, "part": [1, value["count"]], **value}
        for key, value in place.items()
        if isinstance(value, dict) and "window" in value
    ]
    fixed = {key: value for key, value in place.items() if key not in [x["along"] for x in axes]}
    points = {"name": name, "parameters": with_parameters(config, fixed)["parameters"], **how}
    return {
        "observation": {**observation, **config["spectra"]},
        "solver": solver,
        # a namelist has no empty lists
        "points": {**points, **({"axes": axes} if axes else {})},
        "histories": {key: [history[key] for history in histories] for key in HISTORY},
    }


def refinements_of(atlas: dict) -> int:
    """The refinements of the file, or as many as leave enough distances of its first lines."""
    fewest = min(atlas["epsilon_count"], atlas["ordinate_count"]) - 1
    return min(atlas["refinements"], max(0, (fewest // LEAST_DISTANCES).bit_length() - 1))


def part_of(count: int, parts: int, part: int, distance: int = 1) -> list[int]:
    """First and last of `count` lines in part 1..parts, all about as large.

    From the first to the last line of a part but the last, there is a whole number of distances.
    """
    steps = (count - parts) // distance
    first, after = (i * steps // parts * distance + i + 1 for i in (part - 1, part))
    return [first, count if part == parts else after - 1]


def scene_groups(config: dict, scene: str) -> dict:
    """Namelist of a scene: its own history and others."""
    settings, study = config["scenes"][scene], config["attractors"]
    count = settings.get("attractors", {}).get("histories", study["count"])
    others = drawn_histories(count - 1, study["histories"])
    histories = [settings["history"], *others]
    return survey_groups(config, "attractors", scene, place=settings, histories=histories)


def atlas_groups(config: dict, plane: str, part: int) -> dict:
    """Namelist of a part of the atlas: some lines of a plane.

    A part is refined by itself, from every 2**refinements-th of its lines and from the last.
    """
    atlas = config["atlas"]
    settings, refinements = atlas["planes"][plane], refinements_of(atlas)
    count = atlas["ordinate_count"]
    shown = part_of(count, atlas["parts"], part, 2**refinements)
    columns = {"window": atlas["epsilon_window"], "count": atlas["epsilon_count"]}
    lines = {"window": settings["ordinate_window"], "count": count, "part": shown}
    name = f"{plane} part {part} of {atlas['parts']}"
    place = {**settings, "epsilon": columns, settings["ordinate"]: lines}
    histories = [atlas["history"]]
    return survey_groups(
        config, "atlas", name, place=place, histories=histories, refinements=refinements
    )


def law_groups(config: dict, law: str, part: str) -> dict:
    """Namelist of a plane, or of a scene, under a law of friction.

    Scenes are judged as their attractors are.
    """
    study, section = config["friction_laws"], "friction_laws"
    if part in study["planes"]:
        plane = study["planes"][part]
        columns = {"window": study["epsilon_window"], "count": study["epsilon_count"]}
        lines = {"window": plane["tau_window"], "count": study["tau_count"]}
        place, histories = {**plane, "epsilon": columns, "tau": lines}, [study["history"]]
    else:
        place, section = config["scenes"][part], "attractors"
        histories = [place["history"]]
    return survey_groups(
        config,
        section,
        f"{part} with {law}",
        place={**place, "law": law},
        histories=histories,
    )


def route_groups(config: dict, line: str, run: str) -> dict:
    """Namelist of a run of a route: from one history, or a sweep.

    Along a value of the history, the others are those of the run's history.
    """
    routes = config["routes"]
    settings = routes["lines"][line]
    along, window, count = (settings[key] for key in ("along", "window", "count"))
    first = next(iter(routes["histories"]))
    histories = [routes["histories"].get(run, routes["histories"][first])]
    if along in HISTORY:
        values = np.linspace(*window, count).tolist()
        histories = [{**histories[0], along: value} for value in values]
    varied = {} if along in HISTORY else {along: {"window": window, "count": count}}
    place = {**settings, **varied}
    sweep = run if run in routes["sweeps"] else "none"
    return survey_groups(
        config, "routes", f"{line} {run}", place=place, histories=histories, sweep=sweep
    )


def basin_groups(config: dict, place: str) -> dict:
    """Namelist of a place where motions coexist: random histories."""
    basins = config["basins"]
    histories = drawn_histories(basins["count"], basins["histories"])
    return survey_groups(
        config, "basins", place, place=basins["places"][place], histories=histories
    )
