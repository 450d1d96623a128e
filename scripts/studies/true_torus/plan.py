"""Figure of the true torus beside the paper's: in time, spectrum and section."""

from scripts.plans.declare import Figure, Study
from scripts.plans.scenes import paths_of_scenes, scenes_of


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


STUDY = Study(
    reads=("attractors", "cycles", "linear_stability", "scenes"),
    figures=(
        Figure(
            "true_torus",
            category="Atlas",
            place=320,
            inputs=inputs,
            params=lambda config: {"settings": config["figures"]["true_torus"]},
            variables=("v",),
        ),
    ),
)
