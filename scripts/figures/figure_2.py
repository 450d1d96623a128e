"""Figure 2: Hopf curves tau(epsilon) at fixed xi and gamma."""

from scripts.figures import plane
from scripts.figures.make_figure import make_figure
from scripts.workflow.result_files import places_in_plane

draw, numbers = plane.draw, plane.numbers


def inputs(_config: dict) -> dict:
    """Hopf curves of the plane."""
    return {"curves": "<results>/hopf/tau_of_epsilon.nc"}


def params(config: dict) -> dict:
    """Scenes that lie in the plane."""
    return {"scenes": places_in_plane(config, "tau_of_epsilon")}


if __name__ == "__main__":
    make_figure(draw, snakemake)
