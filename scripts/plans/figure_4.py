"""Figure 4: velocity and phase portrait, rows a (fixed point) and b (oscillations)."""

from scripts.results.paths import paths_of_scenes, scenes_of

VARIABLES = ("u", "v")


def inputs(config: dict) -> dict:
    """Trajectories of the rows, and classes of motion."""
    return {
        "table": "<results>/tables/attractors.tsv",
        "trajectories": paths_of_scenes("trajectories", scenes_of(config, *config["figures"])),
    }


def params(config: dict) -> dict:
    """Rows with the paper's words, and the times shown."""
    (settings,) = config["figures"].values()
    return {"settings": settings}
