"""Hopf curves in a plane of epsilon and another parameter."""

from scripts.results.paths import places_in_plane


def inputs(config: dict) -> dict:
    """Hopf curves of the plane that the configuration lists."""
    (plane,) = config["hopf_curves"]
    return {"curves": f"<results>/hopf/{plane}.nc"}


def params(config: dict) -> dict:
    """Scenes that lie in the plane."""
    (plane,) = config["hopf_curves"]
    return {"scenes": places_in_plane(config, plane)}
