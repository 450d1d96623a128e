"""Slip events of chains: their sizes by several definitions, cut-offs, and aftershocks.

Formulas and sources: `slip_events.f90`, `laws.py`.
"""

from scripts.plans.declare import LONG, Figure, Run, Study, Table
from scripts.plans.scenes import paths_of_scenes
from scripts.requests.program_groups import scene_groups


def names(config: dict) -> list[str]:
    """Chains whose events are sized."""
    return [name for name in config["event_sizes"]["scenes"] if name in config["scenes"]]


def groups(config: dict, scene: str) -> dict[str, dict]:
    """A chain for the slips of its blocks from the start on: events are found in all of them."""
    own = {"t_transient": 0.0, "thresholds": config["event_sizes"]["thresholds"]}
    return scene_groups(config, scene, **own)


def inputs(config: dict) -> dict:
    """Slips of the blocks of each chain, and its events."""
    return {
        "slips": paths_of_scenes("chain_slips", names(config)),
        "events": [f"<results>/tables/chain-events/{name}.tsv" for name in names(config)],
    }


def transient(config: dict, scene: str) -> float:
    """The time before which events of a chain are left out."""
    return config["scenes"][scene]["t_transient"]


FIGURE = {
    "category": "Chains",
    "inputs": lambda config: inputs(config) | {"laws": "<results>/tables/event-sizes.tsv"},
    "params": lambda config: {"names": names(config)},
}
STUDY = Study(
    reads=("scenes",),
    runs=(
        Run(
            *("chain_slips", "slip_events", "chain_slips/{scene}.nc", groups),
            priority=LONG,
            minutes=120,
        ),
    ),
    tables=(
        Table(
            *("chain_events", "tables/chain-events/{scene}.tsv"),
            lambda _config, scene: {"slips": f"<results>/chain_slips/{scene}.nc"},
            params={"t_transient": transient},
            script="events_table.py",
        ),
        Table(
            *("event_sizes_table", "tables/event-sizes.tsv", inputs),
            params={
                "t_transient": lambda config: [transient(config, name) for name in names(config)],
                "thresholds": lambda config: config["event_sizes"]["thresholds"],
            },
            wanted=lambda config: bool(names(config)),
        ),
    ),
    figures=(Figure("event_sizes", place=450, **FIGURE),),
    kinds=(
        Figure(
            "event_sizes",
            place=90,
            shows=("scenes",),
            shows_entry=lambda config, scene: scene in config["event_sizes"]["scenes"],
            **FIGURE,
        ),
    ),
)
