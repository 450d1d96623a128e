"""Figure 5: velocity and phase portrait, rows a (the paper's torus) and b (chaos)."""

from scripts.drawing.spectrum_rows import IN_WORDS
from scripts.drawing.style import logged, save
from scripts.drawing.trajectory_rows import draw
from scripts.files.inputs import read

if __name__ == "__main__":
    with logged(snakemake.log[0]):
        settings = snakemake.params.settings
        trajectories = map(read, snakemake.input.trajectories)
        rows = dict(zip(settings["rows"], trajectories, strict=True))
        spectra = map(read, snakemake.input.spectra)
        titles = {
            label: f"the paper: “{row['paper']}”; seen: {IN_WORDS[spectrum.attrs['spectrum_kind']]}"
            for (label, row), spectrum in zip(settings["rows"].items(), spectra, strict=True)
        }
        figure = draw(rows, titles, settings)
        save(figure, snakemake.output)
