"""Figure of the routes: maxima of v, classes, and the largest exponent along a parameter.

Formulas and sources: as of the attractors; sweeps `attractor_points.f90`.
"""

from scripts.plans.declare import LONG_RUN, Figure, Run, Study, Table
from scripts.plans.scenes import marked_scenes
from scripts.requests.attractor_surveys import evenly_spaced, survey_groups


def groups(config: dict, route: str, run: str) -> dict:
    """Namelist of a run of a route: from one history, or a sweep.

    Along a value of the history, the others are those of the run's history.
    """
    routes = config["routes"]
    settings = routes["lines"][route]
    along, window, count = (settings[key] for key in ("along", "window", "count"))
    by_run = histories_of(config, route)
    first = next(iter(by_run))
    histories = [by_run.get(run, by_run[first])]
    of_history = along in histories[0]
    if of_history:
        values = evenly_spaced(window, count)
        histories = [{**histories[0], along: value} for value in values]
    varied = {} if of_history else {along: {"window": window, "count": count}}
    place = {**settings, **varied}
    sweep = run if run in routes["sweeps"] else "none"
    return survey_groups(
        config, "routes", f"{route} {run}", place=place, histories=histories, sweep=sweep
    )


def histories_of(config: dict, route: str) -> dict[str, dict]:
    """Histories of a route by the names of its runs: its own one, or those of all routes."""
    routes = config["routes"]
    own = routes["lines"][route].get("history")
    return {"own": own} if own else routes["histories"]


def runs_of_route(config: dict, route: str) -> list[str]:
    """Runs along a route: from each history, and sweeps of a parameter."""
    routes, histories = config["routes"], histories_of(config, route)
    varies_history = routes["lines"][route]["along"] in next(iter(histories.values()))
    runs = [*histories, *([] if varies_history else routes["sweeps"])]
    return [f"<results>/attractors/routes/{route}/{run}.nc" for run in runs]


def inputs(config: dict) -> dict:
    """Classes along each route, and its runs."""
    routes = config["routes"]["lines"]
    return {
        "tables": [f"<results>/tables/routes/{route}.tsv" for route in routes],
        "runs": [path for route in routes for path in runs_of_route(config, route)],
    }


FIGURE = {"inputs": inputs, "params": lambda config: {"scenes": marked_scenes(config)}}
STUDY = Study(
    reads=("atlas", "attractors", "cycles", "hopf", "linear_stability", "scenes"),
    entries={"route": ("routes", "lines")},
    wildcards={"run": r"\w+"},
    runs=(
        Run(
            *("route_runs", "attractors", "attractors/routes/{route}/{run}.nc", groups),
            **LONG_RUN,
        ),
    ),
    tables=(
        Table(
            *("route_table", "tables/routes/{route}.tsv"),
            lambda config, route: {"runs": runs_of_route(config, route)},
            params={"of": lambda _config, **_: "route"},
            script="tables/attractor_tables.py",
            data="route_points",
        ),
    ),
    figures=(Figure("routes", category="Atlas", place=330, **FIGURE),),
    kinds=(Figure("routes", category="Routes", place=40, shows=("routes", "lines"), **FIGURE),),
)
