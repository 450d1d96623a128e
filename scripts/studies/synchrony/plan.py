"""Whether blocks that move alike stay alike: growth of disturbances over the stiffness of modes.

Formulas and sources: `transverse_growth.f90`, `transverse_multipliers.f90`.
"""

from scripts.plans.declare import LONG_RUN, Figure, Run, Study
from scripts.requests.program_groups import scene_groups


def groups(config: dict, scene: str) -> dict[str, dict]:
    """The motion of one block of a chain with kappa = 1, and the modes that are tried along it."""
    measured = {key: value for key, value in config["synchrony"].items() if key != "scenes"}
    alone = {"t_end": measured["t_end"], "blocks": 1, "kappa": 1.0, "ends": "free"}
    return {**scene_groups(config, scene, **alone), "synchrony": measured}


def inputs(config: dict) -> dict:
    """Growth along the motion of each scene."""
    scenes = config["synchrony"]["scenes"]
    return {"growth": [f"<results>/synchrony/{scene}.nc" for scene in scenes]}


STUDY = Study(
    reads=("scenes",),
    runs=(Run("synchrony_runs", "synchrony", "synchrony/{scene}.nc", groups, **LONG_RUN),),
    figures=(Figure("synchrony", category="Chains", place=420, inputs=inputs),),
)
