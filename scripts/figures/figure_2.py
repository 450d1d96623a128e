"""Figure 2: Hopf curves tau(epsilon) at fixed xi and gamma."""

from scripts.drawing.hopf_plane import draw
from scripts.drawing.style import logged, save
from scripts.files.inputs import read

if __name__ == "__main__":
    with logged(snakemake.log[0]):
        figure = draw(read(snakemake.input.curves), snakemake.params.scenes)
        save(figure, snakemake.output)
