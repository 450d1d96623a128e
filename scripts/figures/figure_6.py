"""Figure 6: power spectra, rows a (oscillations) and b (the paper's torus)."""

from scripts.drawing.spectrum_rows import draw
from scripts.drawing.style import logged, save
from scripts.files.inputs import read

if __name__ == "__main__":
    with logged(snakemake.log[0]):
        settings = snakemake.params.settings
        spectra = map(read, snakemake.input.spectra)
        rows = dict(zip(settings["rows"], spectra, strict=True))
        paper = {label: row["paper"] for label, row in settings["rows"].items()}
        figure = draw(rows, paper, settings["frequency_shown"])
        save(figure, snakemake.output)
