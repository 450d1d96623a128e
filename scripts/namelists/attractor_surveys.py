"""Where attractors are looked for: namelists of scenes, of the atlas and of the route to chaos."""

import math

import numpy as np


def drawn_histories(own: dict, count: int, ranges: dict) -> list[dict]:
    """The scene's own history first, then others drawn evenly from the ranges, always the same."""
    draw = np.random.default_rng(ranges["seed"]).uniform
    others = [
        {
            "theta": float(draw(*ranges["theta"])),
            "u": float(draw(*ranges["u"])),
            "v": math.exp(draw(*ranges["ln_v"])),
        }
        for _ in range(count - 1)
    ]
    return [own, *others]


def observation_group(observation: dict, spectra: dict) -> dict:
    """The namelist group of how attractors are judged."""
    return {**{key: value for key, value in observation.items() if key != "kept"}, **spectra}


def points_group(
    name: str,
    *,
    parameters: dict,
    epsilon: dict,
    tau: dict,
    histories: list[dict],
    kept: int,
) -> dict:
    """The namelist group of points; `epsilon` and `tau` hold window, count and part."""
    axes = {
        f"{axis}_{key}": value
        for axis, values in (("epsilon", epsilon), ("tau", tau))
        for key, value in values.items()
    }
    columns = {key: [history[key] for history in histories] for key in ("theta", "u", "v")}
    return {"name": name, **parameters, **axes, **columns, "kept": kept}


def single(value: float) -> dict:
    """An axis of one value."""
    return {"window": [value, value], "count": 1, "part": [1, 1]}


def part_of(count: int, parts: int, part: int) -> list[int]:
    """First and last of `count` places in part 1..parts, all about as large."""
    return [(part - 1) * count // parts + 1, part * count // parts]


def scene_groups(config: dict, scene: str) -> dict:
    """Namelist of a scene: its own history and others."""
    settings, study = config["scenes"][scene], config["attractors"]
    histories = drawn_histories(
        settings["history"], settings["attractors"]["histories"], study["histories"]
    )
    observation = {**study["observation"], "t_transient": settings["t_transient"]}
    points = points_group(
        scene,
        parameters={key: settings[key] for key in ("xi", "gamma")},
        epsilon=single(settings["epsilon"]),
        tau=single(settings["tau"]),
        histories=histories,
        kept=observation["kept"],
    )
    return {"observation": observation_group(observation, config["spectra"]), "points": points}


def atlas_groups(config: dict, plane: str, grid: str, part: int) -> dict:
    """Namelist of a part of the atlas: some rows of the grid."""
    atlas = config["atlas"]
    settings, count = atlas["grids"][grid], atlas["grids"][grid]["epsilon_count"]
    rows = part_of(settings["tau_count"], settings["parts"], part)
    points = points_group(
        f"{plane} part {part} of {settings['parts']}",
        parameters={"xi": atlas["planes"][plane]["xi"], "gamma": atlas["gamma"]},
        epsilon={"window": atlas["epsilon_window"], "count": count, "part": [1, count]},
        tau={"window": atlas["tau_window"], "count": settings["tau_count"], "part": rows},
        histories=[atlas["history"]],
        kept=settings["observation"]["kept"],
    )
    observation = observation_group(settings["observation"], config["spectra"])
    return {"observation": observation, "points": points}


def route_groups(config: dict, part: int) -> dict:
    """Namelist of a part of the route."""
    route = config["route"]
    count = route["epsilon_count"]
    points = points_group(
        f"route part {part} of {route['parts']}",
        parameters={key: route[key] for key in ("xi", "gamma")},
        epsilon={
            "window": route["epsilon_window"],
            "count": count,
            "part": part_of(count, route["parts"], part),
        },
        tau=single(route["tau"]),
        histories=[route["history"]],
        kept=route["observation"]["kept"],
    )
    observation = observation_group(route["observation"], config["spectra"])
    return {"observation": observation, "points": points}
