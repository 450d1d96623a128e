"""Namelist values that programs accept, for tests to copy and change, and the groups they are in.

Tests name the keys of a group without the groups within it.
"""

from scripts.namelists.laws import PAPER
from scripts.namelists.parameters import HISTORY, PARAMETERS
from scripts.namelists.program_groups import case_groups, nested

PARTS = {
    "scene": {"parameters": [*PARAMETERS, "law", "own"]},
    "linear_stability": {"parameters": [*PARAMETERS, "law"]},
    "cycles": {"parameters": [*PARAMETERS, "law"]},
    "hopf_curves": {"parameters": [*PARAMETERS, "law"]},
    "points": {"parameters": [*PARAMETERS, "law", "own_names", "own"]},
}
"""For a group: the groups within it and their keys."""
BESIDE = {
    "points": {"histories": HISTORY},
    "observation": {"solver": ["method", "tolerance", "most_steps"]},
}
"""For a group: groups beside it that tests leave in it, and their keys."""


def in_groups(given: dict[str, dict]) -> dict[str, dict]:
    groups = {}
    for name, values in given.items():
        for part, keys in PARTS.get(name, {}).items():
            values = nested(values, part, keys)
        for part, keys in BESIDE.get(name, {}).items():
            values = nested(values, part, keys)
            groups[part] = values.pop(part)
        if name == "points":
            axes = ("epsilon", values.pop("ordinate", "tau"))
            values["axes"] = [
                {key: values.pop(f"{axis}_{key}") for key in ("window", "count", "part")}
                | {"along": axis}
                for axis in axes
            ]
            values = {key: value for key, value in values.items() if not key.startswith("tau_")}
        if name == "spectrum":
            groups |= {key: values[key] for key in ("trajectory",) if key in values}
            values = {key: value for key, value in values.items() if key != "trajectory"}
        if name == "cases":
            rows = zip(*values.values(), strict=True)
            cases = [dict(zip(values, row, strict=True)) for row in rows]
            groups |= case_groups({"laws": {}}, cases)
            continue
        groups[name] = values
    return groups


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
    **{"interval": 5.0, "blocks": 2},
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
    "blocks": 2,
    "zero_level": 1e-3,
    "longest_bar": 1e-3,
    "check_tolerances": [1e-7],
}
