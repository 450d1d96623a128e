"""Networks: the states of all nodes over time.

Formulas and sources: `generator/network.py`, `model_network.f90`.
"""

from scripts.plans.declare import Figure, Study
from scripts.plans.scenes import is_network, paths_of_scenes

STUDY = Study(
    reads=("scenes",),
    kinds=(
        Figure(
            "scenes",
            category="Networks",
            place=75,
            inputs=lambda config: {"runs": paths_of_scenes("trajectories", [*config["scenes"]])},
            shows=("scenes",),
            shows_entry=is_network,
        ),
    ),
)
