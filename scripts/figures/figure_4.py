"""Figure 4: velocity and phase portrait, rows a (fixed point) and b (oscillations)."""

from scripts.drawing.style import logged, save
from scripts.drawing.trajectory_rows import draw
from scripts.files.inputs import read

if __name__ == "__main__":
    with logged(snakemake.log[0]):
        settings = snakemake.params.settings
        trajectories = map(read, snakemake.input.trajectories)
        rows = dict(zip(settings["rows"], trajectories, strict=True))
        titles = {label: f"the paper: “{row['paper']}”" for label, row in settings["rows"].items()}
        figure = draw(rows, titles, settings)
        save(figure, snakemake.output)
