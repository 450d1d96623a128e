"""Figure of one scene: in time, phase portrait, section, exponents, and spectrum."""

VARIABLES = ("u", "v")


def inputs(config: dict) -> dict:
    """Trajectory, spectrum, attractors and roots of the scene that the configuration lists."""
    (scene,) = config["scenes"]
    return {
        "trajectory": f"<results>/trajectories/{scene}.nc",
        "spectrum": f"<results>/spectra/{scene}.nc",
        "attractors": f"<results>/attractors/scenes/{scene}.nc",
        "roots": f"<results>/linear_stability/{scene}.nc",
    }


def params(config: dict) -> dict:
    """The quantities of a scene that is given in SI."""
    (scene,) = config["scenes"].values()
    return {"si": scene.get("si", {})}
