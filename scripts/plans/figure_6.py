"""Figure 6: power spectra, rows a (oscillations) and b (the paper's torus)."""

from scripts.results.paths import paths_of_scenes, scenes_of


def inputs(config: dict) -> dict:
    """Spectra of the rows."""
    return {"spectra": paths_of_scenes("spectra", scenes_of(config, *config["figures"]))}


def params(config: dict) -> dict:
    """Rows with the paper's words, and the frequencies shown."""
    (settings,) = config["figures"].values()
    return {"settings": settings}
