"""Whether blocks that move alike stay alike: growth of disturbances over the stiffness of modes."""


def inputs(config: dict) -> dict:
    """Growth along the motion of each scene."""
    return {
        "growth": [f"<results>/synchrony/{scene}.nc" for scene in config["synchrony"]["scenes"]]
    }
