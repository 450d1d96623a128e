"""Where attractors are looked for: namelists of scenes, of the atlas, of routes and of basins."""

import math

import numpy as np

from scripts.namelists.study_cases import HISTORY, PARAMETERS


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


def judged_groups(observation: dict, spectra: dict, points: dict[str, dict]) -> dict[str, dict]:
    """The namelist groups of points and of how attractors are found and judged there."""
    solver = {key: observation[key] for key in ("method", "tolerance", "most_steps")}
    others = {key: observation[key] for key in observation if key not in ("kept", *solver)}
    return {"observation": {**others, **spectra}, "solver": solver, **points}


def points_groups(
    name: str,
    *,
    place: dict,
    histories: list[dict],
    kept: int,
    sweep: str = "none",
    refinements: int = 0,
) -> dict[str, dict]:
    """The namelist groups of points and histories; parameters of the place are values or axes."""
    axes = {parameter: axis_of(place[parameter]) for parameter in PARAMETERS}
    columns = {key: [history[key] for history in histories] for key in HISTORY}
    how = {"sweep": sweep, "refinements": refinements, "kept": kept}
    return {"points": {"name": name, **axes, **how}, "histories": columns}


def axis_of(given: float | dict) -> dict:
    """Window, count and part: as given, all of its values, or those of one value."""
    axis = given if isinstance(given, dict) else {"window": [given, given], "count": 1}
    return {"part": [1, axis["count"]], **axis}


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
    observation = study["observation"]
    points = points_groups(
        scene,
        place=settings,
        histories=[settings["history"], *others],
        kept=observation["kept"],
    )
    return judged_groups(observation, config["spectra"], points)


def atlas_groups(config: dict, plane: str, part: int) -> dict:
    """Namelist of a part of the atlas: some delays of a plane.

    A part is refined by itself, from every 2**refinements-th of its delays and from the last.
    """
    atlas = config["atlas"]
    settings, refinements = atlas["planes"][plane], atlas["refinements"]
    delays = part_of(atlas["tau_count"], atlas["parts"], part, 2**refinements)
    points = points_groups(
        f"{plane} part {part} of {atlas['parts']}",
        place={
            **settings,
            "epsilon": {"window": atlas["epsilon_window"], "count": atlas["epsilon_count"]},
            "tau": {"window": settings["tau_window"], "count": atlas["tau_count"], "part": delays},
        },
        histories=[atlas["history"]],
        kept=atlas["observation"]["kept"],
        refinements=refinements,
    )
    return judged_groups(atlas["observation"], config["spectra"], points)


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
    points = points_groups(
        f"{line} {run}",
        place={**settings, along: {"window": window, "count": count}},
        histories=histories,
        kept=routes["observation"]["kept"],
        sweep=run if run in routes["sweeps"] else "none",
    )
    return judged_groups(routes["observation"], config["spectra"], points)


def basin_groups(config: dict, place: str) -> dict:
    """Namelist of a place where motions coexist: random histories."""
    basins = config["basins"]
    points = points_groups(
        place,
        place=basins["places"][place],
        histories=drawn_histories(basins["count"], basins["histories"]),
        kept=basins["observation"]["kept"],
    )
    return judged_groups(basins["observation"], config["spectra"], points)
