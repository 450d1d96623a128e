"""Figure of the routes: maxima of v, classes, and the largest exponent along a parameter."""

from scripts.results.paths import places_in_atlas, runs_of_routes, tables_of_routes


def inputs(config: dict) -> dict:
    """Classes along each route, and its runs."""
    return {"tables": tables_of_routes(config), "runs": runs_of_routes(config)}


def params(config: dict) -> dict:
    """Scenes with known attractors."""
    return {"scenes": places_in_atlas(config)}
