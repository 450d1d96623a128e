"""Figure of the true torus beside the paper's: in time, spectrum and section."""

from scripts.results.paths import paths_of_scenes, scenes_of

VARIABLES = ("v",)


def inputs(config: dict) -> dict:
    """Trajectories, attractors, spectra and classes of the rows, and roots of the first."""
    scenes = scenes_of(config, "true_torus")
    return {
        "table": "<results>/tables/attractors.tsv",
        "trajectories": paths_of_scenes("trajectories", scenes),
        "attractors": paths_of_scenes("attractors/scenes", scenes),
        "spectra": paths_of_scenes("spectra", scenes),
        "roots": f"<results>/linear_stability/{scenes[0]}.nc",
    }


def params(config: dict) -> dict:
    """Rows, and the times and frequencies shown."""
    return {"settings": config["figures"]["true_torus"]}
