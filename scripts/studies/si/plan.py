"""Scenes in SI: their units, and their slip events in metres, seconds and pascals.

Formulas and sources: (2) `scripts/config/si.py`.
"""

from scripts.plans.declare import Study, Table
from scripts.plans.scenes import is_block, scenes_with


def scenes_in_si(config: dict) -> dict[str, dict]:
    """Scenes with quantities in SI."""
    return {name: config["scenes"][name] for name in scenes_with(config, "si")}


def blocks_in_si(config: dict) -> list[str]:
    """Those of one block, whose events have a stress drop."""
    return [name for name in scenes_with(config, "si") if is_block(config, name)]


STUDY = Study(
    reads=("events", "scenes"),
    wildcards={"si_scene": blocks_in_si},
    tables=(
        Table(
            *("si_table", "tables/si.tsv"),
            params={"scenes": scenes_in_si},
            wanted=lambda config: bool(scenes_in_si(config)),
        ),
        Table(
            *("si_events", "tables/events/{si_scene}.csv"),
            lambda _config, si_scene: {"events": f"<results>/slip_events/{si_scene}.nc"},
            params={"si": lambda config, si_scene: config["scenes"][si_scene]["si"]},
            script="events_table.py",
            wanted=lambda config: bool(blocks_in_si(config)),
        ),
    ),
)
