"""Figure 7: power spectrum of the chaotic scene."""

from functools import partial

from scripts.figures import figure_6
from scripts.figures.make_figure import make_figure

draw, numbers = figure_6.draw, figure_6.numbers
inputs = partial(figure_6.inputs, figure="figure_7")
params = partial(figure_6.params, figure="figure_7")

if __name__ == "__main__":
    make_figure(draw, snakemake)
