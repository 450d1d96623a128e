"""Figure 5: velocity and phase portrait, rows a (the paper's torus) and b (chaos)."""

from scripts.drawing.style import logged, save
from scripts.drawing.trajectory_rows import draw, titles_of
from scripts.files.inputs import read
from scripts.files.tsv import read_table

if __name__ == "__main__":
    with logged(snakemake.log[0]):
        settings = snakemake.params.settings
        trajectories = map(read, snakemake.input.trajectories)
        rows = dict(zip(settings["rows"], trajectories, strict=True))
        titles = titles_of(settings, read_table(snakemake.input.table))
        save(draw(rows, titles, settings), snakemake.output)
