"""Figure 5: velocity and phase portrait, rows a (the paper's torus) and b (chaos)."""

from functools import partial

from scripts.figures import figure_4
from scripts.figures.make_figure import make_figure

VARIABLES, draw, numbers = figure_4.VARIABLES, figure_4.draw, figure_4.numbers
inputs = partial(figure_4.inputs, figure="figure_5")
params = partial(figure_4.params, figure="figure_5")

if __name__ == "__main__":
    make_figure(draw, snakemake)
