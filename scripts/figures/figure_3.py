"""Figure 3: Hopf curves xi(epsilon) at fixed tau and gamma."""

from functools import partial

from scripts.figures import plane
from scripts.figures.make_figure import make_figure

draw, numbers = plane.draw, plane.numbers
inputs = partial(plane.inputs, plane="xi_of_epsilon")
params = partial(plane.params, plane="xi_of_epsilon")

if __name__ == "__main__":
    make_figure(draw, snakemake)
