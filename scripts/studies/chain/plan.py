"""Chains of blocks: ln v over time and block, how far blocks are apart, and which modes move.

Formulas and sources: `chain.yaml`, `model_chain.f90`.
"""

from scripts.plans.declare import Figure, Study
from scripts.plans.scenes import is_chain, paths_of_scenes, scenes_of


def inputs_of(scenes: list[str]) -> dict:
    """Trajectories of chains, and the roots of all their modes."""
    return {
        "chains": paths_of_scenes("trajectories", scenes),
        "roots": paths_of_scenes("linear_stability", scenes),
    }


FIGURE = {
    "category": "Chains",
    "variables": ("v",),
}
STUDY = Study(
    reads=("linear_stability", "scenes"),
    figures=(
        Figure(
            "chain",
            place=410,
            inputs=lambda config: inputs_of(scenes_of(config, "chain")),
            **FIGURE,
        ),
    ),
    kinds=(
        Figure(
            "scenes",
            place=70,
            inputs=lambda config: inputs_of(list(config["scenes"])),
            shows=("scenes",),
            shows_entry=is_chain,
            **FIGURE,
        ),
    ),
)
