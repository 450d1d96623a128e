"""Linear stability of steady sliding: roots of (5) and changes of stability of every scene.

Formulas and sources: (5) `characteristic_roots.f90`, `stability_changes.f90`.
"""

from scripts.models.models import model_of
from scripts.plans.declare import Run, Study, Table
from scripts.plans.scenes import roots_of_scenes
from scripts.requests.parameters import with_model


def groups(config: dict, scene: str) -> dict[str, dict]:
    """The parameters of a scene, and the bounds of roots and changes of its linear stability."""
    study, settings = config["linear_stability"], config["scenes"][scene]
    group = {"model": with_model(config, settings)["model"], "root_bound": study["root_bound"]}
    if model_of(config, settings).is_block:
        windows = [0.0, study["tau_most"], -1.0, study["epsilon_most"]]
        group |= {"along": ["tau", "epsilon"], "windows": windows}
    return {"linear_stability": group}


STUDY = Study(
    reads=("basins", "scenes"),
    runs=(Run("linear_stability", "linear_stability", "linear_stability/{scene}.nc", groups),),
    tables=(
        Table(
            *("linear_stability_table", "tables/linear-stability.tsv"),
            lambda config: {"scenes": roots_of_scenes(config)},
            wanted=lambda config: bool(roots_of_scenes(config)),
        ),
    ),
)
