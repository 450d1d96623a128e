"""Figure of slip events: their recurrence times in turn, the distribution of these, and slips.

Formulas and sources: `slip_events.f90`.
"""

from scripts.plans.declare import Figure, Run, Study
from scripts.plans.scenes import paths_of_scenes, scenes_of
from scripts.requests.program_groups import scene_groups

STUDY = Study(
    reads=("cycles", "scenes"),
    runs=(
        Run(
            *("slip_events", "slip_events", "slip_events/{scene}.nc", scene_groups),
            data="slip_events",
        ),
    ),
    figures=(
        Figure(
            "events",
            category="Supplement",
            place=130,
            inputs=lambda config: {
                "slip_events": paths_of_scenes("slip_events", scenes_of(config, "events"))
            },
            params=lambda config: {"labels": list(config["figures"]["events"]["rows"])},
        ),
    ),
)
