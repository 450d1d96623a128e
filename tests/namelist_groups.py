"""Namelist values that programs accept, for tests to copy and change, and the groups they are in.

Tests name parameters, law and history beside the keys of a group.
"""

from scripts.models.models import HISTORY, PAPER, models
from scripts.requests.parameters import histories_group

OF_MODELS = {
    *(name for model in models({}).values() for name in model.parameters),
}
"""Parameters of the laws of the project."""
OF_SOLVER = ("method", "tolerance", "most_steps")
"""Keys that tests leave in the observation."""


def in_groups(given: dict[str, dict]) -> dict[str, dict]:
    groups = {}
    for name, values in given.items():
        if name == "cases" and isinstance(values, dict):
            rows = zip(*values.values(), strict=True)
            groups[name] = [case_of(dict(zip(values, row, strict=True))) for row in rows]
        elif name == "spectrum":
            rest = dict(values)
            groups |= {key: rest.pop(key) for key in ("trajectory",) if key in rest}
            groups[name] = rest
        elif name == "observation" and "method" in values:
            groups["solver"] = {key: values[key] for key in OF_SOLVER if key in values}
            groups[name] = {key: one for key, one in values.items() if key not in OF_SOLVER}
        elif "law" in values or name == "linear_stability":
            groups |= BY_NAME[name](values)
        else:
            groups[name] = values
    return groups


def with_model(values: dict) -> dict:
    """Values with the model in a group of its own; parameters and law may be missing or wrong."""
    there = {key: values[key] for key in values if key in OF_MODELS}
    model = {"parameters": list(there), "values": list(there.values())}
    chain = {key: values[key] for key in ("blocks", "ends") if key in values}
    name = ("chain_" if "kappa" in there else "") + values["law"] if "law" in values else ""
    left = {*there, *chain, "law"}
    rest = {key: value for key, value in values.items() if key not in left}
    return {"model": {"name": name, **(model if there else {}), **chain}, **rest}


def case_of(case: dict) -> dict:
    rest = with_model({key: value for key, value in case.items() if key not in HISTORY})
    return rest | {"histories": histories_group([{key: case[key] for key in HISTORY}])}


def scene_groups(scene: dict) -> dict[str, dict]:
    rest = {key: value for key, value in scene.items() if key != "history"}
    history = {"theta": 0.0, "u": 0.0, "v": 1.1} | scene.get("history", {})
    return {"scene": with_model(rest), "histories": histories_group([history])}


def cycles_groups(cycles: dict) -> dict[str, dict]:
    rest = {key: value for key, value in cycles.items() if key not in ("v", "curves")}
    # a namelist has no empty lists
    rest = {key: value for key, value in rest.items() if value != []}
    if "curves" in cycles:
        windows = [bound for window in cycles["curves"].values() for bound in window]
        rest |= {"curves_along": list(cycles["curves"]), "curves_windows": windows}
    history = {"theta": 0.0, "u": 0.0, "v": cycles.get("v", 1.1)}
    return {"cycles": with_model(rest), "histories": histories_group([history])}


def stability_groups(stability: dict) -> dict[str, dict]:
    ends = {"tau": (0.0, "tau_most"), "epsilon": (-1.0, "epsilon_most")}
    given = {axis: (start, key) for axis, (start, key) in ends.items() if key in stability}
    rest = {key: value for key, value in stability.items() if not key.endswith("_most")}
    windows = [bound for start, key in given.values() for bound in (start, stability[key])]
    changes = {"along": list(given), "windows": windows} if given else {}
    return {"linear_stability": with_model(rest) | changes}


def points_groups(points: dict) -> dict[str, dict]:
    """Axes are epsilon and, unless another one is given, tau; histories are lists."""
    axes = ("epsilon", points.get("ordinate", "tau"))
    keys = ("window", "count", "part")
    of_axes = [{"along": axis, **{key: points[f"{axis}_{key}"] for key in keys}} for axis in axes]
    left = {*HISTORY, "ordinate", *(f"{axis}_{key}" for axis in (*axes, "tau") for key in keys)}
    rest = {key: value for key, value in points.items() if key not in left}
    values = zip(*(points[key] for key in HISTORY), strict=True)
    histories = [dict(zip(HISTORY, one, strict=True)) for one in values]
    return {"points": with_model(rest) | {"axes": of_axes}, "histories": histories_group(histories)}


def hopf_groups(plane: dict) -> dict[str, dict]:
    named = {"abscissa": "epsilon", **plane}
    axes = [named.pop(key) for key in ("abscissa", "ordinate")]
    windows = [bound for key in ("abscissa", "ordinate") for bound in named.pop(f"{key}_window")]
    return {"hopf_curves": {**with_model(named), "along": axes, "windows": windows}}


BY_NAME = {
    "scene": scene_groups,
    "cycles": cycles_groups,
    "linear_stability": stability_groups,
    "points": points_groups,
    "hopf_curves": hopf_groups,
}


OBSERVATION = {
    "t_transient": 100.0,
    "t_observed": 200.0,
    "t_lasting": 50.0,
    "t_turning": 20.0,
    "t_path": 0.0,
    "interval": 5.0,
    "exponents": 4,
    "zero_level": 1e-4,
    "longest_bar": 1e-3,
    "doublings": 0,
    "sample_interval": 0.1,
    "window": "hann",
    "segments": 2,
    "overlap": 0.5,
    "peak_floor": 1e-6,
    "peak_prominence": 10.0,
    "tolerance": 1e-6,
    "method": "auto",
    "most_steps": 100000,
}
SYNCHRONY = {
    **{"s_window": [1.0, 2.0], "count": 2, "t_end": 60.0, "t_turning": 5.0},
    **{"interval": 5.0, "batches": 2},
}
POINTS = {
    "name": "a part",
    **{"epsilon_window": [0.1, 0.5], "epsilon_count": 3, "epsilon_part": [2, 3]},
    **{"tau_window": [0.0, 10.0], "tau_count": 2, "tau_part": [1, 2]},
    **{"xi": 0.8, "gamma": 0.8},
    "theta": [0.0, 0.5],
    "u": [0.0, -0.5],
    "v": [1.1, 1.5],
    "law": PAPER,
    "sweep": "none",
    "refinements": 0,
    "kept": 100,
}
CASES = {
    "name": ["decay", "stiff"],
    "tau": [0.0, 1.0],
    "epsilon": [0.3, 0.7],
    "xi": [0.8, 0.5],
    "gamma": [0.8, 100.0],
    "law": [PAPER, PAPER],
    "theta": [0.1, 0.0],
    "u": [0.2, 0.0],
    "v": [1.5, 1.1],
    "t_end": [20.0, 5.0],
    "sample_interval": [0.5, 0.5],
}
MEASURE = {
    "methods": ["auto", "explicit", "rk4_cubic"],
    "tolerances": [1e-6, 1e-9],
    "steps": [0.01],
    "most_steps": 1000,
    "repeats": 2,
    "least_seconds": 1e-4,
}
REFERENCE = {
    "method": "auto",
    "tolerance": 1e-18,
    "check_method": "radau13",
    "check_tolerance": 1e-16,
    "disturbance": 1e-15,
    "most_steps": 100000,
}
EXPONENTS = {
    "count": 2,
    "t_end": 20.0,
    "t_turning": 5.0,
    "interval": 1.0,
    "batches": 2,
    "zero_level": 1e-3,
    "longest_bar": 1e-3,
    "check_tolerances": [1e-7],
}
