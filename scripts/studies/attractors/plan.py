"""Where the motions of scenes end: classes of attractors from the scene's own history and others.

Formulas and sources: `attractors.f90`, `motion_classes.f90`, `section_motion.f90`.
"""

from scripts.models.models import HISTORY
from scripts.plans.declare import PAPER, Run, Study, Table
from scripts.plans.scenes import blocks_of, paths_of_scenes, scenes_with
from scripts.requests.attractor_surveys import drawn_histories, survey_groups
from scripts.requests.parameters import histories_of


def groups(config: dict, scene: str) -> dict:
    """Namelist of a scene: its own history and others."""
    settings, study = config["scenes"][scene], config["attractors"]
    count = settings.get("attractors", {}).get("histories", study["count"])
    others = drawn_histories((count - 1) * settings["blocks"], study["histories"], HISTORY)
    histories = [*histories_of(settings), *others]
    return survey_groups(config, "attractors", scene, place=settings, histories=histories)


def inputs(config: dict) -> dict:
    """Attractors of all scenes that ask for them."""
    return {"runs": paths_of_scenes("attractors/scenes", scenes_with(config, "attractors"))}


def of_user(config: dict) -> None:
    """Look for the attractors of all scenes of one block."""
    for scene in blocks_of(config):
        config["scenes"][scene].setdefault("attractors", {})


STUDY = Study(
    reads=("exponents", "linear_stability", "scenes"),
    runs=(  # the paper's figures 4 and 5 show the classes of the scenes
        Run(
            *("scene_attractors", "attractors", "attractors/scenes/{scene}.nc", groups),
            priority=PAPER,
            minutes=10,
        ),
    ),
    tables=(
        Table(
            *("attractors_table", "tables/attractors.tsv", inputs),
            params={"of": lambda _config: "scenes"},
            script="tables/attractor_tables.py",
            wanted=lambda config: bool(scenes_with(config, "attractors")),
            priority=PAPER,
        ),
    ),
    of_user=of_user,
)
