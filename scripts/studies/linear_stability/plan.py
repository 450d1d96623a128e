"""Linear stability of steady sliding: roots of (5) and changes of stability of every scene.

Formulas and sources: (5) `characteristic_roots.f90`, `stability_changes.f90`.
"""

from scripts.namelists.parameters import place_of, with_parameters
from scripts.plans.declare import Run, Study, Table
from scripts.plans.scenes import paths_of_scenes


def groups(config: dict, scene: str) -> dict[str, dict]:
    """The parameters of a scene, and the bounds of roots and changes of its linear stability."""
    place = place_of(config, config["scenes"][scene])
    return {"linear_stability": {**with_parameters(config, place), **config["linear_stability"]}}


STUDY = Study(
    reads=("basins", "scenes"),
    runs=(Run("linear_stability", "linear_stability", "linear_stability/{scene}.nc", groups),),
    tables=(
        Table(
            *("linear_stability_table", "tables/linear-stability.tsv"),
            lambda config: {"scenes": paths_of_scenes("linear_stability", config["scenes"])},
            wanted=lambda config: bool(config["scenes"]),
        ),
    ),
)
