# The configuration, checked, and what rules ask of it.
import sys

from snakemake.exceptions import WorkflowError

sys.path.insert(0, f"{workflow.basedir}/scripts")
import check_config

try:
    config = check_config.checked(config)
except check_config.ConfigError as problems:
    raise WorkflowError(problems) from None


wildcard_constraints:
    scene="|".join(config["scenes"]),
    plane="|".join(config["hopf_curves"]),


def scenes_of(figure):
    """Scenes of a figure, row by row."""
    return [row["scene"] for row in config["figures"][figure]["rows"].values()]


def trajectories_of(figure):
    """Trajectory files that a figure shows."""
    return expand("results/trajectories/{scene}.nc", scene=scenes_of(figure))


def spectra_of(figure):
    """Spectrum files that a figure shows."""
    return expand("results/spectra/{scene}.nc", scene=scenes_of(figure))


def places_of_scenes():
    """Parameters of the scenes that figures show, as marked beside the Hopf curves."""
    shown = dict.fromkeys(scene for figure in config["figures"] for scene in scenes_of(figure))
    keys = ["tau", "epsilon", "xi", "gamma"]
    return {scene: {key: config["scenes"][scene][key] for key in keys} for scene in shown}
