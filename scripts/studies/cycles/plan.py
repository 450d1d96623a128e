"""Figure of the cycles followed: their greatest v along a parameter, stable or not.

Formulas and sources: `orbit_equations.f90`, `floquet_multipliers.f90`, `orbit_branch.f90`,
`orbit_points.f90`, `torus_normal_form.f90`, `cycle_branches.f90`.
"""

from itertools import chain
from pathlib import PurePath

from scripts.models.records import place_of
from scripts.plans.declare import LONGEST, Figure, Run, Study, Table
from scripts.plans.scenes import curves_of, marked_scenes
from scripts.requests.parameters import histories_group, with_model


def groups(config: dict, cycle_line: str) -> dict[str, dict]:
    """The line on which cycles are followed, and how."""
    cycles = config["cycles"]
    how = {key: value for key, value in cycles.items() if key not in ("lines", "curves", "v")}
    line = dict(cycles["lines"][cycle_line])
    history = line.pop("history", {"theta": 0.0, "u": 0.0, "v": cycles["v"]})
    if curves := curves_of(config, line):
        how |= {"curves_along": list(curves), "curves_windows": [*chain(*curves.values())]}
    # a namelist has no empty lists
    own = {key: value for key, value in line.items() if key != "curves" and value != []}
    return {"cycles": with_model(config, {**how, **own}), "histories": histories_group([history])}


def cycles_of_lines(config: dict) -> list[str]:
    """Cycles followed along all lines."""
    return [f"<results>/cycles/{line}.nc" for line in config["cycles"]["lines"]]


def sweeps_on_lines(config: dict) -> list[list[str]]:
    """Sweeps on each line of cycles: those of the route with the widest window."""

    def place(settings: dict) -> dict:
        return {"along": settings["along"], **place_of(config, settings)}

    found = []
    for settings in config["cycles"]["lines"].values():
        routes = [
            (route["window"][1] - route["window"][0], name)
            for name, route in config["routes"]["lines"].items()
            if place(route) == place(settings)
        ]
        found.append(
            [
                f"<results>/attractors/routes/{name}/{run}.nc"
                for _, name in sorted(routes)[-1:]
                for run in config["routes"]["sweeps"]
            ]
        )
    return found


def inputs(config: dict) -> dict:
    """Cycles of each line, and the sweeps of routes on the same lines."""
    sweeps = [path for on_line in sweeps_on_lines(config) for path in on_line]
    return {"cycles": cycles_of_lines(config), "sweeps": sweeps}


def params(config: dict) -> dict:
    """Directions of the sweeps on each line, and scenes with known attractors."""
    directions = [[PurePath(path).stem for path in one] for one in sweeps_on_lines(config)]
    return {"directions": directions, "scenes": marked_scenes(config)}


FIGURE = {"inputs": inputs, "params": params}
STUDY = Study(
    reads=("attractors", "exponents", "linear_stability", "routes", "scenes"),
    entries={"cycle_line": ("cycles", "lines")},
    runs=(
        Run(
            *("cycles_runs", "cycles", "cycles/{cycle_line}.nc", groups),
            data="cycles",
            priority=LONGEST,
            minutes=10,
        ),
    ),
    tables=(
        Table(
            *("cycle_points", "tables/cycle-points.tsv"),
            lambda config: {
                "cycles": cycles_of_lines(config),
                "routes": [f"<results>/tables/routes/{r}.tsv" for r in config["routes"]["lines"]],
            },
            wanted=lambda config: bool(config["cycles"]["lines"]),
        ),
    ),
    figures=(Figure("cycles", category="Atlas", place=340, **FIGURE),),
    kinds=(Figure("cycles", category="Cycles", place=50, shows=("cycles", "lines"), **FIGURE),),
)
