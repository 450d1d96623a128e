"""Figure 3: Hopf curves xi(epsilon) at fixed tau and gamma."""

import xarray as xr
from drawing import logged, save
from hopf_plane import draw

if __name__ == "__main__":
    with logged(snakemake.log[0]):
        figure = draw(xr.load_dataset(snakemake.input.curves), snakemake.params.scenes)
        save(figure, snakemake.output.pdf, snakemake.output.png)
